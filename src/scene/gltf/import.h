// SPDX-License-Identifier: MIT
// Imports glTF 2.0 into a Scene.
#pragma once
#include "metamarch/file/input_file.h"
#include "metamarch/scene/import.h"
#include "metamarch/scene/scene.h"

namespace metamarch {

// Takes the same options and throws the same errors as loadScene. Warnings stay in `file`.
Scene importGltf(InputFile& file, const ImportOptions& options);

} // namespace metamarch

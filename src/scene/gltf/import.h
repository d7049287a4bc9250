// glTF 2.0 to Scene.
#pragma once
#include "metamarch/file/input_file.h"
#include "metamarch/scene/import.h"
#include "metamarch/scene/scene.h"

namespace metamarch {

// `options` as in loadScene. Throws as loadScene; the warnings stay with the file.
Scene importGltf(InputFile& file, const ImportOptions& options);

} // namespace metamarch

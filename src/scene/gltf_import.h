// glTF 2.0 to Scene.
#pragma once
#include "scene/import.h"
#include "scene/scene.h"
#include "scene/scene_file.h"

namespace metamarch {

// `options` as in loadScene. Throws as loadScene; the warnings stay with the file.
Scene importGltf(SceneFile& file, const ImportOptions& options);

} // namespace metamarch

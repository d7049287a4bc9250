// glTF 2.0 to Scene.
#pragma once
#include "scene/scene.h"
#include "scene/scene_file.h"

namespace metamarch {

// `scale` as in loadScene. Throws as loadScene; the warnings stay with the file.
Scene importGltf(SceneFile& file, double scale);

} // namespace metamarch

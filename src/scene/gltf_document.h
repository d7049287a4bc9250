// From an untrusted .gltf or .glb to a tinygltf::Model that is safe to walk.
#pragma once
#include "scene/scene_file.h"

#include <tiny_gltf.h>

namespace metamarch {

// tinygltf trusts what it parses: it recurses as deep as the JSON does, cuts integers to 32 bits, falls back
// to defaults where a type is wrong, and opens whatever a URI names. So the JSON is checked first, and
// stripped of what the renderer does not read (images, animations, skins, extras), which then cannot do harm
// either. Throws Error(sceneRefused). Indices between elements are not checked here, their readers do that.
tinygltf::Model readGltf(SceneFile& file);

} // namespace metamarch

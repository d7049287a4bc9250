// glTF materials, as far as their factors go: no textures.
#pragma once
#include "scene/scene.h"

#include <tiny_gltf.h>

namespace metamarch {

// Factors outside their range are clamped to it.
Material readMaterial(const tinygltf::Material& source);

} // namespace metamarch

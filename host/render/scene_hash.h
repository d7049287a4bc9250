// SPDX-License-Identifier: MIT
// Tells scenes apart by what is traced and shaded, whatever files that came from.
#pragma once
#include "metamarch/render/prepared_scene.h"

#include <string>

namespace metamarch::render {

// Returns 16 hexadecimal digits that follow from the scene's triangles and, once it is lit, from its
// materials, textures and lights. Names, cameras and the acceleration structure are not in it.
std::string sceneHash(const PreparedScene& scene);

} // namespace metamarch::render

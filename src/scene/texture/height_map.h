// SPDX-License-Identifier: MIT
// Normal maps from heights.
#pragma once
#include "metamarch/scene/texture.h"

namespace metamarch {

// White is this much of the picture's width higher than black. No specification says it; heights in lengths
// of the picture look the same in pictures of more and fewer texels.
inline constexpr float kHeightOfWhite = 0.01f;

// Replaces a picture of heights by the normal map (rgb * 2 - 1, green up) of the surface with these heights;
// the picture repeats and its texels are square. A picture that is bluish on the whole is a normal map
// already and stays: Blender writes such ones as bump maps.
void heightsToNormals(TextureImage& image);

} // namespace metamarch

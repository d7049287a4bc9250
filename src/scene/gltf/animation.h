// SPDX-License-Identifier: MIT
// glTF animations: moves the nodes to their pose at a given time.
#pragma once
#include "metamarch/scene/gltf/document.h"
#include "metamarch/scene/scene.h"

#include <string>
#include <vector>

namespace metamarch {

// Sets translation, rotation, scale and weights of every animated node to their values at `seconds`. Outside
// an animation's time range, the first or last keyframe counts. `animation` is the name or index of the
// animation to play; if it is empty, all are played, and later ones override earlier ones. Throws
// Error(invalidArgument), listing the animations, if it does not exist, and Error(inputRefused) if an
// animation is broken.
void poseNodes(GltfDocument& document, InputFile& file, const std::string& animation, double seconds);

// Returns the file's animations, with the time of the last key of each.
std::vector<SceneAnimation> readAnimations(const GltfDocument& document, const InputFile& file);

} // namespace metamarch

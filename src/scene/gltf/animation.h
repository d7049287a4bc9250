// glTF animations: nodes as they stand at a time.
#pragma once
#include "metamarch/scene/gltf/document.h"

#include <string>

namespace metamarch {

// Sets translation, rotation, scale and weights of every animated node to their values at `seconds`: those of
// the first or last key outside an animation's time. `animation` is the name or index of the one to play,
// empty for all, the later ones having the last word. Throws Error(invalidArgument), listing the animations,
// for one that does not exist, and Error(inputRefused) for one that is broken.
void poseNodes(GltfDocument& document, InputFile& file, const std::string& animation, double seconds);

// When the last animation ends, by the files' own word: the greatest time of its samplers' accessors.
double animationSeconds(const GltfDocument& document);

} // namespace metamarch

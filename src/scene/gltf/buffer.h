// The bytes of glTF buffer views, checked.
#pragma once
#include "metamarch/file/input_file.h"

#include <tiny_gltf.h>

#include <span>
#include <string>

namespace metamarch {

// Throws Error(inputRefused), starting with `label`, when view or buffer do not exist or the view reaches
// past its buffer.
std::span<const unsigned char> bytesOfView(const tinygltf::Model& model, const InputFile& file,
                                           const std::string& label, int view);

} // namespace metamarch

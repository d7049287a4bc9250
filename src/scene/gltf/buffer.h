// SPDX-License-Identifier: MIT
// The bytes of glTF buffer views, with bounds checks.
#pragma once
#include "metamarch/file/input_file.h"

#include <tiny_gltf.h>

#include <span>
#include <string>

namespace metamarch {

// Returns the bytes of a buffer view. Throws Error(inputRefused), with a message that starts with `label`, if
// view or buffer does not exist or the view exceeds its buffer.
std::span<const unsigned char> bytesOfView(const tinygltf::Model& model, const InputFile& file,
                                           const std::string& label, int view);

} // namespace metamarch

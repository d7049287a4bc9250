// SPDX-License-Identifier: MIT
// The bytes of glTF buffers and buffer views, with bounds checks.
#pragma once
#include "metamarch/file/input_file.h"
#include "metamarch/scene/gltf/document.h"

#include <tiny_gltf.h>

#include <span>
#include <string>

namespace metamarch {

// Fills model.buffers from data URIs, from files beside the scene and, for a first buffer without a URI, from
// `binary`, the second chunk of a .glb. A buffer has all bytes that are there, which may be more than its
// byteLength (glTF 2.0, 3.6.1.1). If there are fewer, there is a warning, and reading what is not there is
// refused. Each file is read once: buffer views of further buffers of the same file refer to the first.
// Throws Error(inputRefused) for any scheme other than base64 data, and for a file that is missing or outside
// the scene's folder.
void readBuffers(GltfDocument& document, InputFile& file, std::span<const unsigned char> binary);

// Returns the bytes of a buffer view. Throws Error(inputRefused), with a message that starts with `label`, if
// view or buffer does not exist or the view exceeds its buffer.
std::span<const unsigned char> bytesOfView(const tinygltf::Model& model, const InputFile& file,
                                           const std::string& label, int view);

} // namespace metamarch

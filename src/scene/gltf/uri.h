// SPDX-License-Identifier: MIT
// URIs of glTF buffers and images: what they may name, and the only files that tinygltf can open.
#pragma once
#include "metamarch/file/input_file.h"

#include <tiny_gltf.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace metamarch {

// Returns the URI in a form that tinygltf reads. Throws Error(inputRefused), with a message that starts with
// `label`, for any scheme other than base64 data, and for a file that is missing or outside the scene's
// folder.
std::string checkedBufferUri(const InputFile& file, const std::string& label, const std::string& uri);

// Returns the bytes of a data URI, or nothing if it is not base64.
std::optional<std::vector<unsigned char>> bytesOfDataUri(const std::string& uri);
bool isDataUri(const std::string& uri);

// Returns the file name in a URI that is not a data URI, with percent escapes decoded.
std::string fileNameOfUri(const std::string& uri);

// Returns file access for tinygltf that cannot read outside the scene's folder and cannot write. `file` must
// outlive it.
tinygltf::FsCallbacks readOnlyBeside(InputFile& file);

} // namespace metamarch

// URIs of glTF buffers and images: what they may name, and the only files tinygltf gets to see.
#pragma once
#include "metamarch/file/input_file.h"

#include <tiny_gltf.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace metamarch {

// Returns the URI in a form tinygltf reads. Throws Error(inputRefused), starting with `label`, for another
// scheme than base64 data, and for a file that is missing or not in the scene's folder.
std::string checkedBufferUri(const InputFile& file, const std::string& label, const std::string& uri);

// The bytes of a data URI, or nothing when it is not base64.
std::optional<std::vector<unsigned char>> bytesOfDataUri(const std::string& uri);
bool isDataUri(const std::string& uri);

// What a URI that is no data names: its percent escapes decoded.
std::string fileNameOfUri(const std::string& uri);

// File access for tinygltf that sees nothing outside the scene's folder and writes nothing. `file` must
// outlive it.
tinygltf::FsCallbacks readOnlyBeside(InputFile& file);

} // namespace metamarch

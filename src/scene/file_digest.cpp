// SPDX-License-Identifier: MIT
#include "metamarch/scene/file_digest.h"

#include "metamarch/file/input_file.h"

#include <OpenImageIO/hash.h>

namespace metamarch {

std::string sha1Of(const std::filesystem::path& file) {
    const std::optional<std::vector<unsigned char>> bytes = readBytes(file);
    return bytes ? lowerCase(OIIO::SHA1::digest(bytes->data(), bytes->size())) : "";
}

} // namespace metamarch

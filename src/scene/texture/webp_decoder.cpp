// SPDX-License-Identifier: MIT
#include "metamarch/scene/texture/webp_decoder.h"

#include "metamarch/scene/texture/texture_decoder.h"

#ifdef METAMARCH_WEBP
#include <webp/decode.h>
#endif

namespace metamarch {

#ifdef METAMARCH_WEBP
TextureImage decodeWebp(std::span<const unsigned char> bytes) {
    int width = 0;
    int height = 0; // the format allows at most 16383 each
    if (WebPGetInfo(bytes.data(), bytes.size(), &width, &height) == 0) {
        throw TextureFailure("is no WebP picture");
    }
    TextureImage image;
    image.width = static_cast<std::uint32_t>(width);
    image.height = static_cast<std::uint32_t>(height);
    image.bytes.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    if (WebPDecodeRGBAInto(bytes.data(), bytes.size(), &image.bytes[0].r, 4 * image.bytes.size(),
                           4 * width) == nullptr) {
        throw TextureFailure("cannot be decoded: the WebP is cut off or broken");
    }
    return image;
}
#else
TextureImage decodeWebp(std::span<const unsigned char>) {
    throw TextureFailure("is WebP, which needs a build with libwebp");
}
#endif

} // namespace metamarch

#include "metamarch/image/primary_image.h"

#include <algorithm>
#include <limits>

namespace metamarch {

Image primaryImage(const std::span<const PrimaryPixel> pixels, const int width, const int height) {
    Image image(width, height,
                {"R", "G", "B", "A", "Z", "t", "N.X", "N.Y", "N.Z", "id.triangle", "steps", "tests"});
    float* out = image.pixels.data();
    for (const PrimaryPixel& pixel : pixels) {
        constexpr float kInfinity = std::numeric_limits<float>::infinity();
        const bool miss = pixel.triangleId == kNoTriangle;
        const float values[] = {pixel.color.x,
                                pixel.color.y,
                                pixel.color.z,
                                pixel.alpha,
                                miss ? kInfinity : pixel.depth,
                                miss ? kInfinity : pixel.t,
                                pixel.normal.x,
                                pixel.normal.y,
                                pixel.normal.z,
                                miss ? -1.0f : static_cast<float>(pixel.triangleId),
                                static_cast<float>(pixel.steps),
                                static_cast<float>(pixel.tests)};
        out = std::copy(std::begin(values), std::end(values), out);
    }
    return image;
}

} // namespace metamarch

#include "metamarch/image/picture_header.h"

#include <fmt/format.h>

namespace metamarch {

void addHeader(Image& image, const PictureOrigin& origin) {
    const auto point = [](const glm::vec3 v) { return fmt::format("{},{},{}", v.x, v.y, v.z); };
    const std::pair<std::string, std::string> attributes[] = {
        {"Software", origin.software},
        {"metamarch/device", origin.device},
        {"metamarch/driver", origin.driver},
        {"metamarch/traversal", origin.traversal},
        {"metamarch/integrator", origin.integrator},
        {"metamarch/scene", origin.scene},
        {"metamarch/camera", origin.camera},
        {"metamarch/eye", point(origin.eye)},
        {"metamarch/forward", point(origin.forward)},
        {"metamarch/up", point(origin.up)},
        {"metamarch/seconds", fmt::format("{:.3f}", origin.seconds)}};
    image.attributes.insert(image.attributes.end(), std::begin(attributes), std::end(attributes));
}

void addSampling(Image& image, const std::uint32_t samples, const std::uint32_t seed,
                 const std::uint32_t maxBounces) {
    image.attributes.emplace_back("metamarch/spp", fmt::format("{}", samples));
    image.attributes.emplace_back("metamarch/seed", fmt::format("{}", seed));
    image.attributes.emplace_back("metamarch/maxBounces", fmt::format("{}", maxBounces));
}

void makeOpaque(Image& image) {
    if (const auto alpha = image.findChannel("A")) {
        image.channels[*alpha] = "coverage";
    }
}

} // namespace metamarch

// SPDX-License-Identifier: MIT
#include "metamarch/settings/render_settings.h"

#include <limits>
#include <span>

namespace metamarch {
namespace {

constexpr const char* kGroup = "Light transport (--integrator path, direct, ao)";

} // namespace

void declareIntegrator(SettingList& list, PathChoice& path, const std::size_t integrators) {
    std::vector<std::string> offered;
    for (const auto& [name, integrator] : std::span(kIntegrators).first(integrators)) {
        offered.emplace_back(name);
    }
    list.choice("integrator", path.integrator, kIntegrators,
                "path: global illumination; direct: without bounces; ao: white, under a white sky; primary: "
                "what is seen, lit from the eye, at pixel centres")
        .oneOf(std::move(offered));
}

void declarePath(SettingList& list, PathChoice& path, std::uint32_t& samplesPerPixel) {
    list.beginGroup(kGroup);
    list.count("spp", samplesPerPixel, 1, kMostSamples, "Samples a pixel").withShortName("s");
    list.count("seed", path.seed, 0, 0xffffffffu, "Another seed draws other samples");
    list.count("max-bounces", path.maxBounces, 0, kMostBounces,
               "Scatter a path this often at most; 0: direct light alone")
        .slides({.least = 0, .most = 32, .format = "%.0f", .isWhole = true});
    list.number("clamp", path.clamp,
                {0.0, std::numeric_limits<float>::max(), "a finite luminance of at least 0"},
                "Limit what one connection to a light adds to a sample, in luminance; 0: no limit")
        .withValueName("L");
    list.choice("brdf", path.brdf, kBrdfs,
                "compensated: rough surfaces keep their energy; gltf: single scattering to the letter of "
                "glTF 2.0, Appendix B");
}

} // namespace metamarch

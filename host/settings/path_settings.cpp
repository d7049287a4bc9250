// SPDX-License-Identifier: MIT
#include "metamarch/settings/render_settings.h"

#include <fmt/format.h>

#include <limits>
#include <span>

namespace metamarch {
namespace {

constexpr const char* kGroup = "Light transport (--integrator path, direct, ao)";

CatcherChoice catcherOf(const std::string& text) {
    constexpr std::string_view kHeight = "y=";
    if (text.starts_with(kHeight)) {
        return {CatcherChoice::Kind::plane,
                parseFloat(text.substr(kHeight.size()), {.wanted = "y=HEIGHT with a finite number"})};
    }
    if (text.empty()) {
        throw Error(ErrorKind::invalidArgument, "give y=HEIGHT, auto or a material");
    }
    return text == "auto" ? CatcherChoice{CatcherChoice::Kind::lowest}
                          : CatcherChoice{CatcherChoice::Kind::material, 0.0f, text};
}

std::string textOf(const CatcherChoice& catcher) {
    switch (catcher.kind) {
    case CatcherChoice::Kind::plane:
        return fmt::format("y={}", catcher.height);
    case CatcherChoice::Kind::lowest:
        return "auto";
    default:
        return catcher.material;
    }
}

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

void declareCatcher(SettingList& list, CatcherChoice& catcher, PathChoice& path) {
    list.add(
            "shadow-catcher", Setting::Kind::value,
            {[&catcher](const std::string& text) { catcher = catcherOf(text); },
             [&catcher] { return textOf(catcher); }},
            "A ground that only takes shadow: a plane at this height, or at the scene's lowest point (auto), "
            "or the surfaces of a material")
        .withValueName("y=HEIGHT|auto|MATERIAL");
    list.number(
            "catcher-reflection", path.catcherReflection, {0.0, 1.0, "a roughness from 0 to 1"},
            "The ground also reflects the objects, like a polished floor of this roughness; 0: like a mirror "
            "of glass")
        .withValueName("ROUGHNESS")
        .needs({"shadow-catcher"});
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

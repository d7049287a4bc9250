#include "metamarch/cli/tone_options.h"

#include "metamarch/error/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace metamarch::cli {
namespace {

// More stops leave nothing of a float.
constexpr double kMostStops = 100.0;

} // namespace

void ToneOptions::addTo(CLI::App& command) {
    const std::string group = "Tones of a PNG (EXR stays linear)";
    std::vector<std::string> names;
    for (const ToneOperatorName& known : kToneOperators) {
        names.emplace_back(known.name);
    }
    command
        .add_option("--tone-map", toneMap,
                    "neutral: Khronos PBR Neutral (default, but for --integrator primary); aces; agx; none: "
                    "cut off at 1")
        ->check(CLI::IsMember(names))
        ->group(group);
    command.add_option("--exposure", exposure, "Double the light this often before that")
        ->type_name("STOPS")
        ->group(group);
}

void ToneOptions::check() const {
    if (!(std::abs(exposure) <= kMostStops)) {
        throw Error(ErrorKind::invalidArgument, fmt::format("--exposure {}: give stops from -{} to {}",
                                                            exposure, kMostStops, kMostStops));
    }
}

ToneMapping ToneOptions::parse(const std::string& integrator) const {
    const std::string byIntegrator = integrator == "primary" || integrator == "ao" ? "none" : "neutral";
    const std::string& wanted = toneMap.empty() ? byIntegrator : toneMap;
    const auto* const known = std::ranges::find(kToneOperators, wanted, &ToneOperatorName::name);
    return {known->toneOperator, static_cast<float>(exposure)};
}

} // namespace metamarch::cli

#include "metamarch/cli/path_options.h"

#include "metamarch/error/error.h"

#include <fmt/format.h>

#include <cmath>

namespace metamarch::cli {
namespace {

// Float sums of more samples would no longer grow; dimensions of more bounces would pass 2^32.
constexpr std::uint32_t kMostSamples = 1u << 24u;
constexpr std::uint32_t kMostBounces = 1u << 16u;

} // namespace

void PathOptions::addTo(CLI::App& command) {
    const std::string group = "Light transport (--integrator path, direct, ao)";
    command.add_option("-s,--spp", spp, "Samples a pixel")
        ->type_name("N")
        ->capture_default_str()
        ->group(group);
    command.add_option("--seed", choice.seed, "Another seed draws other samples")
        ->type_name("N")
        ->capture_default_str()
        ->group(group);
    command
        .add_option("--max-bounces", choice.maxBounces, "Scattered this often at most; 0: direct light alone")
        ->type_name("N")
        ->capture_default_str()
        ->group(group);
    command.add_option("--clamp", clamp, "Limit what one way to a light adds to a sample, in luminance")
        ->type_name("L")
        ->group(group);
    command
        .add_option("--brdf", brdf,
                    "compensated: rough surfaces keep their energy; gltf: single scattering to the letter of "
                    "glTF 2.0, Appendix B")
        ->check(CLI::IsMember({"compensated", "gltf"}))
        ->capture_default_str()
        ->group(group);
}

void PathOptions::check() const {
    const auto refuse = [](const std::string& line) { throw Error(ErrorKind::invalidArgument, line); };
    if (spp < 1 || spp > kMostSamples) {
        refuse(fmt::format("--spp {}: give 1 to {}", spp, kMostSamples));
    }
    if (choice.maxBounces > kMostBounces) {
        refuse(fmt::format("--max-bounces {}: give at most {}", choice.maxBounces, kMostBounces));
    }
    if (!(std::isfinite(clamp) && clamp >= 0.0)) {
        refuse(fmt::format("--clamp {}: give a finite luminance of at least 0", clamp));
    }
}

PathChoice PathOptions::parse(const std::string& integrator) const {
    PathChoice parsed = choice;
    parsed.integrator = integrator;
    parsed.clamp = static_cast<float>(clamp);
    parsed.isSingleScatter = brdf == "gltf";
    return parsed;
}

} // namespace metamarch::cli

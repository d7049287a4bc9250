#include "metamarch/cli/bench_options.h"

#include "metamarch/cli/number_list.h"
#include "metamarch/cli/version.h"
#include "metamarch/error/error.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cmath>
#include <ctime>

namespace metamarch::cli {

void BenchOptions::addTo(CLI::App& command) {
    command.add_option("--size", sizeText, "Pixels of each view")->type_name("WxH")->capture_default_str();
    command.add_option("--repeat", repeat, "Measured runs at least, after one to warm up")
        ->type_name("N")
        ->capture_default_str();
    command.add_option("--seconds", seconds, "Measured seconds at least, of each row")
        ->type_name("S")
        ->capture_default_str();
}

bench::Protocol BenchOptions::protocol() const {
    if (repeat < 1) {
        throw Error(ErrorKind::invalidArgument, fmt::format("--repeat {}: give at least 1", repeat));
    }
    if (!(seconds >= 0.0 && std::isfinite(seconds))) {
        throw Error(ErrorKind::invalidArgument, fmt::format("--seconds {}: give 0 or more", seconds));
    }
    return {static_cast<unsigned>(repeat), seconds};
}

glm::uvec2 BenchOptions::size() const { return parseSize("--size", sizeText); }

bench::Origin BenchOptions::originOf(const std::string& device, const std::string& driver) const {
    const glm::uvec2 pixels = size();
    return {device, driver, gitCommit(), fmt::format("{:%F}", fmt::gmtime(std::time(nullptr))),
            fmt::format("{} x {} pixels each view, at least {} runs and {} s each row", pixels.x, pixels.y,
                        repeat, seconds)};
}

std::string jsonText(const bench::Origin& origin, const std::span<const bench::Row> rows) {
    return bench::toJson(origin, rows).dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) +
           "\n";
}

} // namespace metamarch::cli

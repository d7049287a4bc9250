// SPDX-License-Identifier: MIT
#include "metamarch/cli/bench_options.h"

#include "metamarch/cli/threads.h"
#include "metamarch/cli/version.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <ctime>

namespace metamarch::cli {

void BenchOptions::declare(SettingList& list) {
    list.beginGroup("Measurement");
    list.size("size", size, "Pixels of each view");
    list.count("repeat", repeat, 1, 1000000, "Measured runs at least, after one to warm up");
    list.number("seconds", seconds, {0.0, 1e9, "0 or more seconds"}, "Measured seconds at least, of each row")
        .withValueName("S");
    declareThreads(list, threads);
}

bench::Origin BenchOptions::originOf(const std::string& device, const std::string& driver) const {
    return {device, driver, gitCommit(), fmt::format("{:%F}", fmt::gmtime(std::time(nullptr))),
            fmt::format("{} x {} pixels each view, at least {} runs and {} s each row", size.x, size.y,
                        repeat, seconds)};
}

std::string jsonText(const bench::Origin& origin, const std::span<const bench::Row> rows) {
    return bench::toJson(origin, rows).dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) +
           "\n";
}

} // namespace metamarch::cli

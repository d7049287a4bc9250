// What the benchmarks' sub-commands have in common.
#pragma once
#include "metamarch/bench/measurement.h"
#include "metamarch/bench/row.h"
#include "metamarch/vulkan/device.h"

#include <CLI/CLI.hpp>
#include <glm/glm.hpp>

#include <string>

namespace metamarch::cli {

class BenchOptions {
  public:
    void addTo(CLI::App& command);

    // Throw Error(invalidArgument) for values out of range.
    bench::Protocol protocol() const;
    glm::uvec2 size() const;

    // Of rows measured now, with these options.
    bench::Origin originOf(const std::string& device, const std::string& driver) const;

    std::string sizeText = "320x240";

  private:
    int repeat = 5;
    double seconds = 0.5;
};

// The JSON of the rows, also where a driver calls its device by bytes that are no UTF-8.
std::string jsonText(const bench::Origin& origin, std::span<const bench::Row> rows);

} // namespace metamarch::cli

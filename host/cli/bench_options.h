// SPDX-License-Identifier: MIT
// The options that the benchmarks' sub-commands share.
#pragma once
#include "metamarch/bench/measurement.h"
#include "metamarch/bench/row.h"
#include "metamarch/settings/setting.h"
#include "metamarch/vulkan/device.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace metamarch::cli {

class BenchOptions {
  public:
    void declare(SettingList& list);

    bench::Protocol protocol() const { return {repeat, seconds}; }

    // Returns the origin of rows that are measured now, with these options.
    bench::Origin originOf(const std::string& device, const std::string& driver) const;

    glm::uvec2 size{320, 240};
    std::optional<std::uint32_t> threads;

  private:
    std::uint32_t repeat = 5;
    double seconds = 0.5;
};

// Returns the rows as JSON. Bytes of a device's name that are no UTF-8 are replaced.
std::string jsonText(const bench::Origin& origin, std::span<const bench::Row> rows);

} // namespace metamarch::cli

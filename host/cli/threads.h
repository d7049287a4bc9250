// SPDX-License-Identifier: MIT
// Chooses how many threads the program takes.
#pragma once
#include "metamarch/settings/setting.h"

#include <tbb/global_control.h>

#include <cstdint>
#include <optional>

namespace metamarch::cli {

Setting& declareThreads(SettingList& list, std::optional<std::uint32_t>& threads);

// Limits, while it lives, the threads of the program itself, of the picture writer and of Mesa's software
// Vulkan driver. Make it before the Vulkan loader is opened: the driver reads its limit from the
// environment. Without a number each takes a thread for each processor, or fewer if the system (`ulimit -u`,
// a container's limit) does not allow so many. The program tries threads out only if such a limit is near.
class Threads {
  public:
    explicit Threads(std::optional<std::uint32_t> wanted);

  private:
    tbb::global_control control_;
};

} // namespace metamarch::cli

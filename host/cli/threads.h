// SPDX-License-Identifier: MIT
// How many threads the program takes.
#pragma once
#include "metamarch/settings/setting.h"

#include <tbb/global_control.h>

#include <cstdint>
#include <optional>

namespace metamarch::cli {

Setting& declareThreads(SettingList& list, std::optional<std::uint32_t>& threads);

// Limits, while it lives, the threads of the program itself, of the picture writer and of Mesa's software
// Vulkan driver. It has to be there before the Vulkan loader is opened: the driver reads its limit from the
// environment. Without a number each takes one for each processor, or fewer where the system (`ulimit -u`, a
// container's limit) does not allow so many. Only where such a limit is near are the threads tried out.
class Threads {
  public:
    explicit Threads(std::optional<std::uint32_t> wanted);

  private:
    tbb::global_control control_;
};

} // namespace metamarch::cli

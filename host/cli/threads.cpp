// SPDX-License-Identifier: MIT
#include "metamarch/cli/threads.h"

#include "metamarch/image/image_file.h"

#include <tbb/info.h>

#include <algorithm>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

namespace metamarch::cli {
namespace {

// The pools beside each other: TBB, OpenImageIO, OpenEXR and the driver's two.
constexpr std::size_t kPools = 5;
constexpr std::size_t kOthers = 4; // single threads of the driver, such as that of its disk cache

// How many of `wanted` threads the system lets live beside each other.
std::size_t possibleThreads(const std::size_t wanted) {
    std::mutex mutex;
    std::condition_variable mayEnd;
    bool isOver = false;
    std::vector<std::thread> threads;
    threads.reserve(wanted);
    try {
        while (threads.size() < wanted) {
            threads.emplace_back([&] {
                std::unique_lock lock(mutex);
                mayEnd.wait(lock, [&] { return isOver; });
            });
        }
    } catch (const std::system_error&) {
        // As many as there are.
    }
    {
        const std::scoped_lock lock(mutex);
        isOver = true;
    }
    mayEnd.notify_all();
    for (std::thread& thread : threads) {
        thread.join();
    }
    return threads.size();
}

// The threads of each pool, the calling one among them, and what the driver is to be told.
struct Share {
    std::size_t threads;
    bool isLimited; // fewer than there are processors
};

Share shareOf(const std::optional<std::uint32_t> wanted) {
    const auto processors = static_cast<std::size_t>(std::max(tbb::info::default_concurrency(), 1));
    const std::size_t threads = wanted ? std::size_t{*wanted} : processors;
    const std::size_t all = kPools * threads + kOthers;
    const std::size_t possible = possibleThreads(all);
    if (possible == all) {
        return {threads, wanted.has_value()};
    }
    return {std::max<std::size_t>(possible > kOthers ? (possible - kOthers) / kPools : 0, 1), true};
}

std::size_t limitAll(const Share& share) {
    if (share.isLimited) {
        setImageThreads(static_cast<int>(share.threads));
        setenv("LP_NUM_THREADS", std::to_string(share.threads).c_str(), 1);
    }
    return share.threads;
}

} // namespace

Setting& declareThreads(SettingList& list, std::optional<std::uint32_t>& threads) {
    return list
        .count("threads", threads, 1, 1024,
               "Threads that work at the same time, also those of a software Vulkan driver (default: one for "
               "each processor)")
        .withValueName("N");
}

Threads::Threads(const std::optional<std::uint32_t> wanted)
    : control_(tbb::global_control::max_allowed_parallelism, limitAll(shareOf(wanted))) {}

} // namespace metamarch::cli

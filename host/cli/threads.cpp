// SPDX-License-Identifier: MIT
#include "metamarch/cli/threads.h"

#include "metamarch/image/image_file.h"

#include <tbb/info.h>

#include <algorithm>
#include <condition_variable>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <string>
#include <sys/resource.h>
#include <system_error>
#include <thread>
#include <vector>

namespace metamarch::cli {
namespace {

// Pools that run at the same time: TBB, OpenImageIO, OpenEXR and the driver's two.
constexpr std::size_t kPools = 5;
constexpr std::size_t kOthers = 4; // single threads of the driver, such as that of its disk cache

// A limit of at least this many threads leaves room for what the user or the container already runs.
constexpr std::uint64_t kAmple = 16384;

// Returns the limit in a cgroup's file pids.max, or nothing if it is "max" or if there is no such file.
std::optional<std::uint64_t> readPidsMax(const std::filesystem::path& folder) {
    std::ifstream file(folder / "pids.max");
    std::uint64_t limit = 0;
    return file >> limit ? std::optional(limit) : std::nullopt;
}

// Returns true if a cgroup of this process, or one above it, has a limit below `wanted`; see cgroups(7). In a
// container the path may be the host's. Then only the mounted folder itself has the file.
bool isCgroupBelow(const std::uint64_t wanted) {
    std::ifstream cgroups("/proc/self/cgroup");
    for (std::string line; std::getline(cgroups, line);) { // HIERARCHY:CONTROLLERS:/PATH
        const std::size_t controllers = line.find(':');
        const std::size_t path = line.find(":/", controllers);
        if (path == std::string::npos) {
            continue;
        }
        const bool isUnified = path == controllers + 1; // version 2 names no controllers
        if (!isUnified && line.substr(controllers, path - controllers).find("pids") == std::string::npos) {
            continue;
        }
        std::string folder = isUnified ? "/sys/fs/cgroup" : "/sys/fs/cgroup/pids";
        const std::size_t root = folder.size();
        for (folder += line.substr(path + 1);; folder.resize(std::max(folder.rfind('/'), root))) {
            const std::optional<std::uint64_t> limit = readPidsMax(folder);
            if (limit && *limit < wanted) {
                return true;
            }
            if (folder.size() <= root) {
                break;
            }
        }
    }
    return false;
}

// Returns true if the system may refuse some of `wanted` threads, because a limit of the user (`ulimit -u`)
// or of a container is not far above that number.
bool isNearLimit(const std::uint64_t wanted) {
    rlimit user{};
    const bool isUserLimited = getrlimit(RLIMIT_NPROC, &user) == 0 && user.rlim_cur != RLIM_INFINITY &&
                               user.rlim_cur < wanted + kAmple;
    return isUserLimited || isCgroupBelow(wanted + kAmple);
}

// Returns how many of `wanted` threads the system lets run at the same time.
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
        // The threads that have started are the answer.
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

// The number of threads of each pool, with the calling one, and the number for the driver.
struct Share {
    std::size_t threads;
    bool isSet; // by the user or by a limit; otherwise the libraries choose by themselves
};

Share shareOf(const std::optional<std::uint32_t> wanted) {
    const auto processors = static_cast<std::size_t>(std::max(tbb::info::default_concurrency(), 1));
    const std::size_t threads = wanted ? std::size_t{*wanted} : processors;
    const std::size_t all = kPools * threads + kOthers;
    const std::size_t possible = isNearLimit(all) ? possibleThreads(all) : all;
    if (possible == all) {
        return {threads, wanted.has_value()};
    }
    return {std::max<std::size_t>(possible > kOthers ? (possible - kOthers) / kPools : 0, 1), true};
}

std::size_t limitAll(const Share& share) {
    if (share.isSet) {
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

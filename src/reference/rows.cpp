// SPDX-License-Identifier: MIT
#include "metamarch/reference/rows.h"

#include <tbb/parallel_for.h>

#include <atomic>
#include <mutex>

namespace metamarch {

void forEachRow(const unsigned rowCount, const std::function<void(unsigned y)>& render,
                const OnProgress& onProgress) {
    std::mutex mutex;
    unsigned finished = 0;
    std::atomic<bool> isCancelled = false;
    tbb::parallel_for(0u, rowCount, [&](const unsigned y) {
        if (isCancelled) {
            return;
        }
        render(y);
        if (onProgress) {
            const std::scoped_lock lock(mutex);
            ++finished;
            isCancelled = isCancelled || !onProgress(static_cast<double>(finished) / rowCount);
        }
    });
}

} // namespace metamarch

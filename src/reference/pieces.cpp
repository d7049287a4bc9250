// SPDX-License-Identifier: MIT
#include "metamarch/reference/pieces.h"

#include <tbb/parallel_for.h>

#include <atomic>
#include <mutex>

namespace metamarch {

bool forEachPiece(const unsigned pieceCount, const std::function<void(unsigned piece)>& render,
                  const OnProgress& onProgress) {
    std::mutex mutex;
    unsigned finished = 0;
    std::atomic<bool> isCancelled = false;
    tbb::parallel_for(0u, pieceCount, [&](const unsigned piece) {
        if (isCancelled) {
            return;
        }
        render(piece);
        const std::scoped_lock lock(mutex);
        ++finished;
        isCancelled = isCancelled || (onProgress && !onProgress(static_cast<double>(finished) / pieceCount));
    });
    return finished == pieceCount;
}

} // namespace metamarch

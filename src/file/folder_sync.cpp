// SPDX-License-Identifier: MIT
#include "metamarch/file/folder_sync.h"

#include <fcntl.h>
#include <unistd.h>

namespace metamarch {

void syncFolder(const std::filesystem::path& folder) noexcept {
    const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor >= 0) {
        fsync(descriptor);
        close(descriptor);
    }
}

} // namespace metamarch

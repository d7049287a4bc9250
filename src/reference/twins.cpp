// SPDX-License-Identifier: MIT
#include "metamarch/reference/twins.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace metamarch {

bool hasTwin(const std::string_view traversal) {
    return std::ranges::find(twins(), traversal, &Twin::traversal) != twins().end();
}

const TwinLoop& findTwin(const std::string_view traversal) {
    const auto found = std::ranges::find(twins(), traversal, &Twin::traversal);
    if (found == twins().end()) {
        throw std::out_of_range("no CPU twin of " + std::string(traversal));
    }
    return found->loop;
}

} // namespace metamarch

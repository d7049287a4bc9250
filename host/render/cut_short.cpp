// SPDX-License-Identifier: MIT
#include "metamarch/render/cut_short.h"

#include "metamarch/error/error.h"
#include "metamarch/shared/triangle.h"

#include <fmt/format.h>

namespace metamarch::render {

void refuseCutShort(const std::uint32_t steps, const vulkan::Device& device, const std::string& traversal) {
    if (steps == kCutShort) {
        throw Error(
            ErrorKind::outOfMemory,
            fmt::format(
                "{}: the driver ended a ray's loops before {} was done (llvmpipe allows 65535 turns): "
                "too many triangles in a leaf; choose more cells, a larger tree depth or "
                "the CPU",
                device.name(), traversal),
            {"cells", "treeDepth", "backend"});
    }
}

} // namespace metamarch::render

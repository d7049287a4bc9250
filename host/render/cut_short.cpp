#include "render/cut_short.h"

#include "error.h"
#include "shared/triangle.h"

#include <fmt/format.h>

namespace metamarch::render {

void refuseCutShort(const std::uint32_t steps, const vulkan::Device& device, const std::string& traversal) {
    if (steps == kCutShort) {
        throw Error(
            ExitCode::outOfMemory,
            fmt::format(
                "{}: the driver ended a ray's loops before {} was done (llvmpipe allows 65535 turns): "
                "too many triangles in a leaf; choose more --cells, a larger --tree-depth or "
                "--backend cpu",
                device.name(), traversal));
    }
}

} // namespace metamarch::render

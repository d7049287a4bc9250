// SPDX-License-Identifier: MIT
#include "metamarch/render/processor_input.h"

#include "metamarch/accel/structure.h"
#include "metamarch/error/error.h"
#include "metamarch/vulkan/byte_text.h"

#include <fmt/format.h>

#include <array>
#include <limits>

namespace metamarch::render {

KernelInput inputOver(const AccelerationStructure& structure) {
    KernelInput input{};
    const StructureSet set(structure);
    const Structure& walked = findStructure("meta_table");
    for (const StructurePart& part : walked.parts) {
        bindBytes(input, part.binding, part.data(set));
    }
    bindValues(input, kBindTriangles, walked.triangles(set));
    bindValues(input, kBindLattice, std::span(&structure.lattice, 1));
    return input;
}

void bindBytes(KernelInput& input, const std::uint32_t binding, const std::span<const std::byte> bytes) {
    // Lanes without work read the first entry, so each array has one. No entry is larger.
    static constexpr std::array<std::byte, sizeof(TriangleRecord)> kNone{};
    // Lanes count bytes in 32 bits.
    if (bytes.size() > std::numeric_limits<std::uint32_t>::max()) {
        throw Error(ErrorKind::outOfMemory,
                    fmt::format("an array of the scene takes {}, more than the 4 GiB that the cpu's kernels "
                                "read; kd_stack or a gpu reads more",
                                vulkan::byteText(bytes.size())),
                    {"traversal", "backend"});
    }
    const std::byte* const first = bytes.empty() ? kNone.data() : bytes.data();
    input.buffers[binding] = const_cast<char*>(reinterpret_cast<const char*>(first));
}

} // namespace metamarch::render

// SPDX-License-Identifier: MIT
// The words of a SPIR-V module, cut into instructions.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace metamarch::vulkan {

// The SPIR-V specification 1.5, section 2.3.
constexpr std::size_t kSpirvHeaderWords = 5;
constexpr std::size_t kSpirvBound = 3; // the word of the header that is above every id

using SpirvInstruction = std::span<const uint32_t>;

constexpr uint32_t opcodeOf(const SpirvInstruction instruction) { return instruction[0] & 0xffffu; }
constexpr uint32_t firstSpirvWord(const uint32_t opcode, const uint32_t words) {
    return words << 16u | opcode;
}

// Returns the instructions of a module, none if it is damaged.
inline std::vector<SpirvInstruction> spirvInstructions(const std::span<const uint32_t> spirv) {
    std::vector<SpirvInstruction> result;
    for (std::size_t at = kSpirvHeaderWords; at < spirv.size();) {
        const std::size_t count = spirv[at] >> 16u;
        if (count == 0 || count > spirv.size() - at) {
            return {};
        }
        result.push_back(spirv.subspan(at, count));
        at += count;
    }
    return result;
}

} // namespace metamarch::vulkan

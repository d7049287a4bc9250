// SPDX-License-Identifier: MIT
#include "metamarch/vulkan/float_modes.h"

#include <cstddef>

namespace metamarch::vulkan {
namespace {

// The SPIR-V specification 1.5, sections 2.3, 3.6, 3.31, 3.36.5 and 3.36.6.
constexpr std::size_t kHeaderWords = 5;
constexpr uint32_t kOpEntryPoint = 15;
constexpr uint32_t kOpExecutionMode = 16;
constexpr uint32_t kOpCapability = 17;
constexpr uint32_t kOpcodeMask = 0xffffu;
constexpr uint32_t kFloatBits = 32;

struct Mode {
    uint32_t capability;
    uint32_t executionMode;
};
constexpr Mode kSignedZeroInfNanPreserve{4466, 4461};
constexpr Mode kRoundingModeRte{4467, 4462};

constexpr uint32_t firstWord(const uint32_t opcode, const uint32_t words) { return words << 16u | opcode; }

} // namespace

std::vector<uint32_t> withFloatModes(const std::span<const uint32_t> spirv, const FloatModes& modes) {
    std::vector<Mode> wanted;
    if (modes.roundsToNearestEven) {
        wanted.push_back(kRoundingModeRte);
    }
    if (modes.keepsSignsInfinitiesAndNans) {
        wanted.push_back(kSignedZeroInfNanPreserve);
    }
    if (wanted.empty() || spirv.size() < kHeaderWords) {
        return {spirv.begin(), spirv.end()};
    }
    // Capabilities come first, and execution modes right behind the only entry point.
    std::vector<uint32_t> words(spirv.begin(), spirv.begin() + kHeaderWords);
    for (const Mode& mode : wanted) {
        words.insert(words.end(), {firstWord(kOpCapability, 2), mode.capability});
    }
    for (std::size_t at = kHeaderWords; at < spirv.size();) {
        const std::size_t count = spirv[at] >> 16u;
        if (count == 0 || count > spirv.size() - at) {
            return {spirv.begin(), spirv.end()}; // damaged: the driver says so
        }
        words.insert(words.end(), spirv.begin() + static_cast<std::ptrdiff_t>(at),
                     spirv.begin() + static_cast<std::ptrdiff_t>(at + count));
        if ((spirv[at] & kOpcodeMask) == kOpEntryPoint) {
            for (const Mode& mode : wanted) {
                words.insert(words.end(),
                             {firstWord(kOpExecutionMode, 4), spirv[at + 2], mode.executionMode, kFloatBits});
            }
        }
        at += count;
    }
    return words;
}

} // namespace metamarch::vulkan

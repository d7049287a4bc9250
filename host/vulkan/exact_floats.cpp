// SPDX-License-Identifier: MIT
#include "metamarch/vulkan/exact_floats.h"

#include "metamarch/vulkan/spirv_instructions.h"

#include <algorithm>
#include <array>

namespace metamarch::vulkan {
namespace {

// The SPIR-V specification 1.5, sections 2.4, 3.6, 3.20, 3.31 and 3.36.
constexpr uint32_t kOpEntryPoint = 15;
constexpr uint32_t kOpExecutionMode = 16;
constexpr uint32_t kOpCapability = 17;
constexpr uint32_t kOpTypeVoid = 19;
constexpr uint32_t kOpDecorate = 71;
constexpr uint32_t kNoContraction = 42;
constexpr uint32_t kFloatBits = 32;

struct Mode {
    uint32_t capability;
    uint32_t executionMode;
};
constexpr Mode kSignedZeroInfNanPreserve{4466, 4461};
constexpr Mode kRoundingModeRte{4467, 4462};

// Whether it is an arithmetic instruction with a float result: OpFNegate, OpFAdd, OpFSub, OpFMul, OpFDiv,
// OpFRem, OpFMod, products of vectors and matrices, and OpDot. Its second operand is the result.
constexpr bool isFloatArithmetic(const uint32_t opcode) {
    constexpr std::array kOpcodes = {127u, 129u, 131u, 133u, 136u, 140u, 141u,
                                     142u, 143u, 144u, 145u, 146u, 147u, 148u};
    return std::ranges::find(kOpcodes, opcode) != kOpcodes.end();
}

} // namespace

std::vector<uint32_t> withExactFloats(const std::span<const uint32_t> spirv, const FloatModes& modes) {
    const std::vector<SpirvInstruction> all = spirvInstructions(spirv);
    if (all.empty()) {
        return {spirv.begin(), spirv.end()};
    }
    std::vector<Mode> wanted;
    if (modes.roundsToNearestEven) {
        wanted.push_back(kRoundingModeRte);
    }
    if (modes.keepsSignsInfinitiesAndNans) {
        wanted.push_back(kSignedZeroInfNanPreserve);
    }
    // Capabilities come first, execution modes right behind the only entry point, and decorations before the
    // first type, which is the void of main.
    std::vector<uint32_t> words(spirv.begin(), spirv.begin() + kSpirvHeaderWords);
    for (const Mode& mode : wanted) {
        words.insert(words.end(), {firstSpirvWord(kOpCapability, 2), mode.capability});
    }
    for (const SpirvInstruction instruction : all) {
        const uint32_t opcode = opcodeOf(instruction);
        if (opcode == kOpTypeVoid) {
            for (const SpirvInstruction other : all) {
                if (isFloatArithmetic(opcodeOf(other))) {
                    words.insert(words.end(), {firstSpirvWord(kOpDecorate, 3), other[2], kNoContraction});
                }
            }
        }
        words.insert(words.end(), instruction.begin(), instruction.end());
        if (opcode == kOpEntryPoint) {
            for (const Mode& mode : wanted) {
                words.insert(words.end(), {firstSpirvWord(kOpExecutionMode, 4), instruction[2],
                                           mode.executionMode, kFloatBits});
            }
        }
    }
    return words;
}

} // namespace metamarch::vulkan

// SPDX-License-Identifier: MIT
#include "metamarch/vulkan/exact_floats.h"

#include "metamarch/vulkan/spirv_instructions.h"

#include <spirv/unified1/spirv.hpp>

namespace metamarch::vulkan {
namespace {

constexpr uint32_t kFloatBits = 32;

struct Mode {
    spv::Capability capability;
    spv::ExecutionMode executionMode;
};
constexpr Mode kSignedZeroInfNanPreserve{spv::CapabilitySignedZeroInfNanPreserve,
                                         spv::ExecutionModeSignedZeroInfNanPreserve};
constexpr Mode kRoundingModeRte{spv::CapabilityRoundingModeRTE, spv::ExecutionModeRoundingModeRTE};

// The operations that NoContraction is meant for. Their second operand is the result.
constexpr bool isFloatArithmetic(const uint32_t opcode) {
    switch (opcode) {
    case spv::OpFNegate:
    case spv::OpFAdd:
    case spv::OpFSub:
    case spv::OpFMul:
    case spv::OpFDiv:
    case spv::OpFRem:
    case spv::OpFMod:
    case spv::OpVectorTimesScalar:
    case spv::OpMatrixTimesScalar:
    case spv::OpVectorTimesMatrix:
    case spv::OpMatrixTimesVector:
    case spv::OpMatrixTimesMatrix:
    case spv::OpOuterProduct:
    case spv::OpDot:
        return true;
    default:
        return false;
    }
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
    // first type. Constants and variables follow types.
    bool isDecorated = false;
    std::vector<uint32_t> words(spirv.begin(), spirv.begin() + kSpirvHeaderWords);
    for (const Mode& mode : wanted) {
        words.insert(words.end(), {firstSpirvWord(spv::OpCapability, 2), mode.capability});
    }
    for (const SpirvInstruction instruction : all) {
        const uint32_t opcode = opcodeOf(instruction);
        if (!isDecorated && spv::OpTypeVoid <= opcode && opcode <= spv::OpTypeForwardPointer) {
            isDecorated = true;
            for (const SpirvInstruction other : all) {
                if (isFloatArithmetic(opcodeOf(other))) {
                    words.insert(words.end(), {firstSpirvWord(spv::OpDecorate, 3), other[2],
                                               spv::DecorationNoContraction});
                }
            }
        }
        words.insert(words.end(), instruction.begin(), instruction.end());
        if (opcode == spv::OpEntryPoint) {
            for (const Mode& mode : wanted) {
                words.insert(words.end(), {firstSpirvWord(spv::OpExecutionMode, 4), instruction[2],
                                           mode.executionMode, kFloatBits});
            }
        }
    }
    return words;
}

} // namespace metamarch::vulkan

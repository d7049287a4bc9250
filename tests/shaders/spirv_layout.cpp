// SPDX-License-Identifier: MIT
#include "shaders/spirv_layout.h"

#include <bit>
#include <spirv/unified1/spirv.hpp>
#include <stdexcept>

namespace metamarch::tests {
namespace {

static_assert(std::endian::native == std::endian::little, "strings lie in words with the low byte first");

constexpr std::size_t kHeaderWords = 5;

std::string text(const std::span<const std::uint32_t> words) {
    return {reinterpret_cast<const char*>(words.data())}; // SPIR-V ends strings with a zero
}

SpirvMember& member(SpirvStruct& owner, const std::uint32_t index) {
    if (owner.members.size() <= index) {
        owner.members.resize(index + std::size_t{1});
    }
    return owner.members[index];
}

// `operands` are the words of the instruction after the first one. SPIR-V names and decorates a type before
// it declares the type.
void readInstruction(const spv::Op op, const std::span<const std::uint32_t> operands,
                     std::map<std::uint32_t, std::string>& names, SpirvLayout& layout) {
    switch (op) {
    case spv::OpName:
        names[operands[0]] = text(operands.subspan(1));
        break;
    case spv::OpMemberName:
        member(layout.structs[operands[0]], operands[1]).name = text(operands.subspan(2));
        break;
    case spv::OpMemberDecorate:
        if (operands[2] == spv::DecorationOffset) {
            member(layout.structs[operands[0]], operands[1]).offset = operands[3];
        }
        break;
    case spv::OpDecorate:
        if (operands[1] == spv::DecorationArrayStride) {
            layout.arrays[operands[0]].stride = operands[2];
        } else if (operands[1] == spv::DecorationBlock) {
            layout.structs[operands[0]].isBlock = true;
        } else if (operands[1] == spv::DecorationNoContraction) {
            layout.exactIds.insert(operands[0]);
        }
        break;
    case spv::OpTypeInt:
    case spv::OpTypeFloat:
        layout.numbers[operands[0]] = operands[1] / 8;
        break;
    case spv::OpTypeVector:
        if (const auto component = layout.numbers.find(operands[1]); component != layout.numbers.end()) {
            layout.numbers[operands[0]] =
                component->second * operands[2]; // bool is no number and has no size
        }
        break;
    case spv::OpTypeArray:
    case spv::OpTypeRuntimeArray:
        layout.arrays[operands[0]].elementTypeId = operands[1];
        break;
    case spv::OpTypeStruct: {
        SpirvStruct& declared = layout.structs[operands[0]];
        declared.name = names[operands[0]];
        for (std::uint32_t i = 1; i < operands.size(); ++i) {
            member(declared, i - 1).typeId = operands[i];
        }
        break;
    }
    case spv::OpVariable:
        layout.storageBuffers += operands[2] == spv::StorageClassStorageBuffer ? 1 : 0;
        layout.texelBuffers += operands[2] == spv::StorageClassUniformConstant ? 1 : 0;
        break;
    case spv::OpFNegate:
    case spv::OpFAdd:
    case spv::OpFSub:
    case spv::OpFMul:
    case spv::OpFDiv:
    case spv::OpFRem:
    case spv::OpFMod:
    case spv::OpDot:
    case spv::OpVectorTimesScalar:
    case spv::OpMatrixTimesScalar:
    case spv::OpVectorTimesMatrix:
    case spv::OpMatrixTimesVector:
    case spv::OpMatrixTimesMatrix:
        ++(layout.exactIds.contains(operands[1]) ? layout.exactFloatOperations : layout.looseFloatOperations);
        break;
    default:
        break;
    }
}

} // namespace

SpirvLayout readLayout(const std::span<const std::uint32_t> spirv) {
    if (spirv.size() < kHeaderWords || spirv[0] != spv::MagicNumber) {
        throw std::runtime_error("not SPIR-V");
    }
    SpirvLayout layout;
    std::map<std::uint32_t, std::string> names;
    for (std::size_t at = kHeaderWords; at < spirv.size();) {
        const std::size_t length = spirv[at] >> spv::WordCountShift;
        if (length == 0 || length > spirv.size() - at) {
            throw std::runtime_error("SPIR-V with an instruction of a wrong length");
        }
        readInstruction(static_cast<spv::Op>(spirv[at] & spv::OpCodeMask), spirv.subspan(at + 1, length - 1),
                        names, layout);
        at += length;
    }
    return layout;
}

} // namespace metamarch::tests

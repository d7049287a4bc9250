// SPDX-License-Identifier: MIT
#include "metamarch/vulkan/initializers.h"

#include "metamarch/vulkan/spirv_instructions.h"

#include <algorithm>
#include <map>
#include <set>
#include <spirv/unified1/spirv.hpp>

namespace metamarch::vulkan {
namespace {

// Types of numbers, and what is made of them. Other types, such as images, have no zero.
class TypesWithZero {
  public:
    void add(const SpirvInstruction type) {
        const auto hasZero = [&](const uint32_t id) { return types_.contains(id); };
        if (type.size() < 2) {
            return; // the module is damaged
        }
        switch (opcodeOf(type)) {
        case spv::OpTypeBool:
        case spv::OpTypeInt:
        case spv::OpTypeFloat:
            types_.insert(type[1]);
            break;
        case spv::OpTypeVector:
        case spv::OpTypeMatrix:
        case spv::OpTypeArray:
            if (type.size() > 2 && hasZero(type[2])) {
                types_.insert(type[1]);
            }
            break;
        case spv::OpTypeStruct:
            if (std::ranges::all_of(type.subspan(2), hasZero)) {
                types_.insert(type[1]);
            }
            break;
        default:
            break;
        }
    }

    bool contains(const uint32_t type) const { return types_.contains(type); }

  private:
    std::set<uint32_t> types_;
};

constexpr std::size_t kVariableWords = 4; // without initializer

bool isLocalWithoutInitializer(const SpirvInstruction instruction) {
    return opcodeOf(instruction) == spv::OpVariable && instruction.size() == kVariableWords &&
           instruction[3] == spv::StorageClassFunction;
}

} // namespace

std::vector<uint32_t> withInitializers(const std::span<const uint32_t> spirv) {
    const std::vector<SpirvInstruction> all = spirvInstructions(spirv);
    if (all.empty()) {
        return {spirv.begin(), spirv.end()};
    }
    uint32_t bound = spirv[kSpirvBound];
    TypesWithZero types;
    std::map<uint32_t, uint32_t> pointees; // by the type of the pointer
    std::map<uint32_t, uint32_t> zeros;    // by type
    for (const SpirvInstruction instruction : all) {
        types.add(instruction);
        if (opcodeOf(instruction) == spv::OpTypePointer && instruction.size() == 4 &&
            types.contains(instruction[3])) {
            pointees.emplace(instruction[1], instruction[3]);
        }
        if (isLocalWithoutInitializer(instruction)) {
            const auto pointee = pointees.find(instruction[1]);
            if (pointee != pointees.end() && zeros.emplace(pointee->second, bound).second) {
                ++bound;
            }
        }
    }
    std::vector<uint32_t> words(spirv.begin(), spirv.begin() + kSpirvHeaderWords);
    words[kSpirvBound] = bound;
    bool isInFunctions = false;
    for (const SpirvInstruction instruction : all) {
        if (opcodeOf(instruction) == spv::OpFunction && !isInFunctions) {
            isInFunctions = true;
            for (const auto& [type, zero] : zeros) {
                words.insert(words.end(), {firstSpirvWord(spv::OpConstantNull, 3), type, zero});
            }
        }
        const std::size_t begin = words.size();
        words.insert(words.end(), instruction.begin(), instruction.end());
        if (isLocalWithoutInitializer(instruction) && pointees.contains(instruction[1])) {
            words[begin] = firstSpirvWord(spv::OpVariable, kVariableWords + 1);
            words.push_back(zeros.at(pointees.at(instruction[1])));
        }
    }
    return words;
}

} // namespace metamarch::vulkan

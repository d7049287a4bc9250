// SPDX-License-Identifier: MIT
#include "metamarch/vulkan/else_branches.h"

#include "metamarch/vulkan/spirv_instructions.h"

#include <map>
#include <spirv/unified1/spirv.hpp>
#include <utility>

namespace metamarch::vulkan {
namespace {

// The selection `header` with the blocks of its first branch at [first, second) and those of its second one
// at [second, end). All are indices of instructions.
struct IfElse {
    std::size_t header = 0; // its conditional branch
    std::size_t first = 0;
    std::size_t second = 0;
    std::size_t end = 0;
};

class ElseBranches {
  public:
    explicit ElseBranches(const std::span<const uint32_t> spirv)
        : all_(spirvInstructions(spirv)), header_(spirv.first(kSpirvHeaderWords)),
          bound_(spirv[kSpirvBound]) {
        for (std::size_t i = 0; i < all_.size(); ++i) {
            if (is(i, spv::OpLabel, 2)) {
                labels_.emplace(all_[i][1], i);
            }
        }
    }

    std::vector<uint32_t> split() {
        for (std::size_t i = 1; i < all_.size(); ++i) {
            if (is(i, spv::OpBranchConditional, 4) && is(i - 1, spv::OpSelectionMerge, 3)) {
                splitAt({i, at(all_[i][2]), at(all_[i][3]), at(all_[i - 1][1])});
            }
        }
        std::vector<uint32_t> words(header_.begin(), header_.end());
        words[kSpirvBound] = bound_;
        for (std::size_t i = 0; i < all_.size(); ++i) {
            if (const auto block = blocksBefore_.find(i); block != blocksBefore_.end()) {
                words.insert(words.end(), block->second.begin(), block->second.end());
            }
            const std::size_t begin = words.size();
            words.insert(words.end(), all_[i].begin(), all_[i].end());
            if (const auto changed = changedWords_.find(i); changed != changedWords_.end()) {
                words[begin + changed->second.first] = changed->second.second;
            }
        }
        return words;
    }

  private:
    // Returns true if the instruction has this opcode and no fewer words.
    bool is(const std::size_t i, const spv::Op opcode, const std::size_t words) const {
        return opcodeOf(all_[i]) == opcode && all_[i].size() >= words;
    }

    std::size_t at(const uint32_t label) const {
        const auto found = labels_.find(label);
        return found == labels_.end() ? 0 : found->second;
    }

    // Returns the branches among [begin, end) that go to a label.
    std::vector<std::size_t> branchesTo(const uint32_t label, const std::size_t begin,
                                        const std::size_t end) const {
        std::vector<std::size_t> found;
        for (std::size_t i = begin; i < end; ++i) {
            if (is(i, spv::OpBranch, 2) && all_[i][1] == label) {
                found.push_back(i);
            }
        }
        return found;
    }

    // Lets the first branch end at a new block, which takes the second branch where the condition is false.
    void splitAt(const IfElse& selection) {
        const auto& [header, first, second, end] = selection;
        const bool isInOrder = header < first && first < second && second < end && end + 1 < all_.size();
        if (!isInOrder || opcodeOf(all_[end + 1]) == spv::OpPhi) {
            return;
        }
        const uint32_t merge = all_[end][1];
        const std::vector<std::size_t> ends = branchesTo(merge, first, second);
        if (ends.empty() || branchesTo(merge, second, end).empty()) {
            return; // at most one of them comes to the end
        }
        const uint32_t between = bound_++;
        for (const std::size_t branch : ends) {
            changedWords_[branch] = {1, between};
        }
        changedWords_[header - 1] = {1, between};
        changedWords_[header] = {3, between};
        blocksBefore_[second] = {firstSpirvWord(spv::OpLabel, 2),
                                 between,
                                 firstSpirvWord(spv::OpSelectionMerge, 3),
                                 merge,
                                 spv::SelectionControlMaskNone,
                                 firstSpirvWord(spv::OpBranchConditional, 4),
                                 all_[header][1],
                                 merge,
                                 all_[second][1]};
    }

    std::vector<SpirvInstruction> all_;
    std::span<const uint32_t> header_;
    uint32_t bound_;
    std::map<uint32_t, std::size_t> labels_; // indices of instructions, by label
    std::map<std::size_t, std::pair<std::size_t, uint32_t>>
        changedWords_;                                          // by instruction: which one, to what
    std::map<std::size_t, std::vector<uint32_t>> blocksBefore_; // by instruction
};

} // namespace

std::vector<uint32_t> withoutElseBranches(const std::span<const uint32_t> spirv) {
    if (spirvInstructions(spirv).empty()) {
        return {spirv.begin(), spirv.end()};
    }
    return ElseBranches(spirv).split();
}

} // namespace metamarch::vulkan

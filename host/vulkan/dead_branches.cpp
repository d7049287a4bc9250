// SPDX-License-Identifier: MIT
#include "metamarch/vulkan/dead_branches.h"

#include "metamarch/vulkan/spirv_instructions.h"

#define SPV_ENABLE_UTILITY_CODE
#include <algorithm>
#include <optional>
#include <set>
#include <spirv/unified1/spirv.hpp>
#include <utility>

namespace metamarch::vulkan {
namespace {

using Instructions = std::span<const SpirvInstruction>;
using Words = std::vector<uint32_t>;

// The values of ids, as far as the specialization constants decide them. A bool is 0 or 1.
using Values = std::map<uint32_t, uint32_t>;

std::optional<uint32_t> valueOf(const Values& values, const uint32_t id) {
    const auto found = values.find(id);
    return found == values.end() ? std::nullopt : std::optional(found->second);
}

// Returns the result id, 0 if the instruction has none.
uint32_t resultOf(const SpirvInstruction instruction) {
    bool hasResult = false;
    bool hasType = false;
    spv::HasResultAndType(static_cast<spv::Op>(opcodeOf(instruction)), &hasResult, &hasType);
    return hasResult ? instruction[hasType ? 2 : 1] : 0;
}

// Returns what an operation gives for operands of 32 bits, if they decide it.
std::optional<uint32_t> computed(const uint32_t opcode, const std::optional<uint32_t> a,
                                 const std::optional<uint32_t> b) {
    switch (opcode) {
    case spv::OpLogicalAnd:
        if (a == 0u || b == 0u) {
            return 0u;
        }
        break;
    case spv::OpLogicalOr:
        if (a == 1u || b == 1u) {
            return 1u;
        }
        break;
    case spv::OpLogicalNot:
        return a ? std::optional(1u - *a) : std::nullopt;
    default:
        break;
    }
    if (!a || !b) {
        return std::nullopt;
    }
    switch (opcode) {
    case spv::OpBitwiseAnd:
    case spv::OpLogicalAnd:
        return *a & *b;
    case spv::OpBitwiseOr:
    case spv::OpLogicalOr:
        return *a | *b;
    case spv::OpIEqual:
    case spv::OpLogicalEqual:
        return *a == *b ? 1u : 0u;
    case spv::OpINotEqual:
    case spv::OpLogicalNotEqual:
        return *a != *b ? 1u : 0u;
    default:
        return std::nullopt;
    }
}

// Returns the value of an operation whose operands begin at word `first`. `known` returns the value of an id.
template <class Known>
std::optional<uint32_t> computed(const Known& known, const uint32_t opcode, const SpirvInstruction whole,
                                 const std::size_t first) {
    const auto operand = [&](const std::size_t i) {
        return i < whole.size() ? known(whole[i]) : std::nullopt;
    };
    return whole.size() > first + 2 ? std::nullopt : computed(opcode, operand(first), operand(first + 1));
}

// The values of the constants of 32 bits and of bools.
Values constantsOf(const Instructions all, const std::map<uint32_t, uint32_t>& specialization) {
    std::map<uint32_t, uint32_t> constantIds; // of ids
    Values values;
    for (const SpirvInstruction instruction : all) {
        switch (opcodeOf(instruction)) {
        case spv::OpDecorate:
            if (instruction.size() == 4 && instruction[2] == spv::DecorationSpecId) {
                constantIds.emplace(instruction[1], instruction[3]);
            }
            break;
        case spv::OpConstantTrue:
            values.emplace(instruction[2], 1u);
            break;
        case spv::OpConstantFalse:
            values.emplace(instruction[2], 0u);
            break;
        case spv::OpConstant:
        case spv::OpSpecConstant:
            if (instruction.size() == 4) {
                const auto constantId = constantIds.find(instruction[2]);
                const auto given = constantId == constantIds.end() ? specialization.end()
                                                                   : specialization.find(constantId->second);
                values.emplace(instruction[2],
                               given == specialization.end() ? instruction[3] : given->second);
            }
            break;
        case spv::OpSpecConstantOp:
            if (const auto value = computed([&](const uint32_t id) { return valueOf(values, id); },
                                            instruction[3], instruction, 4)) {
                values.emplace(instruction[2], *value);
            }
            break;
        default:
            break;
        }
    }
    return values;
}

// A function without the blocks that no branch reaches.
class LiveFunction {
  public:
    LiveFunction(const Instructions function, const Values& constants)
        : whole_(function), constants_(constants) {
        isUnderstood_ = cutIntoBlocks() && findLiveBlocks() && keepsLoops();
    }

    // Calls `visit` with each function that is called.
    template <class Visit>
    void visitCalls(const Visit& visit) const {
        const auto visitThoseOf = [&](const Instructions instructions) {
            for (const SpirvInstruction instruction : instructions) {
                if (opcodeOf(instruction) == spv::OpFunctionCall) {
                    visit(instruction[3]);
                }
            }
        };
        if (!isUnderstood_) {
            visitThoseOf(whole_);
            return;
        }
        for (const Block& block : blocks_) {
            if (block.isLive) {
                visitThoseOf(block.instructions);
            }
        }
    }

    void appendTo(Words& words, std::set<uint32_t>& removed) const;

  private:
    struct Block {
        uint32_t label = 0;
        Instructions instructions; // with the label
        bool isLive = false;
        bool isMerge = false;             // of a live block
        uint32_t headerOfContinue = 0;    // the live loop that it continues, 0 if none
        std::optional<uint32_t> branch{}; // the only target, where a condition is decided
    };

    SpirvInstruction lastOf(const Block& block) const { return block.instructions.back(); }
    const SpirvInstruction* mergeOf(const Block& block) const;
    std::vector<uint32_t> targetsOf(const Block& block) const;
    bool isEdge(uint32_t from, uint32_t to) const;

    std::optional<uint32_t> known(uint32_t id) const;
    bool cutIntoBlocks();
    bool findLiveBlocks();
    bool keepsLoops() const;
    void evaluate(std::size_t index);
    std::optional<uint32_t> valueOfPhi(SpirvInstruction phi, std::size_t index) const;
    void appendBlock(const Block& block, Words& words, std::set<uint32_t>& removed) const;
    void appendPhi(SpirvInstruction phi, uint32_t label, Words& words) const;

    Instructions whole_;
    const Values& constants_;
    Values values_;
    std::size_t head_ = 0; // number of instructions before the first block
    std::vector<Block> blocks_;
    std::map<uint32_t, std::size_t> indices_; // of blocks, by label
    bool isUnderstood_ = false;
};

void append(Words& words, const SpirvInstruction instruction) {
    words.insert(words.end(), instruction.begin(), instruction.end());
}

std::optional<uint32_t> LiveFunction::known(const uint32_t id) const {
    const std::optional<uint32_t> own = valueOf(values_, id);
    return own ? own : valueOf(constants_, id);
}

bool endsBlock(const uint32_t opcode) {
    switch (opcode) {
    case spv::OpBranch:
    case spv::OpBranchConditional:
    case spv::OpSwitch:
    case spv::OpReturn:
    case spv::OpReturnValue:
    case spv::OpKill:
    case spv::OpUnreachable:
        return true;
    default:
        return false;
    }
}

// Returns whether every block ends in a way that is known here.
bool LiveFunction::cutIntoBlocks() {
    std::size_t begin = 0; // of the open block, 0 if there is none
    for (std::size_t i = 0; i < whole_.size(); ++i) {
        if (opcodeOf(whole_[i]) == spv::OpLabel) {
            if (begin != 0) {
                return false;
            }
            head_ = blocks_.empty() ? i : head_;
            begin = i;
        } else if (begin != 0 && endsBlock(opcodeOf(whole_[i]))) {
            const uint32_t label = whole_[begin][1];
            indices_.emplace(label, blocks_.size());
            blocks_.push_back({.label = label, .instructions = whole_.subspan(begin, i + 1 - begin)});
            begin = 0;
        }
    }
    return begin == 0 && !blocks_.empty();
}

// Returns the instruction that declares where the block's construct ends; null if there is none.
const SpirvInstruction* LiveFunction::mergeOf(const Block& block) const {
    if (block.instructions.size() < 2) {
        return nullptr;
    }
    const SpirvInstruction& before = block.instructions[block.instructions.size() - 2];
    const uint32_t opcode = opcodeOf(before);
    return opcode == spv::OpSelectionMerge || opcode == spv::OpLoopMerge ? &before : nullptr;
}

std::vector<uint32_t> LiveFunction::targetsOf(const Block& block) const {
    if (block.branch) {
        return {*block.branch};
    }
    const SpirvInstruction last = lastOf(block);
    switch (opcodeOf(last)) {
    case spv::OpBranch:
        return {last[1]};
    case spv::OpBranchConditional:
        return {last[2], last[3]};
    case spv::OpSwitch: { // literals of one word
        std::vector<uint32_t> targets{last[2]};
        for (std::size_t i = 4; i < last.size(); i += 2) {
            targets.push_back(last[i]);
        }
        return targets;
    }
    default:
        return {};
    }
}

bool LiveFunction::isEdge(const uint32_t from, const uint32_t to) const {
    const auto block = indices_.find(from);
    if (block == indices_.end() || !blocks_[block->second].isLive) {
        return false;
    }
    const std::vector<uint32_t> targets = targetsOf(blocks_[block->second]);
    return std::ranges::find(targets, to) != targets.end();
}

// A value that comes around a loop is not known.
std::optional<uint32_t> LiveFunction::valueOfPhi(const SpirvInstruction phi, const std::size_t index) const {
    std::optional<uint32_t> value;
    for (std::size_t i = 3; i + 1 < phi.size(); i += 2) {
        const auto from = indices_.find(phi[i + 1]);
        if (from == indices_.end() || from->second >= index) {
            return std::nullopt;
        }
        if (isEdge(phi[i + 1], blocks_[index].label)) {
            const std::optional<uint32_t> one = known(phi[i]);
            if (!one || (value && value != one)) {
                return std::nullopt;
            }
            value = one;
        }
    }
    return value;
}

// Learns the values of a live block, and whether they decide how it ends.
void LiveFunction::evaluate(const std::size_t index) {
    Block& block = blocks_[index];
    for (const SpirvInstruction instruction : block.instructions) {
        const bool isPhi = opcodeOf(instruction) == spv::OpPhi;
        const uint32_t result = resultOf(instruction);
        if (result == 0 || instruction.size() < 4) {
            continue;
        }
        const auto value = isPhi ? valueOfPhi(instruction, index)
                                 : computed([&](const uint32_t id) { return known(id); },
                                            opcodeOf(instruction), instruction, 3);
        if (value) {
            values_.emplace(result, *value);
        }
    }
    const SpirvInstruction last = lastOf(block);
    const SpirvInstruction* const merge = mergeOf(block);
    // A branch without a selection of its own leaves a loop or a switch, which needs it.
    if (opcodeOf(last) == spv::OpBranchConditional && merge != nullptr &&
        opcodeOf(*merge) == spv::OpSelectionMerge) {
        if (const auto condition = known(last[1])) {
            block.branch = *condition != 0 ? last[2] : last[3];
        }
    }
}

// Returns whether the function's blocks are in the order in which branches reach them, as glslang puts them.
bool LiveFunction::findLiveBlocks() {
    blocks_.front().isLive = true;
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
        if (!blocks_[i].isLive) {
            continue;
        }
        evaluate(i);
        for (const uint32_t target : targetsOf(blocks_[i])) {
            const auto found = indices_.find(target);
            if (found == indices_.end() || (found->second <= i && !blocks_[found->second].isLive)) {
                return false;
            }
            blocks_[found->second].isLive = true;
        }
        const SpirvInstruction* const merge = mergeOf(blocks_[i]);
        if (merge == nullptr || blocks_[i].branch) {
            continue;
        }
        const auto end = indices_.find((*merge)[1]);
        if (end == indices_.end()) {
            return false;
        }
        blocks_[end->second].isMerge = true;
        if (opcodeOf(*merge) == spv::OpLoopMerge) {
            const auto again = indices_.find((*merge)[2]);
            if (again == indices_.end()) {
                return false;
            }
            blocks_[again->second].headerOfContinue = blocks_[i].label;
        }
    }
    return true;
}

// Returns whether each loop that is never continued goes on without a value from its last turn.
bool LiveFunction::keepsLoops() const {
    return std::ranges::none_of(blocks_, [&](const Block& block) {
        if (block.headerOfContinue == 0 || block.isLive) {
            return false;
        }
        const Block& header = blocks_[indices_.at(block.headerOfContinue)];
        return std::ranges::any_of(header.instructions, [](const SpirvInstruction instruction) {
            return opcodeOf(instruction) == spv::OpPhi;
        });
    });
}

void LiveFunction::appendPhi(const SpirvInstruction phi, const uint32_t label, Words& words) const {
    const std::size_t first = words.size();
    words.insert(words.end(), phi.begin(), phi.begin() + 3);
    for (std::size_t i = 3; i + 1 < phi.size(); i += 2) {
        if (isEdge(phi[i + 1], label)) {
            words.insert(words.end(), {phi[i], phi[i + 1]});
        }
    }
    words[first] = firstSpirvWord(spv::OpPhi, static_cast<uint32_t>(words.size() - first));
}

void LiveFunction::appendBlock(const Block& block, Words& words, std::set<uint32_t>& removed) const {
    if (!block.isLive) {
        for (const SpirvInstruction instruction : block.instructions) {
            removed.insert(resultOf(instruction));
        }
        // A construct needs its blocks, also where nothing reaches them.
        if (block.headerOfContinue != 0 || block.isMerge) {
            append(words, block.instructions.front());
            removed.erase(block.label);
        }
        if (block.headerOfContinue != 0) {
            words.insert(words.end(), {firstSpirvWord(spv::OpBranch, 2), block.headerOfContinue});
        } else if (block.isMerge) {
            words.push_back(firstSpirvWord(spv::OpUnreachable, 1));
        }
        return;
    }
    for (const SpirvInstruction instruction : block.instructions.first(block.instructions.size() - 1)) {
        if (opcodeOf(instruction) == spv::OpPhi) {
            appendPhi(instruction, block.label, words);
        } else if (!block.branch || opcodeOf(instruction) != spv::OpSelectionMerge) {
            append(words, instruction);
        }
    }
    if (block.branch) {
        words.insert(words.end(), {firstSpirvWord(spv::OpBranch, 2), *block.branch});
    } else {
        append(words, lastOf(block));
    }
}

void LiveFunction::appendTo(Words& words, std::set<uint32_t>& removed) const {
    if (!isUnderstood_) {
        for (const SpirvInstruction instruction : whole_) {
            append(words, instruction);
        }
        return;
    }
    for (const SpirvInstruction instruction : whole_.first(head_)) {
        append(words, instruction);
    }
    for (const Block& block : blocks_) {
        appendBlock(block, words, removed);
    }
    append(words, whole_.back());
}

// The functions by their ids, in the order of the module.
std::vector<std::pair<uint32_t, Instructions>> functionsOf(const Instructions all) {
    std::vector<std::pair<uint32_t, Instructions>> functions;
    std::size_t begin = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (opcodeOf(all[i]) == spv::OpFunction) {
            begin = i;
        } else if (opcodeOf(all[i]) == spv::OpFunctionEnd) {
            functions.emplace_back(all[begin][2], all.subspan(begin, i + 1 - begin));
        }
    }
    return functions;
}

// Returns true for decorations that this file does not follow.
bool decoratesOtherwise(const uint32_t opcode) {
    return opcode == spv::OpGroupDecorate || opcode == spv::OpDecorateId;
}

bool isForDebuggers(const uint32_t opcode) {
    return opcode == spv::OpName || opcode == spv::OpMemberName || opcode == spv::OpLine ||
           opcode == spv::OpNoLine;
}

} // namespace

std::vector<uint32_t> withoutDeadBranches(const std::span<const uint32_t> spirv,
                                          const std::map<uint32_t, uint32_t>& specialization) {
    std::vector<SpirvInstruction> all = spirvInstructions(spirv);
    std::erase_if(all,
                  [](const SpirvInstruction instruction) { return isForDebuggers(opcodeOf(instruction)); });
    const auto functions = functionsOf(all);
    const auto entry = std::ranges::find(all, uint32_t{spv::OpEntryPoint}, opcodeOf);
    if (functions.empty() || std::ranges::count(all, uint32_t{spv::OpEntryPoint}, opcodeOf) != 1 ||
        std::ranges::any_of(all, decoratesOtherwise, opcodeOf)) {
        return {spirv.begin(), spirv.end()};
    }
    const Values constants = constantsOf(all, specialization);
    std::map<uint32_t, LiveFunction> live;
    std::vector<uint32_t> called{(*entry)[2]};
    while (!called.empty()) {
        const uint32_t id = called.back();
        called.pop_back();
        const auto function = std::ranges::find(functions, id, [](const auto& one) { return one.first; });
        if (function != functions.end() && !live.contains(id)) {
            live.emplace(id, LiveFunction(function->second, constants))
                .first->second.visitCalls([&](const uint32_t other) { called.push_back(other); });
        }
    }

    Words bodies;
    std::set<uint32_t> removed;
    for (const auto& [id, instructions] : functions) {
        if (const auto found = live.find(id); found != live.end()) {
            found->second.appendTo(bodies, removed);
        } else {
            for (const SpirvInstruction instruction : instructions) {
                removed.insert(resultOf(instruction));
            }
        }
    }
    Words words(spirv.begin(), spirv.begin() + kSpirvHeaderWords);
    for (const SpirvInstruction instruction : all) {
        const uint32_t opcode = opcodeOf(instruction);
        if (opcode == spv::OpFunction) {
            break;
        }
        if (opcode != spv::OpDecorate || !removed.contains(instruction[1])) {
            append(words, instruction);
        }
    }
    append(words, bodies);
    return words;
}

} // namespace metamarch::vulkan

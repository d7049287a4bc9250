// SPDX-License-Identifier: MIT
#include "rough_division.h"

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <map>
#include <span>
#include <spirv/unified1/spirv.hpp>

namespace {

using Words = std::vector<std::uint32_t>;

constexpr std::size_t kHeader = 5; // words before the first instruction
constexpr std::size_t kBound = 3;  // the header's word with a number above all ids

struct Vector {
    std::uint32_t component = 0; // type id
    std::uint32_t count = 0;
};

class Rewriter {
  public:
    explicit Rewriter(const Words& spirv) : spirv_(spirv), result_(spirv.begin(), spirv.begin() + kHeader) {}

    Words run() {
        for (std::size_t at = kHeader; at < spirv_.size();) {
            const std::size_t length = spirv_[at] >> spv::WordCountShift;
            const std::span<const std::uint32_t> words(&spirv_[at], length);
            const std::uint32_t opcode = words[0] & spv::OpCodeMask;
            if (opcode == spv::OpTypeInt && words[2] == 32 && words[3] == 0) {
                uint_ = words[1];
            } else if (opcode == spv::OpTypeVector) {
                vectors_[words[1]] = {words[2], words[3]};
            } else if (opcode == spv::OpFunction && one_ == 0) {
                one_ = constant(1);
                three_ = constant(3);
                five_ = constant(5);
            }
            if (opcode == spv::OpFDiv) {
                divide(words[1], words[2], words[3], words[4]);
            } else {
                result_.insert(result_.end(), words.begin(), words.end());
            }
            at += length;
        }
        return result_;
    }

  private:
    std::uint32_t newId() { return result_[kBound]++; }

    void emit(const spv::Op opcode, const std::initializer_list<std::uint32_t> operands) {
        result_.push_back(static_cast<std::uint32_t>(operands.size() + 1) << spv::WordCountShift | opcode);
        result_.insert(result_.end(), operands);
    }

    std::uint32_t computed(const spv::Op opcode, const std::uint32_t type, const std::uint32_t a,
                           const std::uint32_t b) {
        const std::uint32_t id = newId();
        emit(opcode, {type, id, a, b});
        return id;
    }

    std::uint32_t constant(const std::uint32_t value) {
        if (uint_ == 0) {
            std::fputs("rough_division: a module without 32-bit whole numbers\n", stderr);
            std::abort();
        }
        const std::uint32_t id = newId();
        emit(spv::OpConstant, {uint_, id, value});
        return id;
    }

    void divide(const std::uint32_t type, const std::uint32_t id, const std::uint32_t a,
                const std::uint32_t b) {
        const auto vector = vectors_.find(type);
        if (vector == vectors_.end()) {
            divideScalars(type, id, a, b);
            return;
        }
        const auto [component, count] = vector->second;
        Words parts = {type, id};
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint32_t above = computed(spv::OpCompositeExtract, component, a, i);
            const std::uint32_t below = computed(spv::OpCompositeExtract, component, b, i);
            parts.push_back(newId());
            divideScalars(component, parts.back(), above, below);
        }
        result_.push_back((count + 3) << spv::WordCountShift | spv::OpCompositeConstruct);
        result_.insert(result_.end(), parts.begin(), parts.end());
    }

    void divideScalars(const std::uint32_t type, const std::uint32_t id, const std::uint32_t a,
                       const std::uint32_t b) {
        const std::uint32_t quotient = computed(spv::OpFDiv, type, a, b);
        const std::uint32_t bits = newId();
        emit(spv::OpBitcast, {uint_, bits, quotient});
        const std::uint32_t up = bitOf(bits, three_);
        const std::uint32_t down = bitOf(bits, five_);
        const std::uint32_t steps = computed(spv::OpISub, uint_, up, down);
        const std::uint32_t ulps = computed(spv::OpShiftLeftLogical, uint_, steps, one_);
        const std::uint32_t moved = computed(spv::OpIAdd, uint_, bits, ulps);
        emit(spv::OpBitcast, {type, id, moved});
    }

    std::uint32_t bitOf(const std::uint32_t bits, const std::uint32_t place) {
        const std::uint32_t shifted = computed(spv::OpShiftRightLogical, uint_, bits, place);
        return computed(spv::OpBitwiseAnd, uint_, shifted, one_);
    }

    const Words& spirv_;
    Words result_;
    std::uint32_t uint_ = 0; // ids
    std::uint32_t one_ = 0;
    std::uint32_t three_ = 0;
    std::uint32_t five_ = 0;
    std::map<std::uint32_t, Vector> vectors_; // by type id
};

} // namespace

std::vector<std::uint32_t> withRoughDivision(const std::vector<std::uint32_t>& spirv) {
    return Rewriter(spirv).run();
}

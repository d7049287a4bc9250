// SPDX-License-Identifier: MIT
#include "metamarch/accel/wide_bvh.h"

#include "metamarch/error/error.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace metamarch {
namespace {

constexpr std::size_t kMostWideNodes = std::size_t{1} << (31u - kWideMaskBits);
constexpr int kExponentBias = 127;

struct ChildBox {
    std::uint32_t child; // of the binary tree
    glm::dvec3 lo;
    glm::dvec3 hi;
};

double halfAreaOf(const ChildBox& box) {
    const glm::dvec3 size = box.hi - box.lo;
    return size.x * size.y + size.y * size.z + size.z * size.x;
}

class Widener {
  public:
    explicit Widener(const Bvh& usedBvh) : bvh(usedBvh) {}

    std::vector<WideBvhNode> run() {
        append(0);
        return std::move(nodes);
    }

  private:
    struct Children {
        std::array<ChildBox, kWideChildren> boxes;
        std::size_t count = 0;

        void add(const std::uint32_t child, const vec3 lo, const vec3 hi) {
            if (child != kEmptyBvhLeaf) {
                boxes[count++] = {child, glm::dvec3(lo), glm::dvec3(hi)};
            }
        }
    };

    void addChildrenOf(const std::uint32_t nodeId, Children& children) const {
        const BvhNode& node = bvh.nodes[nodeId];
        children.add(node.child0, node.lo0, node.hi0);
        children.add(node.child1, node.lo1, node.hi1);
    }

    Children childrenOf(const std::uint32_t nodeId) const {
        Children children;
        addChildrenOf(nodeId, children);
        while (children.count < kWideChildren) {
            ChildBox* largest = nullptr;
            for (std::size_t i = 0; i < children.count; ++i) {
                ChildBox& box = children.boxes[i];
                if (!isBvhLeaf(box.child) && (!largest || halfAreaOf(box) > halfAreaOf(*largest))) {
                    largest = &box;
                }
            }
            if (!largest) {
                break;
            }
            const std::uint32_t opened = largest->child;
            *largest = children.boxes[--children.count];
            addChildrenOf(opened, children);
        }
        return children;
    }

    // Returns the exponent bits of the smallest power of two of which kMaxWideSteps reach over `length`.
    static std::uint32_t stepBits(const double length) {
        int exponent = 0;
        std::frexp(length / kMaxWideSteps, &exponent); // length / kMaxWideSteps < 2^exponent
        return static_cast<std::uint32_t>(std::max(exponent, 1 - kExponentBias) + kExponentBias);
    }

    // Boxes are rounded outwards. The origin is exact, because it is a corner of a child's box.
    static WideBvhNode pack(const Children& children) {
        WideBvhNode node{};
        glm::dvec3 lo(0.0);
        glm::dvec3 hi(0.0);
        for (std::size_t i = 0; i < children.count; ++i) {
            lo = i == 0 ? children.boxes[i].lo : glm::min(lo, children.boxes[i].lo);
            hi = i == 0 ? children.boxes[i].hi : glm::max(hi, children.boxes[i].hi);
        }
        node.origin = vec3(lo);
        for (int axis = 0; axis < 3; ++axis) {
            const std::uint32_t bits = stepBits(hi[axis] - lo[axis]);
            node.steps |= bits << (8 * axis);
            const double step = std::ldexp(1.0, static_cast<int>(bits) - kExponentBias);
            for (std::size_t i = 0; i < kWideChildren; ++i) {
                const bool exists = i < children.count;
                const double first = exists ? std::floor((children.boxes[i].lo[axis] - lo[axis]) / step)
                                            : double{kMaxWideSteps};
                const double last = exists ? std::ceil((children.boxes[i].hi[axis] - lo[axis]) / step) : 0.0;
                node.lo[axis] |= static_cast<std::uint32_t>(first) << (8 * i);
                node.hi[axis] |= static_cast<std::uint32_t>(last) << (8 * i);
            }
        }
        return node;
    }

    // Appends the wide node of a binary node, and those below it. The recursion is at most kMaxBvhDepth deep.
    std::uint32_t append(const std::uint32_t binaryId) {
        const std::size_t nodeId = nodes.size();
        if (nodeId >= kMostWideNodes) {
            throw Error(ErrorKind::outOfMemory, "the wide BVH has more than 2^27 nodes");
        }
        const Children children = childrenOf(binaryId);
        nodes.push_back(pack(children));
        std::array<std::uint32_t, kWideChildren> words;
        for (std::size_t i = 0; i < kWideChildren; ++i) {
            const std::uint32_t child = i < children.count ? children.boxes[i].child : kEmptyBvhLeaf;
            words[i] = isBvhLeaf(child) ? child : append(child);
        }
        WideBvhNode& node = nodes[nodeId];
        node.child0 = words[0];
        node.child1 = words[1];
        node.child2 = words[2];
        node.child3 = words[3];
        return static_cast<std::uint32_t>(nodeId);
    }

    const Bvh& bvh;
    std::vector<WideBvhNode> nodes;
};

} // namespace

std::vector<WideBvhNode> widen(const Bvh& bvh) { return Widener(bvh).run(); }

} // namespace metamarch

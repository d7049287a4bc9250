// SPDX-License-Identifier: MIT
#include "metamarch/shading/light/light_tree.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

namespace metamarch {
namespace {

constexpr double kPiOf2 = std::numbers::pi / 2;
constexpr std::size_t kBuckets = 12; // of centres along an axis
// Parts of at most this number of lights are divided in halves: for them the cost of every split is the
// dearest part of the build.
constexpr std::size_t kSmallPart = 8;
constexpr std::size_t kParallelPart = 4096;

// All directions within `spread` (radians) of the axis.
struct Cone {
    glm::dvec3 axis{0.0};
    double spread = -1.0; // below 0: no direction
    double cosine = 1.0;  // of spread
};

double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
}

// Returns the smallest cone around both. M. Pharr, W. Jakob, G. Humphreys, "Physically Based Rendering", 4th
// edition, 2023, section 3.8.4.
Cone unionOf(const Cone& a, const Cone& b) {
    if (a.spread < 0.0 || b.spread < 0.0) {
        return a.spread < 0.0 ? b : a;
    }
    if (b.spread == 0.0 && glm::dot(a.axis, b.axis) >= a.cosine) {
        return a; // most lights of a large group
    }
    const double between = angleBetween(a.axis, b.axis);
    if (std::min(between + b.spread, std::numbers::pi) <= a.spread) {
        return a;
    }
    if (std::min(between + a.spread, std::numbers::pi) <= b.spread) {
        return b;
    }
    const double spread = (a.spread + between + b.spread) / 2;
    const glm::dvec3 normal = glm::cross(a.axis, b.axis);
    if (spread >= std::numbers::pi || glm::length(normal) == 0.0) {
        return {a.axis, std::numbers::pi, -1.0};
    }
    // Turns the axis of `a` towards that of `b`.
    const double turn = spread - a.spread;
    const glm::dvec3 side = glm::cross(glm::normalize(normal), a.axis);
    return {glm::normalize(a.axis * std::cos(turn) + side * std::sin(turn)), spread, std::cos(spread)};
}

// Sums over lights, for the cost of a split.
struct Group {
    glm::dvec3 lo{std::numeric_limits<double>::infinity()};
    glm::dvec3 hi{-std::numeric_limits<double>::infinity()};
    Cone cone;
    double end = 0.0; // radians
    double intensity = 0.0;
    std::size_t count = 0;

    void add(const Group& other) {
        lo = glm::min(lo, other.lo);
        hi = glm::max(hi, other.hi);
        cone = unionOf(cone, other.cone);
        end = std::max(end, other.end);
        intensity += other.intensity;
        count += other.count;
    }
};

Group groupOf(const PlacedLight& light) {
    const auto& [a, b, c] = light.corners;
    return {glm::min(glm::min(a, b), c),
            glm::max(glm::max(a, b), c),
            {light.axis, std::acos(std::clamp(light.spread, -1.0, 1.0)), light.spread},
            std::acos(std::clamp(light.end, -1.0, 1.0)),
            light.intensity,
            1};
}

// Returns the measure of the directions into which a group shines, weighted by the cosine: Conty Estevez and
// Kulla 2018, section 4.
double orientationMeasure(const Cone& cone, const double end) {
    const double spread = std::max(cone.spread, 0.0);
    const double whole = std::min(spread + end, std::numbers::pi);
    return 2 * std::numbers::pi * (1 - std::cos(spread)) +
           kPiOf2 * (2 * whole * std::sin(spread) - std::cos(spread - 2 * whole) -
                     2 * spread * std::sin(spread) + std::cos(spread));
}

// The cost of the paper has the area of the box. Here it is the square of its diagonal, as nodes keep
// spheres, and lights in one line have no area.
double costOf(const Group& group) {
    const glm::dvec3 size = group.hi - group.lo;
    return group.count == 0
               ? 0.0
               : group.intensity * orientationMeasure(group.cone, group.end) * glm::dot(size, size);
}

class Builder {
  public:
    explicit Builder(const std::span<const PlacedLight> lights) : lights_(lights) {
        groups_.reserve(lights.size());
        centers_.reserve(lights.size());
        for (const PlacedLight& light : lights) {
            groups_.push_back(groupOf(light));
            centers_.push_back((light.corners[0] + light.corners[1] + light.corners[2]) / 3.0);
        }
        tree_.branches.resize(lights.size());
        tree_.nodes.resize(2 * lights.size() - 1);
    }

    LightTree build() {
        std::vector<std::uint32_t> order(lights_.size());
        std::iota(order.begin(), order.end(), 0u);
        fill(0, 1, order, 0, 0);
        return std::move(tree_);
    }

  private:
    // Fills the node at `index`, which is `depth` branches below the root, and what is below it, from the
    // node at `next` on.
    void fill(const std::size_t index, const std::size_t next, const std::span<std::uint32_t> part,
              const std::uint32_t branches, const std::uint32_t depth) {
        LightNode node = nodeOf(part);
        if (part.size() == 1) {
            node.link = kLightLeaf | part.front();
            tree_.branches[part.front()] = branches;
            tree_.nodes[index] = node;
            return;
        }
        node.link = static_cast<std::uint32_t>(next);
        tree_.nodes[index] = node;
        const std::size_t size = divide(part, depth);
        const auto fillFirst = [&] { fill(next, next + 2, part.first(size), branches, depth + 1); };
        const auto fillSecond = [&] {
            // The first child has 2 size - 2 nodes below it.
            fill(next + 1, next + 2 * size, part.subspan(size), branches | (1u << depth), depth + 1);
        };
        if (part.size() < kParallelPart) {
            fillFirst();
            fillSecond();
        } else {
            tbb::parallel_invoke(fillFirst, fillSecond);
        }
    }

    LightNode nodeOf(const std::span<const std::uint32_t> part) const {
        glm::dvec3 lo(std::numeric_limits<double>::infinity());
        glm::dvec3 hi = -lo;
        double intensity = 0.0;
        bool isTwoSided = false;
        for (const std::uint32_t i : part) {
            lo = glm::min(lo, groups_[i].lo);
            hi = glm::max(hi, groups_[i].hi);
            intensity += lights_[i].intensity;
            isTwoSided = isTwoSided || lights_[i].isTwoSided;
        }
        const glm::dvec3 reference = lights_[part.front()].axis;
        glm::dvec3 normals(0.0);
        for (const std::uint32_t i : part) {
            const PlacedLight& light = lights_[i];
            const bool isTurned = isTwoSided && glm::dot(light.axis, reference) < 0.0;
            normals += light.axis * (isTurned ? -light.intensity : light.intensity);
        }
        const bool hasMean = glm::length(normals) > 1e-6 * intensity;

        LightNode node{};
        node.axis = packAxis(vec3(hasMean ? glm::normalize(normals) : reference));
        node.center = vec3(0.5 * (lo + hi));
        // Measured from what was stored, so that rounding leaves no light out.
        const glm::dvec3 axis(unpackAxis(node.axis));
        const glm::dvec3 center(node.center);
        double squaredRadius = 0.0;
        double spread = 0.0;
        double end = 0.0;
        for (const std::uint32_t i : part) {
            const PlacedLight& light = lights_[i];
            for (const glm::dvec3& corner : light.corners) {
                squaredRadius = std::max(squaredRadius, glm::dot(corner - center, corner - center));
            }
            const double along = glm::dot(light.axis, axis);
            spread = std::max(spread, std::acos(std::clamp(isTwoSided ? std::abs(along) : along, -1.0, 1.0)) +
                                          groups_[i].cone.spread);
            end = std::max(end, groups_[i].end);
        }
        node.radius = static_cast<float>(std::sqrt(squaredRadius) * (1.0 + 1e-6));
        node.angles = packAngles(static_cast<float>(std::cos(std::min(spread, std::numbers::pi))),
                                 static_cast<float>(std::cos(end)));
        node.intensity = static_cast<float>(intensity);
        node.axis |= isTwoSided ? kLightTwoSided : 0u;
        return node;
    }

    // Sorts the part into the lights of the first child and those of the second. Returns the number of the
    // first.
    std::size_t divide(const std::span<std::uint32_t> part, const std::uint32_t depth) const {
        glm::dvec3 lo(std::numeric_limits<double>::infinity());
        glm::dvec3 hi = -lo;
        for (const std::uint32_t i : part) {
            lo = glm::min(lo, centers_[i]);
            hi = glm::max(hi, centers_[i]);
        }
        // From a certain depth on, halves keep all lights within kMaxLightDepth branches.
        const bool isDeep = depth + static_cast<std::uint32_t>(std::bit_width(part.size())) >= kMaxLightDepth;
        const Split split = part.size() <= kSmallPart || isDeep ? Split{} : bestSplit(part, lo, hi);
        if (split.axis < 0) {
            return halve(part, hi - lo);
        }
        const auto middle = std::stable_partition(part.begin(), part.end(), [&](const std::uint32_t i) {
            return bucketOf(i, split.axis, lo, hi) < split.border;
        });
        return static_cast<std::size_t>(middle - part.begin());
    }

    struct Split {
        int axis = -1;          // none found
        std::size_t border = 0; // the first bucket of the second child
    };

    Split bestSplit(const std::span<const std::uint32_t> part, const glm::dvec3& lo,
                    const glm::dvec3& hi) const {
        const glm::dvec3 size = hi - lo;
        const double longest = std::max({size.x, size.y, size.z});
        double least = std::numeric_limits<double>::infinity();
        Split best;
        for (int axis = 0; axis < 3; ++axis) {
            if (!(size[axis] > 0.0)) {
                continue;
            }
            std::array<Group, kBuckets> buckets;
            for (const std::uint32_t i : part) {
                buckets[bucketOf(i, axis, lo, hi)].add(groups_[i]);
            }
            std::array<Group, kBuckets> from; // the sum of this bucket and all after it
            Group above;
            for (std::size_t b = kBuckets; b-- > 0;) {
                above.add(buckets[b]);
                from[b] = above;
            }
            Group below;
            for (std::size_t b = 1; b < kBuckets; ++b) {
                below.add(buckets[b - 1]);
                // Thin boxes are dear: the factor of section 4.
                const double cost = longest / size[axis] * (costOf(below) + costOf(from[b]));
                if (below.count > 0 && from[b].count > 0 && cost < least) {
                    least = cost;
                    best = {axis, b};
                }
            }
        }
        return best;
    }

    std::size_t halve(const std::span<std::uint32_t> part, const glm::dvec3& size) const {
        const std::size_t half = part.size() / 2;
        const double longest = std::max({size.x, size.y, size.z});
        const int axis = size.x == longest ? 0 : size.y == longest ? 1 : 2;
        std::ranges::sort(part, {}, [&](const std::uint32_t i) { return std::pair(centers_[i][axis], i); });
        return half;
    }

    std::size_t bucketOf(const std::uint32_t i, const int axis, const glm::dvec3& lo,
                         const glm::dvec3& hi) const {
        const double place = (centers_[i][axis] - lo[axis]) / (hi[axis] - lo[axis]) * kBuckets;
        return std::min(static_cast<std::size_t>(std::max(place, 0.0)), kBuckets - 1);
    }

    std::span<const PlacedLight> lights_;
    std::vector<Group> groups_; // [light]
    std::vector<glm::dvec3> centers_;
    LightTree tree_;
};

} // namespace

LightTree makeLightTree(const std::span<const PlacedLight> lights) { return Builder(lights).build(); }

} // namespace metamarch

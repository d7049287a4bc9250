// SPDX-License-Identifier: MIT
// Random numbers as a function of the seed, the index and how many were drawn: the same on every machine.
#pragma once
#include <glm/glm.hpp>

#include <cmath>
#include <cstdint>

namespace metamarch::bench {

class RandomNumbers {
  public:
    RandomNumbers(const std::uint64_t seed, const std::uint64_t index) : state(mix(mix(seed) ^ index)) {}

    // Returns a number in [0, 1) with 24 random bits.
    float unit() {
        state += kIncrement;
        return static_cast<float>(mix(state) >> 40u) * 0x1p-24f;
    }

    glm::vec3 inUnitCube() {
        const float x = unit();
        const float y = unit();
        return {x, y, unit()};
    }

    // Uniform on the unit sphere. G. Marsaglia, "Choosing a Point from the Surface of a Sphere", 1972.
    glm::vec3 onSphere() {
        const glm::vec2 p = inDisc();
        const float squared = glm::dot(p, p);
        const float ring = 2.0f * std::sqrt(1.0f - squared);
        return {p.x * ring, p.y * ring, 1.0f - 2.0f * squared};
    }

    // Cosine-distributed around +z (density cos / pi): a point of the disc projected up to the sphere
    // (Malley's method).
    glm::vec3 aroundZ() {
        const glm::vec2 p = inDisc();
        return {p, std::sqrt(1.0f - glm::dot(p, p))};
    }

  private:
    // Steele, Lea, Flood, "Fast Splittable Pseudorandom Number Generators", 2014: SplitMix64.
    static constexpr std::uint64_t kIncrement = 0x9e3779b97f4a7c15u;
    static constexpr std::uint64_t mix(std::uint64_t z) {
        z = (z ^ (z >> 30u)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27u)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31u);
    }

    // Uniform in the open unit disc, by rejection, because sin and cos differ between libraries.
    glm::vec2 inDisc() {
        while (true) {
            const float x = 2.0f * unit() - 1.0f;
            const float y = 2.0f * unit() - 1.0f;
            if (x * x + y * y < 1.0f) {
                return {x, y};
            }
        }
    }

    std::uint64_t state;
};

} // namespace metamarch::bench

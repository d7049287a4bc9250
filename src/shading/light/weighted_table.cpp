// SPDX-License-Identifier: MIT
#include "metamarch/shading/light/weighted_table.h"

#include "metamarch/shared/math.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace metamarch {
namespace {

// The fractions that a texel and each neighbour along one axis contribute to the texel's area: the integral
// of the tent filter.
constexpr float kOwnPart = 0.75f;
constexpr float kNeighbourPart = 0.125f;

// Gives luminances relative to the brightest texel, because sums of extreme values could overflow.
class Brightness {
  public:
    explicit Brightness(const Environment& environment) : environment_(environment) {
        float largest = 0.0f;
        for (const glm::vec3& texel : environment.texels) {
            largest = std::max(largest, luminance(texel * kHeadroom));
        }
        scale_ = largest > 0.0f ? 1.0 / largest : 0.0;
    }

    // Returns the luminance filtered along its row, which wraps around.
    float inRow(std::uint32_t x, std::uint32_t y) const {
        const std::uint32_t left = x == 0 ? environment_.width - 1 : x - 1;
        const std::uint32_t right = x + 1 == environment_.width ? 0 : x + 1;
        return kOwnPart * at(x, y) + kNeighbourPart * (at(left, y) + at(right, y));
    }

  private:
    float at(std::uint32_t x, std::uint32_t y) const {
        const glm::vec3& texel = environment_.texels[std::size_t{y} * environment_.width + x];
        return static_cast<float>(luminance(texel * kHeadroom) * scale_);
    }

    static constexpr float kHeadroom = 0.5f; // keeps the luminance of the largest floats finite

    const Environment& environment_;
    double scale_;
};

} // namespace

std::vector<TableEntry> makeWeightedTable(const std::span<const float> weights) {
    const std::size_t count = weights.size();
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    std::vector<TableEntry> table(count);
    double reached = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        const double probability = sum > 0.0 ? weights[i] / sum : 1.0 / static_cast<double>(count);
        reached += probability;
        table[i].from = i == 0 ? 0.0f : table[i - 1].upTo;
        table[i].upTo = static_cast<float>(std::min(reached, 1.0));
        table[i].probability = static_cast<float>(probability);
    }
    // Give what rounding has left over at the end to the last entry with a positive probability.
    for (std::size_t i = count; i > 0; --i) {
        table[i - 1].upTo = 1.0f;
        if (table[i - 1].probability > 0.0f) {
            break;
        }
        table[i - 1].from = 1.0f;
    }
    // guideSlot rounds, so a u that it maps to a slot may lie just before the slot.
    constexpr double kRounding = 0x1p-22;
    std::uint32_t guide = 0;
    for (std::size_t slot = 0; slot < count; ++slot) {
        const double start = static_cast<double>(slot) * (1.0 - kRounding) / static_cast<double>(count);
        while (table[guide].upTo <= start) {
            ++guide;
        }
        table[slot].guide = guide;
    }
    return table;
}

EnvironmentTables makeEnvironmentTables(const Environment& environment) {
    EnvironmentTables tables;
    tables.columns.reserve(environment.texels.size());
    const Brightness brightness(environment);
    std::vector<float> rowWeights(environment.height);
    std::vector<float> weights(environment.width);
    for (std::uint32_t y = 0; y < environment.height; ++y) {
        const std::uint32_t above = y == 0 ? 0 : y - 1;
        const std::uint32_t below = y + 1 == environment.height ? y : y + 1;
        const double top = M_PI * y / environment.height;
        const double solidAngle = std::cos(top) - std::cos(top + M_PI / environment.height);
        double sum = 0.0;
        for (std::uint32_t x = 0; x < environment.width; ++x) {
            weights[x] = kOwnPart * brightness.inRow(x, y) +
                         kNeighbourPart * (brightness.inRow(x, above) + brightness.inRow(x, below));
            sum += weights[x];
        }
        rowWeights[y] = static_cast<float>(sum * solidAngle);
        const std::vector<TableEntry> row = makeWeightedTable(weights);
        tables.columns.insert(tables.columns.end(), row.begin(), row.end());
    }
    tables.rows = makeWeightedTable(rowWeights);
    return tables;
}

} // namespace metamarch

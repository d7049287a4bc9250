// SPDX-License-Identifier: MIT
#include "metamarch/shading/light/weighted_table.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace metamarch {
namespace {

// This part of the map's mean is left to BSDF sampling: M. Karlik, M. Sik, P. Vevoda, T. Skrivan, J.
// Krivanek, "MIS Compensation: Optimizing Sampling Techniques in Multiple Importance Sampling", 2019.
// README.md says why it is a half.
constexpr double kLeftToBsdf = 0.5;

// Returns the weights of the texels, whose mean is 1 if there is any light. The length of the colour as a
// vector gives the least squared error, summed over the channels; luminance would hardly look for blue light.
std::vector<float> weightsOf(const Environment& environment) {
    constexpr double kLeast = 1e-18; // the square of a smaller weight could be a denormal float
    const std::size_t width = environment.width;
    std::vector<double> kept(environment.texels.size());
    std::vector<double> sines(environment.height);
    double light = 0.0;
    double area = 0.0;
    for (std::size_t row = 0; row < sines.size(); ++row) {
        sines[row] = std::sin(M_PI * (static_cast<double>(row) + 0.5) / environment.height);
        for (std::size_t i = row * width; i < (row + 1) * width; ++i) {
            kept[i] = glm::length(glm::dvec3(environment.texels[i]));
            light += kept[i] * sines[row];
            area += sines[row];
        }
    }
    const double left = kLeftToBsdf * light / area;
    double sum = 0.0;
    for (std::size_t row = 0; row < sines.size(); ++row) {
        for (std::size_t i = row * width; i < (row + 1) * width; ++i) {
            kept[i] = std::max(kept[i] - left, 0.0) * sines[row];
            sum += kept[i];
        }
    }
    const double scale = sum > 0.0 ? static_cast<double>(kept.size()) / sum : 0.0;
    std::vector<float> weights(kept.size());
    for (std::size_t i = 0; i < kept.size(); ++i) {
        const double value = kept[i] * scale;
        weights[i] = value < kLeast ? 0.0f : static_cast<float>(value);
    }
    return weights;
}

// Blocks are divided into parts for the mean cosine.
constexpr std::uint32_t kPartsAlong = 8;
constexpr std::size_t kPartsOfBlock = std::size_t{kPartsAlong} * kPartsAlong;

struct BlockPart {
    double weight = 0.0;
    glm::dvec3 direction{0.0}; // sum over the cells, times their weights
};

// Adds a row of cells to the parts of its blocks. `azimuths` are the cosines and sines of the columns of
// cells.
void addToParts(const EnvironmentTables& tables, const Environment& environment, const std::uint32_t row,
                const std::span<const float> cells, const std::span<const glm::dvec2> azimuths,
                const std::span<BlockPart> parts) {
    const auto partOf = [](const std::uint32_t cell, const std::uint32_t shift) {
        return (cell & ((1u << shift) - 1)) * kPartsAlong >> shift;
    };
    const std::size_t blockRow = row >> tables.blockRowShift;
    const std::size_t partRow = partOf(row, tables.blockRowShift);
    const double polar =
        M_PI * std::clamp(static_cast<double>(row), 0.25, environment.height - 0.25) / environment.height;
    const double level = std::sin(polar);
    const double height = std::cos(polar);
    for (std::uint32_t x = 0; x < environment.width; ++x) {
        const glm::dvec3 direction(level * azimuths[x].x, height, level * azimuths[x].y);
        const std::size_t block = blockRow * kBlocksAcross + (x >> tables.blockColumnShift);
        BlockPart& part =
            parts[block * kPartsOfBlock + partRow * kPartsAlong + partOf(x, tables.blockColumnShift)];
        part.weight += cells[x];
        part.direction += direction * static_cast<double>(cells[x]);
    }
}

// Returns normals all over a bin.
std::vector<glm::dvec3> normalsOf(const std::uint32_t bin) {
    constexpr int kSamplesAlong = 4;
    const std::uint32_t face = bin / (kBinsAlong * kBinsAlong);
    const std::uint32_t j = bin / kBinsAlong % kBinsAlong;
    const std::uint32_t i = bin % kBinsAlong;
    std::vector<glm::dvec3> normals;
    for (int y = 0; y < kSamplesAlong; ++y) {
        for (int x = 0; x < kSamplesAlong; ++x) {
            const double a = 2.0 * (i + x / (kSamplesAlong - 1.0)) / kBinsAlong - 1.0;
            const double b = 2.0 * (j + y / (kSamplesAlong - 1.0)) / kBinsAlong - 1.0;
            const double major = face % 2 == 0 ? 1.0 : -1.0;
            normals.push_back(glm::normalize(face < 2   ? glm::dvec3(major, a, b)
                                             : face < 4 ? glm::dvec3(a, major, b)
                                                        : glm::dvec3(a, b, major)));
        }
    }
    return normals;
}

// Returns the mean of the cosine over the normals and over the light of a block.
double meanCosine(const std::span<const glm::dvec3> normals, const std::span<const BlockPart> block) {
    // A block that some of the normals see keeps a probability for the others, whose horizon is lower.
    constexpr double kLeastCosine = 0.03;
    double sum = 0.0;
    double weight = 0.0;
    bool isSeen = false;
    for (const BlockPart& part : block) {
        weight += part.weight;
        for (const glm::dvec3& normal : normals) {
            const double cosine = glm::dot(normal, part.direction);
            sum += std::max(cosine, 0.0);
            isSeen = isSeen || cosine > -kLeastCosine * part.weight;
        }
    }
    const double mean = weight > 0.0 ? sum / (weight * static_cast<double>(normals.size())) : 0.0;
    return isSeen ? std::max(mean, kLeastCosine) : 0.0;
}

// Returns the tables of blocks for all bins. The weights of the parts sum to the number of texels.
std::vector<TableEntry> blockTables(const std::span<const BlockPart> parts) {
    std::vector<double> weights(kMapBlocks, 0.0);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        weights[i / kPartsOfBlock] += parts[i].weight;
    }
    const double all = std::accumulate(weights.begin(), weights.end(), 0.0);
    std::vector<TableEntry> tables(std::size_t{kAnyNormal + 1} * kMapBlocks);
    tbb::parallel_for(0u, kAnyNormal + 1, [&](const std::uint32_t bin) {
        std::vector<float> seen(weights.begin(), weights.end());
        const std::vector<glm::dvec3> normals =
            bin == kAnyNormal ? std::vector<glm::dvec3>() : normalsOf(bin);
        for (std::size_t block = 0; bin != kAnyNormal && block < kMapBlocks; ++block) {
            seen[block] *=
                static_cast<float>(meanCosine(normals, parts.subspan(block * kPartsOfBlock, kPartsOfBlock)));
        }
        // A surface that sees no light draws as any surface does: blocks without light may be outside the
        // map.
        const auto isLit = [](const float weight) { return weight > 0.0f; };
        if (std::ranges::none_of(seen, isLit)) {
            seen.assign(weights.begin(), weights.end());
        }
        if (std::ranges::none_of(seen, isLit)) { // a black map: the first block is always in it
            seen.front() = 1.0f;
        }
        const std::vector<TableEntry> table = makeWeightedTable(seen);
        for (std::size_t block = 0; block < kMapBlocks; ++block) {
            TableEntry& entry = tables[std::size_t{bin} * kMapBlocks + block];
            entry = table[block];
            entry.probability =
                weights[block] > 0.0 ? static_cast<float>(entry.probability * all / weights[block]) : 0.0f;
        }
    });
    return tables;
}

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
    const std::uint32_t width = environment.width;
    const std::uint32_t height = environment.height;
    EnvironmentTables tables;
    tables.weights = weightsOf(environment);
    while (((width - 1) >> tables.blockColumnShift) >= kBlocksAcross) {
        ++tables.blockColumnShift;
    }
    while ((height >> tables.blockRowShift) >= kBlocksDown) {
        ++tables.blockRowShift;
    }
    std::vector<glm::dvec2> azimuths;
    for (std::uint32_t x = 0; x < width; ++x) {
        const double azimuth = 2.0 * M_PI * ((x + 1.0) / width - 0.5);
        azimuths.emplace_back(std::cos(azimuth), std::sin(azimuth));
    }
    tables.columns.resize(std::size_t{width} * (height + 1));
    std::vector<std::vector<float>> rowWeights(kBlocksAcross, std::vector<float>(height + 1, 0.0f));
    std::vector<BlockPart> parts(std::size_t{kMapBlocks} * kPartsAlong * kPartsAlong);
    const std::uint32_t blockWidth = 1u << tables.blockColumnShift;
    const std::uint32_t blockHeight = 1u << tables.blockRowShift;
    const auto addRow = [&](const std::uint32_t row) {
        std::vector<float> cells(width);
        const float* upper = &tables.weights[std::size_t{std::max(row, 1u) - 1} * width];
        const float* lower = &tables.weights[std::size_t{std::min(row, height - 1)} * width];
        const float part = row == 0 || row == height ? 0.5f : 1.0f; // cells at the poles are halves
        for (std::uint32_t x = 0; x < width; ++x) {
            const std::uint32_t next = x + 1 == width ? 0 : x + 1;
            cells[x] = 0.25f * part * (upper[x] + upper[next] + lower[x] + lower[next]);
        }
        for (std::uint32_t first = 0; first < width; first += blockWidth) {
            const std::span block(&cells[first], std::min(blockWidth, width - first));
            const std::vector<TableEntry> columns = makeWeightedTable(block);
            std::ranges::copy(columns, &tables.columns[std::size_t{row} * width + first]);
            rowWeights[first / blockWidth][row] =
                static_cast<float>(std::accumulate(block.begin(), block.end(), 0.0));
        }
        addToParts(tables, environment, row, cells, azimuths, parts);
    };
    // The rows of a block stay in order, so its sums are the same each time.
    tbb::parallel_for(0u, height / blockHeight + 1, [&](const std::uint32_t blockRow) {
        const std::uint32_t end = std::min((blockRow + 1) * blockHeight, height + 1);
        for (std::uint32_t row = blockRow * blockHeight; row < end; ++row) {
            addRow(row);
        }
    });
    for (const std::vector<float>& column : rowWeights) {
        for (std::uint32_t first = 0; first <= height; first += blockHeight) {
            const std::span block(&column[first], std::min(blockHeight, height + 1 - first));
            const std::vector<TableEntry> rows = makeWeightedTable(block);
            tables.rows.insert(tables.rows.end(), rows.begin(), rows.end());
        }
    }
    tables.blocks = blockTables(parts);
    return tables;
}

} // namespace metamarch

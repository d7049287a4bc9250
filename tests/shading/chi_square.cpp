// SPDX-License-Identifier: MIT
#include "chi_square.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace metamarch {
namespace {

constexpr std::size_t kRows = 20;
constexpr std::size_t kColumns = 40;
constexpr double kLeastExpected = 5.0;

glm::vec3 directionAt(double cosine, double azimuth) {
    const double sine = std::sqrt(std::max(1.0 - cosine * cosine, 0.0));
    return {static_cast<float>(sine * std::cos(azimuth)), static_cast<float>(sine * std::sin(azimuth)),
            static_cast<float>(cosine)};
}

struct Rectangle {
    double cosine;
    double azimuth;
    double height;
    double width;
};

// Gauss-Legendre quadrature with three points per side.
double gauss(const std::function<double(glm::vec3)>& density, const Rectangle& r) {
    constexpr std::array kPlace = {0.112701665379258, 0.5, 0.887298334620742};
    constexpr std::array kWeight = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
    double sum = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            sum += kWeight[i] * kWeight[j] *
                   density(directionAt(r.cosine + r.height * kPlace[i], r.azimuth + r.width * kPlace[j]));
        }
    }
    return sum * r.height * r.width;
}

// Halves each side until the sum of the four parts agrees with the whole.
double integral(const std::function<double(glm::vec3)>& density, const Rectangle& r, double whole,
                double tolerance, int depth) {
    std::array<Rectangle, 4> parts{};
    std::array<double, 4> values{};
    for (std::size_t k = 0; k < 4; ++k) {
        parts[k] = {r.cosine + (k & 1 ? r.height / 2.0 : 0.0), r.azimuth + (k & 2 ? r.width / 2.0 : 0.0),
                    r.height / 2.0, r.width / 2.0};
        values[k] = gauss(density, parts[k]);
    }
    const double sum = values[0] + values[1] + values[2] + values[3];
    if (depth == 0 || std::abs(sum - whole) < tolerance) {
        return sum;
    }
    double refined = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
        refined += integral(density, parts[k], values[k], tolerance / 2.0, depth - 1);
    }
    return refined;
}

// Returns the upper tail of the standard normal distribution.
double upperTail(double z) { return 0.5 * std::erfc(z / std::sqrt(2.0)); }

} // namespace

Histogram evenHistogram(std::size_t cells, int samples) {
    return {std::vector<double>(cells), std::vector<double>(cells, samples / static_cast<double>(cells))};
}

std::size_t partOf(double place, std::size_t parts) {
    const double part = std::floor(place * static_cast<double>(parts));
    return static_cast<std::size_t>(std::clamp(part, 0.0, static_cast<double>(parts - 1)));
}

double chiSquareProbability(const Histogram& histogram) {
    std::vector<std::size_t> order(histogram.expected.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return histogram.expected[a] < histogram.expected[b]; });
    double chiSquare = 0.0;
    int cells = 0;
    double expected = 0.0;
    double observed = 0.0;
    for (const std::size_t cell : order) {
        expected += histogram.expected[cell];
        observed += histogram.observed[cell];
        if (expected >= kLeastExpected) {
            chiSquare += (observed - expected) * (observed - expected) / expected;
            ++cells;
            expected = 0.0;
            observed = 0.0;
        }
    }
    if (cells < 2) {
        return 1.0;
    }
    // E. B. Wilson, M. M. Hilferty, "The Distribution of Chi-Square", 1931: its cube root is nearly normal.
    const double degrees = cells - 1;
    const double spread = 2.0 / (9.0 * degrees);
    return upperTail((std::cbrt(chiSquare / degrees) - (1.0 - spread)) / std::sqrt(spread));
}

double significanceOf(int tests) { return 1.0 - std::pow(1.0 - 0.001, 1.0 / tests); }

Histogram sphereHistogram(int count, const std::function<DrawnDirection()>& draw,
                          const std::function<double(glm::vec3)>& density) {
    constexpr std::size_t kCells = kRows * kColumns;
    Histogram histogram{std::vector<double>(kCells + 1), std::vector<double>(kCells + 1)};
    for (int i = 0; i < count; ++i) {
        const DrawnDirection drawn = draw();
        const double azimuth = std::atan2(drawn.direction.y, drawn.direction.x);
        const std::size_t cell = partOf((drawn.direction.z + 1.0) / 2.0, kRows) * kColumns +
                                 partOf(azimuth / (2.0 * M_PI) + 0.5, kColumns);
        histogram.observed[drawn.isCounted ? cell : kCells] += 1.0;
    }
    double all = 0.0;
    for (std::size_t row = 0; row < kRows; ++row) {
        for (std::size_t column = 0; column < kColumns; ++column) {
            const Rectangle cell{2.0 * static_cast<double>(row) / kRows - 1.0,
                                 (2.0 * static_cast<double>(column) / kColumns - 1.0) * M_PI, 2.0 / kRows,
                                 2.0 * M_PI / kColumns};
            // The quadrature's error is at most a fifth of a sample per cell.
            const double part = integral(density, cell, gauss(density, cell), 0.2 / count, 9);
            histogram.expected[row * kColumns + column] = part * count;
            all += part;
        }
    }
    histogram.expected[kCells] = std::max(1.0 - all, 0.0) * count;
    return histogram;
}

} // namespace metamarch

// SPDX-License-Identifier: MIT
#include "metamarch/bench/results_page.h"

#include <gtest/gtest.h>

#include <sstream>

namespace metamarch::bench {
namespace {

Row makeRow(const char* scene, const char* rays, const char* traversal, const double speed) {
    Row row;
    row.scene = scene;
    row.triangles = 12;
    row.rays = rays;
    row.traversal = traversal;
    row.backend = "gpu";
    row.device = "a|device";
    row.mraysPerSecond = speed;
    row.floorMultiple = 3.5;
    return row;
}

std::vector<std::string> linesWith(const std::string& page, const std::string& part) {
    std::istringstream stream(page);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) {
        if (line.find(part) != std::string::npos) {
            lines.push_back(line);
        }
    }
    return lines;
}

const Origin kOrigin{"llvmpipe", "Mesa 22", "0123456789ab", "2026-11-22", "24 x 16 pixels"};

TEST(ResultsPage, saysWhereTheNumbersComeFromAndWhatTheyMean) {
    const std::string page = resultsPage(kOrigin, {});
    for (const char* const part : {"llvmpipe", "Mesa 22", "0123456789ab", "2026-11-22", "24 x 16",
                                   "Mrays/s:", "x floor:", "shadow:"}) {
        EXPECT_NE(page.find(part), std::string::npos) << part;
    }
}

// Each speed is in the row of its traversal and the column of its ray set, even if others are missing.
TEST(ResultsPage, hasOneTableOfSpeedsPerScene) {
    const std::vector<Row> rows{makeRow("a.ply", "far", "floor", 7), makeRow("a.ply", "far", "march", 2),
                                makeRow("a.ply", "ao", "march", 1), makeRow("b.ply", "far", "march", 5)};
    const std::string page = resultsPage(kOrigin, rows);
    EXPECT_EQ(linesWith(page, "## a.ply: 12 triangles").size(), 1u);
    EXPECT_EQ(linesWith(page, "## b.ply").size(), 1u);
    EXPECT_EQ(linesWith(page, "x floor) | on"),
              (std::vector<std::string>{"| Mrays/s (x floor) | on | far | ao |",
                                        "| Mrays/s (x floor) | on | far |"}));
    EXPECT_EQ(linesWith(page, "| march | a\\|device |"),
              (std::vector<std::string>{"| march | a\\|device | 2.00 (3.5) | 1.00 (3.5) |",
                                        "| march | a\\|device | 5.00 (3.5) |"}));
    EXPECT_EQ(linesWith(page, "| floor | a\\|device |").front(), "| floor | a\\|device | 7.00 (3.5) | - |");
    EXPECT_EQ(linesWith(page, "| a.ply | far | march | gpu |").size(), 1u);
}

} // namespace
} // namespace metamarch::bench

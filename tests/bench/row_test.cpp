// SPDX-License-Identifier: MIT
#include "metamarch/bench/row.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

namespace metamarch::bench {
namespace {

Row exampleRow() {
    Row row;
    row.scene = "a \"cow\"";
    row.rays = "far";
    row.traversal = "meta_table";
    row.backend = "gpu";
    row.rayCount = 200;
    row.hits = 50;
    row.mraysPerSecond = 12.5;
    row.visitsPerRay = 2.5;
    return row;
}

TEST(Row, hasTheKeysOfTheSchema) {
    const nlohmann::ordered_json json = toJson({"device", "driver", "commit", "2026-11-22", "24 x 16"}, {});
    EXPECT_EQ(json["schema"], 1);
    for (const char* const key : {"device", "driver", "commit", "date", "rows"}) {
        EXPECT_TRUE(json.contains(key)) << key;
    }
    const nlohmann::ordered_json row = toJson(exampleRow());
    for (const char* const key :
         {"scene", "rays", "traversal", "backend", "rayCount", "hits", "mraysPerSecond", "spread",
          "visitsPerRay", "testsPerRay", "bytesPerRay", "floorMultiple", "view", "buildSeconds", "bytes"}) {
        EXPECT_TRUE(row.contains(key)) << key;
    }
    EXPECT_EQ(row["hits"], 50);
    EXPECT_EQ(row["visitsPerRay"], 2.5);
    EXPECT_TRUE(row["testsPerRay"].is_null()); // unknown is not zero
}

TEST(Row, givesCsvAsManyCellsAsKeys) {
    Row row = exampleRow();
    const std::string csv = toCsv({&row, 1});
    const std::string head = csv.substr(0, csv.find('\n'));
    const std::string line = csv.substr(csv.find('\n') + 1);
    EXPECT_TRUE(head.starts_with("scene,triangles,rays,view,")) << head;
    EXPECT_TRUE(line.starts_with("\"a \"\"cow\"\"\",0,\"far\",,\"meta_table\",")) << line;
    EXPECT_EQ(std::ranges::count(head, ','), std::ranges::count(line, ','));
}

TEST(Row, isAMultipleOfTheFloor) {
    Row row = exampleRow();
    Row floor = exampleRow();
    floor.mraysPerSecond = 50.0;
    compareWithFloor(row, floor);
    EXPECT_EQ(row.floorMultiple, 4.0);
    compareWithFloor(floor, floor);
    EXPECT_EQ(floor.floorMultiple, 1.0);
    Row noRays = exampleRow();
    noRays.mraysPerSecond = 0.0;
    compareWithFloor(noRays, noRays);
    EXPECT_FALSE(noRays.floorMultiple);
}

TEST(Row, alignsText) {
    const std::string headings = textHeadings();
    const std::string text = toText(exampleRow());
    EXPECT_EQ(text.find("12.500") + 6, headings.find("Mrays/s") + 7);
    EXPECT_NE(text.find("25.0%"), std::string::npos) << text; // hits
}

} // namespace
} // namespace metamarch::bench

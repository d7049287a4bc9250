// SPDX-License-Identifier: MIT
// A measurement and its text formats.
#pragma once
#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace metamarch::bench {

// The name, in place of a traversal's, of the row for the same rays with hits known in advance: the least
// that tracing can cost.
inline constexpr const char* kFloor = "floor";

struct Row {
    std::string scene;
    std::uint64_t triangles = 0; // number of triangles in the scene
    std::string rays;            // name of the ray set
    std::string view;            // name of the camera's view; empty if the set has several
    std::string traversal;       // or the name of a peer
    std::string backend;         // "gpu", or "cpu" for one thread of the processor
    std::string device;
    std::uint64_t rayCount = 0;
    std::uint64_t hits = 0;
    double mraysPerSecond = 0.0; // median
    double spread = 0.0;         // Summary::spread
    std::optional<double> visitsPerRay{};
    std::optional<double> testsPerRay{};
    std::optional<double> bytesPerRay{};   // StructureCost
    std::optional<double> floorMultiple{}; // time divided by the time of the row kFloor
    std::optional<double> buildSeconds{};
    std::optional<std::uint64_t> bytes{}; // size of the structure on the host
    // Number of rays whose hits differ from the reference's within the tolerance.
    std::uint64_t differingHits = 0;
};

// The place and the conditions of the measurements.
struct Origin {
    std::string device;
    std::string driver;
    std::string commit;
    std::string date;    // "2026-11-22"
    std::string setting; // size of the views and number of measurements
};

// Sets row.floorMultiple. `floor` is the row kFloor with the same rays and backend.
void compareWithFloor(Row& row, const Row& floor);

// Returns what a reader of rows must know, one line each: units and definitions.
std::string definitions();

// The keys are the members of Row; unknown values are null.
nlohmann::ordered_json toJson(const Row& row);

// {"schema": 1, "device", "driver", "commit", "date", "setting", "rows": [...]}.
nlohmann::ordered_json toJson(const Origin& origin, std::span<const Row> rows);

// Returns a line of keys, then one line per row; unknown values are empty.
std::string toCsv(std::span<const Row> rows);

// The columns of a row in text form.
struct Column {
    const char* heading;
    int width; // characters; negative: left-aligned
};
std::span<const Column> columns();
std::vector<std::string> cells(const Row& row); // one text per column

// Aligned lines of text for a terminal; textHeadings() aligns with the lines of toText().
std::string textHeadings();
std::string toText(const Row& row);

} // namespace metamarch::bench

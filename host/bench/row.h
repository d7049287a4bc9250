// One measurement, and how it is written.
#pragma once
#include <nlohmann/json.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace metamarch::bench {

// In place of a traversal: the same rays when their hits are known in advance, the least that tracing costs.
inline constexpr const char* kFloor = "floor";

struct Row {
    std::string scene;
    std::uint64_t triangles = 0; // of the scene
    std::string rays;            // name of the ray set
    std::string view;            // of the camera; empty where the set is of several
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
    std::optional<double> floorMultiple{}; // time as a multiple of that of the row kFloor
    std::optional<double> buildSeconds{};
    std::optional<std::uint64_t> bytes{}; // of the structure, on the host
    std::uint64_t differingHits = 0;      // rays whose hits are not the judge's, within what is allowed
};

// Where and by what the rows were measured.
struct Origin {
    std::string device;
    std::string driver;
    std::string commit;
    std::string date;    // "2026-11-22"
    std::string setting; // size of the views and how often was measured
};

// Sets row.floorMultiple. `floor` is the row kFloor of the same rays and backend.
void compareWithFloor(Row& row, const Row& floor);

// What a reader of rows has to know, a line each: units and definitions.
std::string definitions();

// Keys as the members of Row; what is unknown is null.
nlohmann::ordered_json toJson(const Row& row);

// {"schema": 1, "device", "driver", "commit", "date", "setting", "rows": [...]}.
nlohmann::ordered_json toJson(const Origin& origin, std::span<const Row> rows);

// A line of keys, then a line per row; what is unknown is empty.
std::string toCsv(std::span<const Row> rows);

// A row in columns, for people.
struct Column {
    const char* heading;
    int width; // in characters; negative: to the left
};
std::span<const Column> columns();
std::vector<std::string> cells(const Row& row); // one text per column

// Lines of aligned text, for a terminal; the line of headings fits above them.
std::string textHeadings();
std::string toText(const Row& row);

} // namespace metamarch::bench

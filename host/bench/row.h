// One measurement, and how it is written.
#pragma once
#include <nlohmann/json.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace metamarch::bench {

struct Row {
    std::string scene;
    std::string rays;      // name of the ray set
    std::string view;      // of the camera; empty where the set is of several
    std::string traversal; // or the name of a peer
    std::string backend;   // "gpu", or "cpu" for one thread of the processor
    std::string device;
    std::uint64_t rayCount = 0;
    std::uint64_t hits = 0;
    double mraysPerSecond = 0.0; // median
    double spread = 0.0;         // Summary::spread
    std::optional<double> visitsPerRay{};
    std::optional<double> testsPerRay{};
    std::optional<double> bytesPerRay{};   // StructureCost
    std::optional<double> floorMultiple{}; // of the time when every hit is known in advance; not measured yet
    std::optional<double> buildSeconds{};
    std::optional<std::uint64_t> bytes{}; // of the structure, on the host
    std::uint64_t differingHits = 0;      // rays whose hits are not the judge's, within what is allowed
};

// Where and by what the rows were measured.
struct Origin {
    std::string device;
    std::string driver;
    std::string commit;
    std::string date; // "2026-11-22"
};

// What a reader of rows has to know, a line each: units and definitions.
std::string definitions();

// Keys as the members of Row; what is unknown is null.
nlohmann::ordered_json toJson(const Row& row);

// {"schema": 1, "device", "driver", "commit", "date", "rows": [...]}.
nlohmann::ordered_json toJson(const Origin& origin, std::span<const Row> rows);

// A line of keys, then a line per row; what is unknown is empty.
std::string toCsv(std::span<const Row> rows);

// Lines of aligned text, for a terminal; the line of headings fits above them.
std::string textHeadings();
std::string toText(const Row& row);

// The same columns as a table for a README, with its origin above.
std::string toMarkdown(const Origin& origin, std::span<const Row> rows);

} // namespace metamarch::bench

// SPDX-License-Identifier: MIT
#include "metamarch/bench/row.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace metamarch::bench {
namespace {

constexpr Column kColumns[] = {{"scene", -16}, {"rays", -14}, {"traversal", -16}, {"backend", -7},
                               {"Mrays/s", 9}, {"spread", 7}, {"x floor", 8},     {"visits", 8},
                               {"tests", 8},   {"bytes", 8},  {"hits", 7},        {"differ", 7},
                               {"build s", 9}, {"MiB", 8}};

std::string number(const std::optional<double>& value, const int digits) {
    return value ? fmt::format("{:.{}f}", *value, digits) : "-";
}

std::string aligned(const std::vector<std::string>& texts) {
    std::string line;
    for (std::size_t i = 0; i < texts.size(); ++i) {
        const int width = kColumns[i].width;
        line +=
            width < 0 ? fmt::format("{:<{}} ", texts[i], -width) : fmt::format("{:>{}} ", texts[i], width);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    return line;
}

template <class T>
nlohmann::ordered_json orNull(const std::optional<T>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
}

std::string csvCell(const nlohmann::ordered_json& value) {
    if (value.is_null()) {
        return "";
    }
    if (!value.is_string()) {
        return value.dump();
    }
    std::string text = value.get<std::string>();
    for (std::size_t at = 0; (at = text.find('"', at)) != std::string::npos; at += 2) {
        text.insert(at, 1, '"');
    }
    return '"' + text + '"';
}

} // namespace

void compareWithFloor(Row& row, const Row& floor) {
    if (row.mraysPerSecond > 0.0) { // otherwise there are no rays
        row.floorMultiple = floor.mraysPerSecond / row.mraysPerSecond;
    }
}

std::string definitions() {
    return "Mrays/s: million rays per second by the device's timestamps (cpu: wall clock of one thread, ray\n"
           "         set-up included), median of the runs after a warm-up; spread: distance between the\n"
           "         quartiles in per cent of it\n"
           "x floor: time as a multiple of the row floor: the same rays when the hit is known in advance, "
           "so\n"
           "         that a ray is set up, one triangle record tested (none for a miss) and the hit written\n"
           "visits:  per ray: inner nodes, leaves and look-ups of a table\n"
           "tests:   triangle tests per ray\n"
           "bytes:   read per ray without caches: visits times what a visit reads, tests times a triangle\n"
           "         record; a leaf of a tree counts as an inner node\n"
           "differ:  rays whose hit is not the judge's; 0 is demanded on lavapipe\n"
           "build s, MiB: of the structure that the traversal reads, triangle records included\n";
}

nlohmann::ordered_json toJson(const Row& row) {
    return {{"scene", row.scene},
            {"triangles", row.triangles},
            {"rays", row.rays},
            {"view", row.view.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(row.view)},
            {"traversal", row.traversal},
            {"backend", row.backend},
            {"device", row.device},
            {"rayCount", row.rayCount},
            {"hits", row.hits},
            {"mraysPerSecond", row.mraysPerSecond},
            {"spread", row.spread},
            {"visitsPerRay", orNull(row.visitsPerRay)},
            {"testsPerRay", orNull(row.testsPerRay)},
            {"bytesPerRay", orNull(row.bytesPerRay)},
            {"floorMultiple", orNull(row.floorMultiple)},
            {"buildSeconds", orNull(row.buildSeconds)},
            {"bytes", orNull(row.bytes)},
            {"differingHits", row.differingHits}};
}

nlohmann::ordered_json toJson(const Origin& origin, const std::span<const Row> rows) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Row& row : rows) {
        list.push_back(toJson(row));
    }
    return {{"schema", 1},
            {"device", origin.device},
            {"driver", origin.driver},
            {"commit", origin.commit},
            {"date", origin.date},
            {"setting", origin.setting},
            {"rows", list}};
}

std::string toCsv(const std::span<const Row> rows) {
    const auto line = [](const std::vector<std::string>& texts) {
        return fmt::format("{}\n", fmt::join(texts, ","));
    };
    const auto pick = [](const Row& row, const auto& what) {
        std::vector<std::string> texts;
        const nlohmann::ordered_json json = toJson(row);
        for (const auto& [key, value] : json.items()) {
            texts.push_back(what(key, value));
        }
        return texts;
    };
    std::string text = line(pick(Row{}, [](const std::string& key, const auto&) { return key; }));
    for (const Row& row : rows) {
        text += line(pick(row, [](const std::string&, const auto& value) { return csvCell(value); }));
    }
    return text;
}

std::span<const Column> columns() { return kColumns; }

std::vector<std::string> cells(const Row& row) {
    const double hitPart =
        row.rayCount == 0 ? 0.0 : static_cast<double>(row.hits) / static_cast<double>(row.rayCount);
    const auto mebibytes = row.bytes ? std::optional(static_cast<double>(*row.bytes) / 0x1p20) : std::nullopt;
    return {row.scene,
            row.view.empty() ? row.rays : fmt::format("{} {}", row.rays, row.view),
            row.traversal,
            row.backend,
            number(row.mraysPerSecond, 3),
            fmt::format("{:.1f}%", 100.0 * row.spread),
            number(row.floorMultiple, 2),
            number(row.visitsPerRay, 2),
            number(row.testsPerRay, 2),
            number(row.bytesPerRay, 0),
            fmt::format("{:.1f}%", 100.0 * hitPart),
            fmt::to_string(row.differingHits),
            number(row.buildSeconds, 3),
            number(mebibytes, 1)};
}

std::string textHeadings() {
    std::vector<std::string> names;
    for (const Column& column : kColumns) {
        names.emplace_back(column.heading);
    }
    return aligned(names);
}

std::string toText(const Row& row) { return aligned(cells(row)); }

} // namespace metamarch::bench

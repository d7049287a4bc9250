// SPDX-License-Identifier: MIT
#include "metamarch/bench/results_page.h"

#include "metamarch/bench/ray_set.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <tuple>

namespace metamarch::bench {
namespace {

using Rows = std::vector<const Row*>;

std::string line(const std::vector<std::string>& cells) {
    return fmt::format("| {} |\n", fmt::join(cells, " | "));
}

// Escapes the cell separator, which a name given by the user may contain.
std::string cell(std::string text) {
    for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) {
        text.insert(at, 1, '\\');
    }
    return text;
}

// Returns the distinct values of `key` over the rows, in order of appearance.
template <class Key>
auto distinct(const Rows& rows, const Key& key) {
    std::vector<decltype(key(*rows.front()))> keys;
    for (const Row* const row : rows) {
        if (std::ranges::find(keys, key(*row)) == keys.end()) {
            keys.push_back(key(*row));
        }
    }
    return keys;
}

std::string rayName(const Row& row) {
    return row.view.empty() ? row.rays : fmt::format("{} {}", row.rays, row.view);
}

auto tracer(const Row& row) { return std::tuple(row.traversal, row.device); }

// Returns a table with a line per traversal and device and a column per ray set.
std::string speeds(const Rows& rows) {
    const std::vector<std::string> raySets = distinct(rows, rayName);
    std::vector<std::string> heads{"Mrays/s (x floor)", "on"};
    std::vector<std::string> rules{"---", "---"};
    for (const std::string& name : raySets) {
        heads.push_back(cell(name));
        rules.emplace_back("---:");
    }
    std::string text = line(heads) + line(rules);
    for (const auto& who : distinct(rows, tracer)) {
        std::vector<std::string> cells{std::get<0>(who), cell(std::get<1>(who))};
        for (const std::string& name : raySets) {
            const auto found = std::ranges::find_if(
                rows, [&](const Row* row) { return tracer(*row) == who && rayName(*row) == name; });
            cells.push_back(found == rows.end() ? "-"
                                                : fmt::format("{:.2f} ({:.1f})", (*found)->mraysPerSecond,
                                                              (*found)->floorMultiple.value_or(0.0)));
        }
        text += line(cells);
    }
    return text;
}

std::string everything(const Rows& rows) {
    std::vector<std::string> heads;
    std::vector<std::string> rules;
    for (const Column& column : columns()) {
        heads.emplace_back(column.heading);
        rules.emplace_back(column.width < 0 ? "---" : "---:");
    }
    std::string text = line(heads) + line(rules);
    for (const Row* const row : rows) {
        std::vector<std::string> texts = cells(*row);
        std::ranges::transform(texts, texts.begin(), cell);
        text += line(texts);
    }
    return text;
}

std::string raySetMeanings() {
    std::string text;
    for (const RaySetKind& kind : kRaySets) {
        text += fmt::format("{:<8} {}\n", fmt::format("{}:", kind.name), kind.meaning);
    }
    return text;
}

} // namespace

std::string resultsPage(const Origin& origin, const std::span<const Row> rows) {
    std::string text = fmt::format("# Results\n\n"
                                   "Written by `metamarch bench traversal --markdown`.\n\n"
                                   "| | |\n|---|---|\n"
                                   "| device | {} |\n| driver | {} |\n| commit | {} |\n| date | {} |\n"
                                   "| setting | {} |\n\n"
                                   "```\n{}```\n\nRay sets:\n\n```\n{}```\n",
                                   cell(origin.device), cell(origin.driver), origin.commit, origin.date,
                                   origin.setting, definitions(), raySetMeanings());
    Rows all;
    for (const Row& row : rows) {
        all.push_back(&row);
    }
    for (const std::string& scene : distinct(all, [](const Row& row) { return row.scene; })) {
        Rows ofScene = all;
        std::erase_if(ofScene, [&](const Row* row) { return row->scene != scene; });
        text += fmt::format("\n## {}: {} triangles\n\n{}\n<details><summary>all numbers</summary>\n\n"
                            "{}\n</details>\n",
                            scene, ofScene.front()->triangles, speeds(ofScene), everything(ofScene));
    }
    return text;
}

} // namespace metamarch::bench

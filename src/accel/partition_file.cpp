// SPDX-License-Identifier: MIT
#include "metamarch/accel/partition_file.h"

#include "metamarch/accel/lattice.h"
#include "metamarch/error/error.h"
#include "metamarch/file/input_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace metamarch {
namespace {

using Json = nlohmann::json;

// Reads `values`, which must be `count` whole numbers from 0 to kMaxLatticeResolution.
std::vector<int> readCells(const InputFile& file, const Json& values, const std::size_t count,
                           const std::string& name) {
    const auto isCell = [](const Json& value) {
        return value.is_number_unsigned() && value.get<std::uint64_t>() <= kMaxLatticeResolution;
    };
    if (!values.is_array() || values.size() != count || !std::ranges::all_of(values, isCell)) {
        file.refuse(
            fmt::format("{} is not {} whole numbers from 0 to {}", name, count, kMaxLatticeResolution));
    }
    return values.get<std::vector<int>>();
}

Json parse(const InputFile& file) {
    try {
        return Json::parse(file.read());
    } catch (const Json::parse_error& error) {
        file.refuse(fmt::format("is no JSON, at byte {}", error.byte));
    }
}

} // namespace

Partition readPartition(const std::filesystem::path& path) {
    const InputFile file(path);
    const Json json = parse(file);
    if (!json.is_object() || json.size() != 2 || !json.contains("resolution") || !json.contains("boxes") ||
        !json["boxes"].is_array()) {
        file.refuse("is not an object of a \"resolution\" and a list of \"boxes\"");
    }
    const std::vector<int> resolution = readCells(file, json["resolution"], 3, "the resolution");
    Partition partition{uvec3(resolution[0], resolution[1], resolution[2]), {}};
    if (glm::any(glm::equal(partition.resolution, uvec3(0)))) {
        file.refuse("the resolution has no cells on an axis");
    }
    const double cells = 1.0 * resolution[0] * resolution[1] * resolution[2];
    if (cells * sizeof(std::uint32_t) > static_cast<double>(kTableBudget)) {
        file.refuseSize(fmt::format("a meta table of {} x {} x {} cells takes {:.0f} MiB, more than the {} "
                                    "MiB allowed",
                                    resolution[0], resolution[1], resolution[2],
                                    cells * sizeof(std::uint32_t) / 0x1p20, kTableBudget >> 20u));
    }
    for (const Json& corners : json["boxes"]) {
        const std::vector<int> box =
            readCells(file, corners, 6, fmt::format("box {}", partition.boxes.size()));
        partition.boxes.push_back({{box[0], box[1], box[2]}, {box[3], box[4], box[5]}});
    }
    try {
        checkTiling(partition);
    } catch (const Error& error) {
        file.refuse(error.what());
    }
    return partition;
}

} // namespace metamarch

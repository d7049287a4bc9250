// SPDX-License-Identifier: MIT
#include "metamarch/bench/ray_file.h"

#include "metamarch/error/error.h"
#include "metamarch/file/input_file.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <optional>

namespace metamarch::bench {
namespace {

using FileRay = std::array<float, 6>;

static_assert(std::endian::native == std::endian::little);

std::vector<FileRay> readAll(const std::filesystem::path& path) {
    const auto refuse = [&](const std::string& what) {
        throw Error(ErrorKind::inputRefused, fmt::format("{}: {}", path.string(), what));
    };
    std::error_code failure;
    const std::filesystem::file_status status = std::filesystem::status(path, failure);
    if (failure && status.type() != std::filesystem::file_type::not_found) {
        refuse(failure.message());
    }
    if (!std::filesystem::is_regular_file(status)) {
        refuse("no such file of rays");
    }
    const std::optional<std::vector<unsigned char>> bytes = readBytes(path);
    if (!bytes) {
        refuse(fmt::format("cannot be read: {}", std::strerror(errno)));
    }
    const std::size_t size = bytes->size();
    if (size == 0 || size % sizeof(FileRay) != 0) {
        refuse(fmt::format("{} bytes are no whole number of rays; a ray is six float32, {} bytes", size,
                           sizeof(FileRay)));
    }
    std::vector<FileRay> rays(size / sizeof(FileRay));
    std::memcpy(rays.data(), bytes->data(), size);
    return rays;
}

} // namespace

RaySet readRayFile(const std::filesystem::path& path) {
    RaySet set;
    for (const FileRay& ray : readAll(path)) {
        const auto refuse = [&](const char* what) {
            throw Error(ErrorKind::inputRefused,
                        fmt::format("{}: ray {} {}", path.string(), set.rays.size(), what));
        };
        for (const float value : ray) {
            if (!std::isfinite(value)) {
                refuse("has a number that is not finite");
            }
        }
        const glm::vec3 dir(ray[3], ray[4], ray[5]);
        if (dir == glm::vec3(0.0f)) {
            refuse("has no direction");
        }
        set.rays.push_back({{ray[0], ray[1], ray[2]}, 0.0f, dir, kFarthest});
    }
    return set;
}

} // namespace metamarch::bench

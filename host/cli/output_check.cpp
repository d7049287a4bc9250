// SPDX-License-Identifier: MIT
#include "metamarch/cli/output_check.h"

#include "metamarch/error/error.h"
#include "metamarch/file/output_target.h"

#include <fmt/format.h>

#include <system_error>

namespace metamarch::cli {
namespace {

// Only regular files lose what they hold. A missing input is refused when it is read.
bool isSameFile(const std::filesystem::path& output, const std::filesystem::path& input) {
    std::error_code failure;
    return std::filesystem::is_regular_file(output, failure) &&
           std::filesystem::equivalent(output, input, failure) && !failure;
}

[[noreturn]] void refuse(const NamedFile& output, const NamedFile& other) {
    throw Error(ErrorKind::invalidArgument,
                fmt::format("{} and {} name the same file", output.option, other.option));
}

} // namespace

void checkOutputsDiffer(const std::span<const NamedFile> outputs, const std::span<const NamedFile> inputs) {
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        const NamedFile& output = outputs[i];
        if (output.path.empty()) {
            continue;
        }
        for (const NamedFile& before : outputs.first(i)) {
            if (!before.path.empty() && isSameOutput(output.path, before.path)) {
                refuse(output, before);
            }
        }
        for (const NamedFile& input : inputs) {
            if (!input.path.empty() && isSameFile(output.path, input.path)) {
                refuse(output, input);
            }
        }
    }
}

std::vector<NamedFile> companionsOf(const Scene& scene) {
    std::vector<NamedFile> companions;
    companions.reserve(scene.files.size());
    for (const std::filesystem::path& file : scene.files) {
        companions.push_back({fmt::format("SCENE's {}", file.filename().string()), file});
    }
    return companions;
}

} // namespace metamarch::cli

// SPDX-License-Identifier: MIT
#include "metamarch/viewer/recent_files.h"

#include "metamarch/error/error.h"
#include "metamarch/file/output_file.h"
#include "metamarch/file/user_folder.h"

#include <algorithm>
#include <fstream>
#include <string>
#include <system_error>

namespace metamarch::viewer {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> linesOf(const fs::path& list) {
    constexpr std::streamsize kLongest = 4096; // of a line, in bytes; Linux opens no longer path
    std::ifstream stream(list, std::ios::binary);
    std::vector<fs::path> files;
    std::string line(kLongest, '\0');
    while (files.size() < RecentFiles::kMost && stream.getline(line.data(), kLongest)) {
        fs::path file(line.c_str());
        if (file.is_absolute()) {
            files.push_back(std::move(file));
        }
    }
    return files;
}

} // namespace

RecentFiles::RecentFiles() : list_(userFolder("XDG_STATE_HOME", ".local/state")) {
    if (list_) {
        *list_ /= "recent_scenes";
    }
}

std::vector<fs::path> RecentFiles::read() const {
    std::vector<fs::path> files = list_ ? linesOf(*list_) : std::vector<fs::path>();
    std::erase_if(files, [](const fs::path& file) {
        std::error_code error;
        return !fs::is_regular_file(file, error);
    });
    return files;
}

void RecentFiles::add(const fs::path& scene) const {
    std::error_code error;
    const fs::path file = fs::absolute(scene, error).lexically_normal();
    if (!list_ || error || file.string().find('\n') != std::string::npos) {
        return;
    }
    std::vector<fs::path> files = linesOf(*list_);
    std::erase(files, file);
    files.insert(files.begin(), file);
    files.resize(std::min(files.size(), kMost));
    std::string text;
    for (const fs::path& each : files) {
        text += each.string() + '\n';
    }
    try {
        fs::create_directories(list_->parent_path(), error);
        writeText(*list_, text);
    } catch (const Error&) {
        // The next window does not list the scene.
    }
}

} // namespace metamarch::viewer

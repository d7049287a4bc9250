// SPDX-License-Identifier: MIT
#include "metamarch/viewer/file_watch.h"

#include <system_error>

namespace metamarch::viewer {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kInterval{250};

} // namespace

void FileWatch::watch(const std::vector<fs::path>& places) {
    watched = places;
    known = look();
    seen = known;
    gone = false;
}

// Leaves out files that do not exist or disappear while it looks.
FileWatch::State FileWatch::look() const {
    State state;
    const auto note = [&](const fs::path& file) {
        std::error_code error;
        const fs::file_time_type time = fs::last_write_time(file, error);
        if (!error) {
            state[file] = time;
        }
    };
    for (const fs::path& place : watched) {
        std::error_code error;
        if (!fs::is_directory(place, error)) {
            note(place);
            continue;
        }
        for (fs::recursive_directory_iterator at(place, error), end; !error && at != end;
             at.increment(error)) {
            note(at->path());
        }
    }
    return state;
}

bool FileWatch::hasChanged() {
    const auto now = std::chrono::steady_clock::now();
    if (now - lastLook < kInterval) {
        return false;
    }
    lastLook = now;
    State current = look();
    const bool isQuiet = current == seen;
    seen = std::move(current);
    if (!isQuiet) {
        return false;
    }
    gone = seen.empty() && !known.empty();
    // A missing file is not a change: it is being replaced, or it was an editor's temporary file. Its old
    // time stays in `known`, so that its return with another time is a change.
    bool isOther = false;
    for (const auto& [file, time] : seen) {
        const auto [at, isNew] = known.try_emplace(file, time);
        isOther = isOther || isNew || at->second != time;
        at->second = time;
    }
    return isOther;
}

} // namespace metamarch::viewer

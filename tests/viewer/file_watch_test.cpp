// SPDX-License-Identifier: MIT
// Files change, appear and disappear.
#include "fixtures/temporary_folder.h"
#include "metamarch/viewer/file_watch.h"

#include <gtest/gtest.h>

#include <fstream>
#include <thread>

namespace metamarch::viewer {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

// Gives every write a different time, however coarse the file system's clock is.
void write(const fs::path& file) {
    static fs::file_time_type time = fs::file_time_type::clock::now();
    std::ofstream(file) << "words\n";
    time += 1s;
    fs::last_write_time(file, time);
}

bool changesSoon(FileWatch& watch) {
    const auto end = std::chrono::steady_clock::now() + 60s;
    while (!watch.hasChanged()) {
        if (std::chrono::steady_clock::now() > end) {
            return false;
        }
        std::this_thread::sleep_for(10ms);
    }
    return true;
}

// Returns true if nothing changes for several looks, which are a quarter of a second apart.
bool staysQuiet(FileWatch& watch) {
    const auto end = std::chrono::steady_clock::now() + 1s;
    while (std::chrono::steady_clock::now() < end) {
        if (watch.hasChanged()) {
            return false;
        }
        std::this_thread::sleep_for(10ms);
    }
    return true;
}

TEST(FileWatch, saysEachChangeOnce) {
    const TemporaryFolder folder;
    write(folder / "a");
    FileWatch watch;
    EXPECT_FALSE(watch.hasChanged()); // watches nothing
    watch.watch({folder / "a"});
    EXPECT_TRUE(staysQuiet(watch));
    for (int i = 0; i < 2; ++i) {
        write(folder / "a");
        EXPECT_TRUE(changesSoon(watch));
        EXPECT_TRUE(staysQuiet(watch));
    }
}

TEST(FileWatch, looksIntoFolders) {
    const TemporaryFolder folder;
    fs::create_directories(folder / "shaders/lib");
    FileWatch watch;
    watch.watch({folder / "shaders"});
    write(folder / "shaders/lib/new");
    EXPECT_TRUE(changesSoon(watch));
    write(folder / "shaders/lib/new");
    EXPECT_TRUE(changesSoon(watch));
    EXPECT_TRUE(staysQuiet(watch));
}

TEST(FileWatch, waitsForAFileThatIsGoneToComeBack) {
    const TemporaryFolder folder;
    write(folder / "a");
    FileWatch watch;
    watch.watch({folder / "a"});
    fs::remove(folder / "a");
    EXPECT_TRUE(staysQuiet(watch));
    write(folder / "a");
    EXPECT_TRUE(changesSoon(watch));
}

TEST(FileWatch, goesOnWhenAnEditorsOwnFileHasGone) {
    const TemporaryFolder folder;
    fs::create_directories(folder / "shaders");
    write(folder / "shaders/path");
    write(folder / "shaders/#path#");
    FileWatch watch;
    watch.watch({folder / "shaders"});
    fs::remove(folder / "shaders/#path#");
    EXPECT_TRUE(staysQuiet(watch));
    write(folder / "shaders/path");
    EXPECT_TRUE(changesSoon(watch));
}

} // namespace
} // namespace metamarch::viewer

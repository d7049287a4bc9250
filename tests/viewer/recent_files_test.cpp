// SPDX-License-Identifier: MIT
#include "metamarch/viewer/recent_files.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

namespace metamarch::viewer {
namespace {

namespace fs = std::filesystem;

class RecentFilesTest : public testing::Test {
  protected:
    RecentFilesTest() {
        std::string name = testing::TempDir() + "metamarch-recent-test-XXXXXX";
        folder = mkdtemp(name.data());
        setenv("XDG_STATE_HOME", (folder / "state").c_str(), 1);
    }
    ~RecentFilesTest() override {
        unsetenv("XDG_STATE_HOME");
        fs::remove_all(folder);
    }

    fs::path list() const { return folder / "state/metamarch/recent_scenes"; }

    fs::path scene(const std::string& name) const {
        std::ofstream(folder / name) << "a scene";
        return folder / name;
    }

    fs::path folder;
};

TEST_F(RecentFilesTest, listsTheNewestFirstAndEachOnce) {
    const RecentFiles recent;
    EXPECT_TRUE(recent.read().empty());
    const fs::path a = scene("a.glb");
    const fs::path b = scene("b with a space.glb");
    recent.add(a);
    recent.add(b);
    EXPECT_EQ(recent.read(), (std::vector{b, a}));
    recent.add(folder / "." / "a.glb");
    EXPECT_EQ(RecentFiles().read(), (std::vector{a, b}));
    EXPECT_EQ(std::distance(fs::directory_iterator(list().parent_path()), {}),
              1); // no temporary file is left
}

TEST_F(RecentFilesTest, keepsTheLastTen) {
    const RecentFiles recent;
    for (int i = 0; i < 12; ++i) {
        recent.add(scene("scene " + std::to_string(i)));
    }
    EXPECT_EQ(recent.read().size(), RecentFiles::kMost);
    EXPECT_EQ(recent.read().front().filename(), "scene 11");
    EXPECT_EQ(recent.read().back().filename(), "scene 2");
}

TEST_F(RecentFilesTest, leavesOutFilesThatAreGone) {
    const RecentFiles recent;
    const fs::path a = scene("a.glb");
    recent.add(a);
    recent.add(scene("b.glb"));
    fs::remove(folder / "b.glb");
    EXPECT_EQ(recent.read(), std::vector{a});
}

TEST_F(RecentFilesTest, aBrokenListIsNoError) {
    const RecentFiles recent;
    const fs::path a = scene("a.glb");
    fs::create_directories(list().parent_path());
    for (const std::string& broken : {std::string(), std::string("relative.glb\n\n"),
                                      std::string(100000, '\xff'), std::string(100, '\0')}) {
        std::ofstream(list(), std::ios::binary) << broken;
        EXPECT_TRUE(recent.read().empty());
        recent.add(a);
        EXPECT_EQ(recent.read(), std::vector{a});
    }
    fs::remove(list());
    fs::create_directory(list());
    recent.add(a); // cannot be written
    EXPECT_TRUE(recent.read().empty());
}

TEST_F(RecentFilesTest, aNameWithALineBreakIsNotKept) {
    const RecentFiles recent;
    recent.add(scene("two\nlines.glb"));
    EXPECT_TRUE(recent.read().empty());
}

} // namespace
} // namespace metamarch::viewer

// SPDX-License-Identifier: MIT
#include "metamarch/viewer/title.h"

#include <gtest/gtest.h>

namespace metamarch::viewer {
namespace {

TEST(Title, saysWhatIsSeenAndAwaited) {
    ViewerState state;
    EXPECT_EQ(titleText(state, false), "metamarch");
    state.file = "folder/cow.glb";
    state.settings.traversal = "meta_table";
    state.settings.samples = 4;
    state.statistics.viewports[0].samples = 2.5;
    EXPECT_EQ(titleText(state, false), "cow.glb - path, 2 of 4 samples - meta_table - metamarch");
    state.settings.channel = "albedo";
    EXPECT_EQ(titleText(state, true),
              "cow.glb - channel albedo, 2 of 4 samples - meta_table - preparing - metamarch");
    state.settings.view = kViewNormals;
    state.settings.secondTraversal = "kd_stack";
    state.loadStage = LoadStage::building;
    EXPECT_EQ(titleText(state, false), "cow.glb - normals - meta_table | kd_stack - building - metamarch");
    state.playback.isPlaying = true;
    EXPECT_EQ(titleText(state, true), "cow.glb - normals - meta_table | kd_stack - metamarch");
}

} // namespace
} // namespace metamarch::viewer

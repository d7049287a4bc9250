// SPDX-License-Identifier: MIT
#include "metamarch/viewer/view_history.h"

#include <gtest/gtest.h>

namespace metamarch::viewer {
namespace {

ViewCamera at(const float x) {
    ViewCamera camera;
    camera.eye.x = x;
    return camera;
}

TEST(ViewHistory, goesBackThroughWhatStoodStill) {
    ViewHistory history;
    history.start(at(0));
    for (const float x : {1.0f, 2.0f, 3.0f}) { // a drag
        history.follow(at(x), 0.1);
    }
    history.follow(at(3), 0.5);
    history.follow(at(4), 0.1);
    EXPECT_EQ(history.undo(at(4)), at(3)); // and 4 is kept
    EXPECT_EQ(history.undo(at(3)), at(0));
    EXPECT_EQ(history.undo(at(0)), std::nullopt);
    EXPECT_EQ(history.redo(), at(3));
    EXPECT_EQ(history.redo(), at(4));
    EXPECT_EQ(history.redo(), std::nullopt);
}

TEST(ViewHistory, aNewViewEndsWhatCouldBeDoneAgain) {
    ViewHistory history;
    history.start(at(0));
    history.keep(at(1));
    history.keep(at(2));
    EXPECT_EQ(history.undo(at(2)), at(1));
    history.keep(at(5));
    EXPECT_EQ(history.redo(), std::nullopt);
    EXPECT_EQ(history.undo(at(5)), at(1));
    EXPECT_EQ(history.first(), at(0));
}

TEST(ViewHistory, forgetsTheOldestButTheFirst) {
    ViewHistory history;
    history.start(at(0));
    for (int i = 1; i <= 3000; ++i) {
        history.keep(at(static_cast<float>(i)));
    }
    int steps = 0;
    ViewCamera last = at(3000);
    while (const std::optional<ViewCamera> before = history.undo(last)) {
        last = *before;
        ++steps;
    }
    EXPECT_EQ(last, at(0));
    EXPECT_EQ(steps, 999);
}

} // namespace
} // namespace metamarch::viewer

// SPDX-License-Identifier: MIT
#include "metamarch/viewer/kept_views.h"

#include <gtest/gtest.h>

namespace metamarch::viewer {
namespace {

KeptView at(const float x) {
    KeptView view;
    view.camera.eye.x = x;
    view.settings.tone.exposure = x;
    return view;
}

TEST(KeptViews, flipsTheOnlyOneAndThePresentView) {
    KeptViews kept;
    EXPECT_EQ(kept.next(), Shown::present);
    kept.keep(Shown::b, at(2));
    EXPECT_EQ(kept.next(), Shown::b);
    EXPECT_EQ(kept.show(Shown::b, at(3)).camera, at(2).camera);
    EXPECT_EQ(kept.next(), Shown::present);
    const KeptView back = kept.show(Shown::present, at(2));
    EXPECT_EQ(back.camera, at(3).camera);
    EXPECT_EQ(back.settings, at(3).settings);
}

TEST(KeptViews, flipsAAndBByTurns) {
    KeptViews kept;
    kept.keep(Shown::a, at(1));
    kept.keep(Shown::b, at(2));
    EXPECT_EQ(kept.next(), Shown::a);
    EXPECT_EQ(kept.show(Shown::a, at(3)).camera, at(1).camera);
    EXPECT_EQ(kept.next(), Shown::b);
    EXPECT_EQ(kept.show(Shown::b, at(1)).settings, at(2).settings);
    EXPECT_EQ(kept.next(), Shown::a);
    EXPECT_EQ(kept.show(Shown::present, at(2)).camera, at(3).camera); // not A, which was shown before
}

TEST(KeptViews, aChangeGoesOnFromTheKeptView) {
    KeptViews kept;
    kept.keep(Shown::a, at(1));
    KeptView shown = kept.show(Shown::a, at(3));
    EXPECT_TRUE(kept.isOf(shown));
    shown.settings.hasPanels = !shown.settings.hasPanels; // is no part of a picture
    EXPECT_TRUE(kept.isOf(shown));
    shown.settings.tone.exposure += 1.0f;
    EXPECT_FALSE(kept.isOf(shown));
    EXPECT_EQ(kept.leave().camera, at(3).camera);
    EXPECT_EQ(kept.shown(), Shown::present);
    EXPECT_TRUE(kept.has(Shown::a));
    EXPECT_FALSE(kept.has(Shown::b));
}

TEST(KeptViews, panelsStayAsTheyAre) {
    KeptViews kept;
    kept.keep(Shown::a, at(1)); // with panels
    KeptView now = at(2);
    now.settings.hasPanels = false;
    EXPECT_FALSE(kept.show(Shown::a, now).settings.hasPanels);
    now.settings.hasHelp = true;
    EXPECT_TRUE(kept.show(Shown::present, now).settings.hasHelp);
}

} // namespace
} // namespace metamarch::viewer

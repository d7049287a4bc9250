# SPDX-License-Identifier: MIT
"""Picks a triangle under the cursor, and marches a ray to it."""
from viewer import CORNELL, ViewerTest, main

# The opaque colours of host/viewer/overlay.cpp.
PICKED = bytes((255, 210, 60))
HIT = bytes((255, 60, 90))


def count(picture, color):
    return sum(picture[2][i:i + 3] == color for i in range(0, len(picture[2]), 3))


class PickTest(ViewerTest):
    def test_pick_and_march(self):
        viewer = self.open(CORNELL, "--spp", "1")
        viewer.wait_for_samples()
        bare = viewer.wait_for_still()
        self.assertEqual(count(bare, PICKED) + count(bare, HIT), 0)

        viewer.click(80, 100)
        picked = viewer.wait_for_still()
        self.assertGreater(count(picked, PICKED), 20)

        viewer.click(80, 100, "Alt_L")
        marched = viewer.wait_for_still()
        self.assertGreater(count(marched, HIT), 20)
        self.assertNotEqual(marched, picked)

        viewer.drag((80, 60), (110, 70))  # the camera moves, the ray stays
        turned = viewer.wait_for_still()
        self.assertNotEqual(turned, marched)
        self.assertGreater(count(turned, HIT), 0)
        self.quit(viewer)

    def test_a_click_beside_the_scene_picks_nothing(self):
        viewer = self.open(CORNELL, "--spp", "1", "--eye", "0,0,20", "--target", "0,0,0")
        bare = viewer.wait_for_still()
        viewer.click(80, 60)
        self.assertNotEqual(viewer.wait_for_still(), bare)
        viewer.click(3, 3)
        self.assert_shows(viewer, bare)
        viewer.click(3, 3, "Alt_L")
        viewer.click(3, 3, "Control_L")
        viewer.settle()
        self.quit(viewer)


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: MIT
"""The guided tour: ten screens, each of which can be left and explored."""
from viewer import CORNELL, ViewerTest, main

SCREENS = ("headlight - meta_table", "steps - uniform_grid", "tests - uniform_grid", "steps - kd_stack", "headlight - kd_stack",
           "cell borders - meta_table", "leaf id - meta_table", "exit boxes - meta_table", "headlight - meta_table",
           r"steps - kd_stack \| meta_table")


class TourTest(ViewerTest):
    def test_ten_screens(self):
        viewer = self.open(CORNELL, "--tour", size="480x360")
        seen = set()
        for shown in SCREENS:
            viewer.wait_for_title(f"cornell.glb - {shown} - metamarch")
            seen.add(viewer.wait_for_still())
            viewer.key("Page_Down")
        self.assertEqual(len(seen), 10)
        viewer.wait_for_title(f"cornell.glb - {SCREENS[-1]} - metamarch")  # it is the last
        viewer.key("v")  # explore
        viewer.wait_for_title(r"cornell.glb - tests - kd_stack \| meta_table - metamarch")
        viewer.key("Page_Down")  # and come back
        viewer.wait_for_title(f"cornell.glb - {SCREENS[-1]} - metamarch")
        viewer.key("Page_Up")
        viewer.wait_for_title(f"cornell.glb - {SCREENS[-2]} - metamarch")
        self.quit(viewer)

    def test_the_shipped_scene(self):
        viewer = self.open(None, "--tour")
        viewer.wait_for_title("objects.glb - headlight - meta_table - metamarch")
        self.quit(viewer)


if __name__ == "__main__":
    main()

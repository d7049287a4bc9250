# SPDX-License-Identifier: MIT
"""The values of the pixel under the cursor."""
from viewer import CORNELL, ViewerTest, main


class ReadoutTest(ViewerTest):
    def test_follows_the_cursor(self):
        viewer = self.open(CORNELL, "--spp", "1", size="480x360")
        viewer.display.move(viewer.window, 100, 60)
        plain = viewer.wait_for_still()
        viewer.key("i")
        first = viewer.wait_for_still_other_than(plain)
        viewer.display.move(viewer.window, 100, 70)
        second = viewer.wait_for_still_other_than(first)
        viewer.key("v")  # a view has no film: only the hit remains
        viewer.wait_for_still_other_than(second)
        viewer.key("Shift_L", "v")
        viewer.wait_for_picture(second)
        viewer.key("i")
        viewer.wait_for_picture(plain)
        self.quit(viewer)


if __name__ == "__main__":
    main()

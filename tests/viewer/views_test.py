# SPDX-License-Identifier: MIT
"""Heat maps choose their range, and depths have a legend."""
from viewer import OBJECTS, ViewerTest, main

TEXT = 13  # height of Dear ImGui's own font, in pixels


def hottest(picture):
    """The part of the pixels that have the hottest colour."""
    width, height, pixels = picture
    return sum(pixels[i] > 245 and pixels[i + 1] > 245 for i in range(0, len(pixels), 3)) / (width * height)


class ViewsTest(ViewerTest):
    def test_the_range_of_a_heat_map_fits_its_picture(self):
        viewer = self.open(OBJECTS, "--view", "steps", "--traversal", "uniform_grid", size="320x240")
        viewer.wait_until("a range without saturated pixels", lambda: 0 < hottest(viewer.screenshot()) < 0.02)
        viewer.wait_for_still()
        self.quit(viewer)

    def test_depths_have_a_legend(self):
        width, height = 480, 360
        viewer = self.open(OBJECTS, "--view", "depth", size=f"{width}x{height}")
        _width, _height, pixels = viewer.wait_for_still()
        # The legend is 16 heights of the text wide, 2 from the right edge and 2.5 from the lower one.
        left, right, y = width - 18 * TEXT + 2, width - 2 * TEXT - 2, height - 3 * TEXT
        self.assertGreater(min(pixels[3 * (y * width + left):][:3]), 240)
        self.assertLess(max(pixels[3 * (y * width + right):][:3]), 15)
        self.quit(viewer)


if __name__ == "__main__":
    main()

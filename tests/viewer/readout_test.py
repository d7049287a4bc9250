# SPDX-License-Identifier: MIT
"""The values of the pixel under the cursor."""
from display import WHEEL_DOWN, WHEEL_UP
from viewer import CORNELL, ViewerTest, main


def magnified(picture, scale, skipped):
    """What a zoom into pixels shows; `skipped` are the window's pixels left of it and above."""
    width, height, pixels = picture
    rows = []
    for y in range(height):
        at = (y + skipped[1]) // scale * width
        rows.append(b"".join(pixels[3 * (at + x):3 * (at + x) + 3] for x in ((i + skipped[0]) // scale for i in range(width))))
    return b"".join(rows)


class ReadoutTest(ViewerTest):
    def wheel(self, viewer, button, clicks):
        viewer.display.hold("Control_L", True)
        for _ in range(clicks):
            viewer.display.press(button)
            viewer.display.release(button)
        viewer.display.hold("Control_L", False)

    def test_zooms_into_pixels(self):
        viewer = self.open(CORNELL, "--spp", "2", size="480x360")
        viewer.display.move(viewer.window, 200, 100)
        viewer.wait_for_samples()
        plain = viewer.wait_for_still()
        below = 3 * 480 * 180  # below the cursor and the label
        self.wheel(viewer, WHEEL_UP, 3)
        place = [7 * 200, 7 * 100]
        shown = viewer.wait_for_still_other_than(plain)
        self.assertEqual(shown[2][below:], magnified(plain, 8, place)[below:])
        viewer.drag((300, 60), (180, 40))  # the picture, and not the camera
        shown = viewer.wait_for_still_other_than(shown)
        self.assertEqual(shown[2][below:], magnified(plain, 8, (place[0] + 120, place[1] + 20))[below:])
        viewer.click(10, 300)  # picks what is seen there
        viewer.wait_for_still_other_than(shown)
        viewer.key("Escape")  # first from the pixels
        viewer.key("Escape")
        viewer.wait_for_picture(plain)
        self.wheel(viewer, WHEEL_UP, 1)
        viewer.wait_for_still_other_than(plain)
        self.wheel(viewer, WHEEL_DOWN, 1)
        viewer.wait_for_picture(plain)
        self.quit(viewer)

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

    def test_reads_the_side_under_the_cursor(self):
        """The picture is the same on both sides, but the numbers of steps differ."""
        def open_at(x, *words):
            viewer = self.open(CORNELL, "--spp", "1", "--vfov", "10", *words, size="800x400")  # all of it hits
            viewer.display.move(viewer.window, x, 30)
            viewer.key("i")
            return viewer

        def side(picture, x):
            width, height, pixels = picture
            first, end = (0, width // 2 - 3) if x < width // 2 else (width // 2 + 3, width)
            rows = range(height - 30)  # above the names of the sides
            return [pixels[3 * (y * width + first):3 * (y * width + end)] for y in rows]

        for x, names in ((100, ("meta_table", "kd_stack")), (500, ("kd_stack", "meta_table"))):
            with self.subTest(x=x):
                pictures = []
                for name in names:
                    viewer = open_at(x, "--traversal", name)
                    pictures.append(side(viewer.wait_for_still(), x))
                    self.quit(viewer)
                self.assertTrue(pictures[0] != pictures[1])
                viewer = open_at(x, "--traversal", "meta_table", "--split", "kd_stack")
                viewer.wait_until("the numbers of the side", lambda: side(viewer.screenshot(), x) == pictures[0])
                self.quit(viewer)


if __name__ == "__main__":
    main()

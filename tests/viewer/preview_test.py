# SPDX-License-Identifier: MIT
"""The preview while the camera moves: it has no noise, and the path tracer's film takes its place."""
from display import LEFT
from panel_test import BAR, CONTROL, MIDDLE
from viewer import OBJECTS, ViewerTest, main

MISS = bytes((0x25, 0x27, 0x2b))  # kMissColor, where the film is black


def corner(viewer):
    """A pixel that sees no object, from the right upper corner."""
    width, _height, pixels = viewer.screenshot()
    return pixels[3 * (width - 4):3 * (width - 3)]


class PreviewTest(ViewerTest):
    WORDS = ("--spp", "2", "--eye", "0,9,30", "--target", "0,2,0")

    def test_gives_way_to_the_film(self):
        viewer = self.open(OBJECTS, *self.WORDS)
        viewer.wait_for_samples()
        self.assertNotEqual(corner(viewer), MISS)
        viewer.display.move(viewer.window, 80, 60)
        viewer.display.press(LEFT)
        moves = 0

        def is_previewed():
            nonlocal moves
            moves += 1
            viewer.display.move(viewer.window, 80 + moves % 20, 60)
            return corner(viewer) == MISS

        viewer.wait_until("the preview", is_previewed)
        viewer.display.release(LEFT)
        options = viewer.settle()
        viewer.wait_for_samples()
        self.assert_shows(viewer, self.render(OBJECTS, "--spp", "2", *options))
        self.quit(viewer)

    def test_is_switched_off_in_the_panel(self):
        viewer = self.open(OBJECTS, *self.WORDS, "--exposure", "-20", size="460x400", panels=True)
        viewer.wait_for_samples()
        preview = 9 + 2 * BAR + 5 * CONTROL + MIDDLE  # below view, samples, traversal, split and denoise
        viewer.display.move(viewer.window, 20, preview)
        viewer.display.press(LEFT)
        viewer.settle()
        viewer.display.release(LEFT)
        viewer.settle()
        for key in ("7", "Return", "1", "3"):  # each begins another picture
            viewer.key(key)
            viewer.wait_for_title(r".* - \w+, 0 of .*")
            self.assertNotEqual(corner(viewer), MISS)
            viewer.wait_for_samples()
        self.quit(viewer)


if __name__ == "__main__":
    main()

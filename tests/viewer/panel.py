# SPDX-License-Identifier: MIT
"""The panel of a window: where its sections and controls are, and how a user sets them."""
import time

from display import LEFT
from viewer import ViewerTest

# Dear ImGui's measures with its own font, in pixels.
BAR, CONTROL, TEXT = 23, 23, 17  # the height of a section's header, of a line with a control, of a line of text
MIDDLE = 9  # of a header or control, from its top
# Seconds. Dear ImGui takes one change of a key or button a frame, so it is some frames behind the keys of settle, which
# the program takes at once.
BEHIND = 1.0


class PanelTest(ViewerTest):
    def sections(self, viewer):
        """The tops of the panel's title and of its sections' headers: their bars are blue from side to side."""
        width, height, pixels = viewer.wait_for_still()

        def is_blue(x, y):
            red, green, blue = pixels[3 * (y * width + x):3 * (y * width + x) + 3]
            return blue > 50 and blue > 1.3 * green and blue > 1.8 * red

        blue = [all(is_blue(x, y) for x in (180, 240, 300)) for y in range(height)]
        return [y for y in range(1, height) if blue[y] and not blue[y - 1]]

    @staticmethod
    def slide(viewer, start, end):
        """Drags slowly: the panel looks at the mouse once a frame."""
        for step in (lambda: viewer.display.move(viewer.window, *start), lambda: viewer.display.press(LEFT),
                     lambda: viewer.display.move(viewer.window, *end), lambda: viewer.display.release(LEFT)):
            step()
            viewer.settle()
        time.sleep(BEHIND)

    def click(self, viewer, x, y):
        self.slide(viewer, (x, y), (x, y))

    def choose(self, viewer, y, index):
        """Chooses from the list of names that the control at height y opens."""
        self.click(viewer, 60, y)
        self.click(viewer, 60, y + CONTROL + index * TEXT)

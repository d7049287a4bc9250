# SPDX-License-Identifier: MIT
"""The switch of the panel that filters the first samples."""
import re

from panel import BAR, CONTROL, MIDDLE, PanelTest
from viewer import CORNELL, main

SWITCH = (20, 9 + 2 * BAR + 6 * CONTROL + MIDDLE)  # below view, samples, traversal, split, denoise and preview
FIRST, LAST = 2, 16  # samples of a picture that is filtered


class FilterTest(PanelTest):
    def samples(self, viewer):
        found = re.search(r", (\d+) of \d+ samples", viewer.title)
        return int(found[1]) if found else 0

    def noise(self, viewer):
        """Begins the picture again and returns the mean difference of neighbours in one of its first samples."""
        viewer.key("Tab")
        viewer.settle()

        def early():
            # The view is the same afterwards, but the picture begins anew. In a single frame the keys would cancel out,
            # and the window would still show the picture from before the switch.
            viewer.key("period")
            viewer.settle()
            viewer.key("comma")
            viewer.settle()
            viewer.wait_until("the first samples", lambda: self.samples(viewer) >= FIRST)
            viewer.settle()  # until then the screen may show the preview
            picture = viewer.screenshot()[2]
            return picture if self.samples(viewer) <= LAST else None

        picture = viewer.wait_until("a picture of few samples", early)
        viewer.key("Tab")
        viewer.settle()
        return sum(abs(picture[i] - picture[i + 3]) for i in range(len(picture) - 3)) / len(picture)

    def test_the_switch(self):
        viewer = self.open(CORNELL, "--spp", "100000", size="460x400", panels=True)
        filtered = self.noise(viewer)
        self.click(viewer, *SWITCH)
        plain = self.noise(viewer)
        self.assertGreater(plain, 2 * filtered)
        self.click(viewer, *SWITCH)
        self.assertGreater(plain, 2 * self.noise(viewer))
        self.quit(viewer)


if __name__ == "__main__":
    main()

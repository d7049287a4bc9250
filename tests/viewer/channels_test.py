# SPDX-License-Identifier: MIT
"""Every channel of the film is in the menu of views, and each shows something of its own."""
import re

from panel import BAR, CONTROL, MIDDLE, TEXT, PanelTest
from viewer import OBJECTS, main

VIEW = 9 + 2 * BAR + MIDDLE  # the panel's first control
LINE = 5  # between views and channels


class ChannelsTest(PanelTest):
    def test_each_channel(self):
        viewer = self.open(OBJECTS, "--spp", "3", "--sky", size="460x800", panels=True)
        viewer.wait_for_samples()
        bottom = 800 - VIEW - CONTROL
        pictures = {}
        for index in range(1, bottom // TEXT):
            self.click(viewer, 60, VIEW)
            self.click(viewer, 60, VIEW + CONTROL + LINE + index * TEXT)
            found = re.search(r" - channel ([\w. ]+), ", viewer.title)
            if not found and pictures:
                break  # below the list
            if found and found[1] not in pictures:
                viewer.key("Tab")
                viewer.wait_for_samples()
                pictures[found[1]] = viewer.wait_for_still()
                viewer.key("Tab")
                viewer.settle()
        self.assertLessEqual({"A", "Z", "N", "albedo", "variance", "P", "UV", "id.mesh", "samples", "tests"}, set(pictures))
        same = [(a, b) for a in pictures for b in pictures if a < b and pictures[a] == pictures[b]]
        self.assertEqual(same, [])
        self.assertNotIn(self.render(OBJECTS, "--spp", "3", "--sky", size="460x800"), list(pictures.values()))
        self.quit(viewer)


if __name__ == "__main__":
    main()

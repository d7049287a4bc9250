# SPDX-License-Identifier: MIT
"""Traversals, the split view and the debug views."""
import re

from display import LEFT
from viewer import CORNELL, OBJECTS, ViewerTest, main


class TraversalTest(ViewerTest):
    def test_every_traversal_shows_the_same_picture(self):
        viewer = self.open(CORNELL, "--spp", "2")
        viewer.wait_for_samples()
        first = viewer.wait_for_still()
        for name in ("rectilinear_table", "kd_stack"):
            viewer.key("t")
            viewer.wait_for_title(rf".* 2 of 2 samples - {name} - metamarch")
            self.assert_shows(viewer, first)
        viewer.key("x")
        viewer.wait_for_title(r".* 2 of 2 samples - kd_stack \| kd_restart - metamarch")
        width, height, split = viewer.wait_for_still()
        self.assertNotEqual(split, first[2])  # the split line and the names of the traversals

        def row(pixels, y, start, end):
            return pixels[3 * (y * width + start):3 * (y * width + end)]

        for y in range(0, height // 2):  # above the labels
            for start, end in ((0, width // 2 - 3), (width // 2 + 3, width)):
                self.assertEqual(row(split, y, start, end), row(first[2], y, start, end))
        options = viewer.settle()
        viewer.drag((80, 20), (40, 20), LEFT)  # drags the split line
        self.assertEqual(viewer.settle(), options)
        viewer.key("x")
        viewer.wait_for_title(r".* 2 of 2 samples - kd_stack - metamarch")
        self.assert_shows(viewer, first)
        self.quit(viewer)

    def views(self):
        """The names of the views in the order of the menu; --help lists them."""
        # The list may go on in further lines; the option's help follows it.
        listing = re.search(r"--view (\S.*?)\n +What the window", self.succeed("view", "--help"), re.DOTALL).group(1)
        return [" ".join(name.split()) for name in listing.split("|")]

    def test_views(self):
        views = self.views()
        self.assertIn("leaf id", views)
        viewer = self.open(OBJECTS, "--spp", "1")
        viewer.wait_for_samples()
        picture = viewer.wait_for_still()
        seen = {}
        before = picture
        for name in views:
            viewer.key("v")
            viewer.wait_for_title(rf"objects\.glb - {name} - meta_table - metamarch")
            seen[name] = viewer.wait_for_still()
            # The objects neither emit nor transmit, so both views are black.
            self.assertEqual(seen[name] == before, name == "transmission", name)
            before = seen[name]
        viewer.key("v")
        viewer.wait_for_title(r"objects\.glb - path, 1 of 1 samples - meta_table - metamarch")
        self.assert_shows(viewer, picture)
        for name in reversed(views[-2:]):
            viewer.key("Shift_L", "v")
            viewer.wait_for_title(rf"objects\.glb - {name} - meta_table - metamarch")
            self.assert_shows(viewer, seen[name])
        viewer.key("h")
        viewer.wait_for_title(r"objects\.glb - steps - meta_table - metamarch")
        self.assert_shows(viewer, seen["steps"])
        viewer.key("h")
        self.assert_shows(viewer, picture)
        self.quit(viewer)

    def test_options_choose_what_keys_do(self):
        viewer = self.open(OBJECTS, "--view", "leaf id", "--traversal", "kd_stack", "--split", "bvh_stack")
        viewer.wait_for_title(r"objects\.glb - leaf id - kd_stack \| bvh_stack - metamarch")
        self.quit(viewer)


if __name__ == "__main__":
    main()

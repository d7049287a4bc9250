# SPDX-License-Identifier: MIT
"""The march of a ray, step by step: keys, what each step draws, and its pictures."""
from pick_test import HIT, count
from viewer import CORNELL, OBJECTS, ViewerTest, main

STACK = bytes((255, 210, 60))  # kWaiting of host/viewer/walk_diagram.cpp


class MarchTest(ViewerTest):
    def test_steps_and_their_pictures(self):
        viewer = self.open(CORNELL, "--spp", "1", "--view", "normals", size="400x300")
        viewer.key("Control_L", "p")
        viewer.wait_for_line("there is no march to save: .*")
        plain = viewer.wait_for_still()
        viewer.click(200, 180, "Alt_L")
        whole = viewer.wait_for_still_other_than(plain)
        self.assertGreater(count(whole, HIT), 20)
        viewer.key("Right")
        first = viewer.wait_for_still_other_than(whole)
        viewer.key("Right")
        second = viewer.wait_for_still_other_than(first)
        viewer.key("Left")
        viewer.wait_for_picture(first)
        viewer.key("Left")
        viewer.wait_for_picture(whole)

        viewer.key("Control_L", "p")
        saved = int(viewer.wait_for_line(rf"saved (\d+) steps, the last as {self.tmp}/cornell_march_\d+\.png")[1])
        self.assertEqual(sorted(file.name for file in self.tmp.iterdir()),
                         [f"cornell_march_{i + 1:03}.png" for i in range(saved)])
        self.assertEqual(self.pixels("cornell_march_001.png"), first)
        self.assertEqual(self.pixels("cornell_march_002.png"), second)
        last = viewer.wait_for_still()
        self.assertEqual(self.pixels(f"cornell_march_{saved:03}.png"), last)
        self.assertGreater(count(last, HIT), 20)
        self.assertGreater(count(first, HIT), 20)  # in the legend

        viewer.key("space")  # from the start to the end
        viewer.wait_for_picture(first)
        viewer.wait_for_picture(last)
        viewer.key("Escape")
        viewer.wait_for_picture(plain)

        viewer.click(200, 180, "Alt_L")
        viewer.wait_for_picture(whole)
        viewer.key("space")  # and away while it plays, or while it is saved
        viewer.key("Escape")
        viewer.click(200, 180, "Alt_L")
        viewer.key("Control_L", "p")
        viewer.key("Escape")
        viewer.wait_for_picture(plain)
        self.quit(viewer)

    def test_the_stack_traversal_beside_it(self):
        viewer = self.open(CORNELL, "--spp", "1", "--view", "normals", size="1000x400")
        viewer.click(400, 240, "Alt_L")
        whole = viewer.wait_for_still()
        self.assertEqual(count(whole, STACK), 0)
        viewer.key("Right")
        first = viewer.wait_for_still_other_than(whole)
        self.assertGreater(count(first, STACK), 100)
        viewer.key("Right")  # the counters go on
        self.assertGreater(count(viewer.wait_for_still_other_than(first), STACK), 100)
        viewer.resize(600, 400)  # too narrow
        viewer.wait_until("no diagram", lambda: count(viewer.screenshot(), STACK) == 0)
        self.quit(viewer)

    def test_the_table_below_it(self):
        viewer = self.open(OBJECTS, "--spp", "1", "--view", "normals", size="1000x700")
        viewer.click(450, 350, "Alt_L")

        def table(picture):
            """The part of the window that has the drawing of the table: rows of pixels."""
            width, _height, pixels = picture
            return [pixels[3 * (width * y + 600):3 * (width * y + 980)] for y in range(275, 550)]

        def title(picture):
            """How many white pixels there are where the drawing has its title."""
            return sum(row.count(b"\xff\xff\xff") for row in table(picture)[:20])

        whole = viewer.wait_for_still()
        self.assertEqual(title(whole), 0)
        viewer.key("Right")
        first = viewer.wait_for_still_other_than(whole)
        self.assertGreater(title(first), 100)
        self.assertTrue(all(a != b for a, b in zip(table(whole), table(first))))
        viewer.key("Right")  # another entry, and most often another brick
        second = viewer.wait_for_still_other_than(first)
        self.assertGreater(sum(a != b for a, b in zip(table(first), table(second))), 20)
        viewer.resize(1000, 600)  # too low: there is the scene again
        self.assertEqual(title(viewer.wait_for_still_other_than(second)), 0)
        self.quit(viewer)


if __name__ == "__main__":
    main()

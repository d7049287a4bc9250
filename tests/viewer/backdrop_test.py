# SPDX-License-Identifier: MIT
"""What the window shows behind the scene in place of its surroundings. The scene's light stays the same."""
from panel import CONTROL, MIDDLE, PanelTest
from viewer import OBJECTS, main

WORDS = ("--sky", "--spp", "2", "--eye", "3,1,6", "--target", "0,1.5,0")
SIZE = "460x800"
NOTHING, COLOUR, BLURRED = 1, 2, 3
WHITE = bytes((255, 255, 255))


class BackdropTest(PanelTest):
    def choose_backdrop(self, viewer, index, lines=1):
        """The control is the last one above the statistics, with `lines` lines."""
        viewer.key("Tab")
        viewer.settle()
        statistics = self.sections(viewer)[2]
        self.choose(viewer, statistics - 4 - lines * CONTROL + MIDDLE, index)
        viewer.wait_for_samples()
        viewer.key("Tab")
        return viewer.wait_for_still()[2]

    def save(self, viewer, *keys):
        viewer.read = len(viewer.stdout())
        viewer.key(*keys)
        return viewer.wait_for_line("saved (.*), 2 samples a pixel")[1]

    def coverage(self, name):
        picture = self.read_picture(name)
        return [value for row in picture["A"] for value in row]

    def test_each_kind(self):
        viewer = self.open(OBJECTS, *WORDS, size=SIZE, panels=True)  # unfolds the panel
        viewer.key("Tab")
        plain = self.render(OBJECTS, *WORDS, size=SIZE)
        self.assert_shows(viewer, plain)

        self.choose_backdrop(viewer, NOTHING)
        for ending, keys in (("png", ["p"]), ("exr", ["Control_L", "s"])):
            self.succeed("render", OBJECTS, *WORDS, "--transparent", "--size", SIZE, "--quiet", "-o", f"headless.{ending}")
            saved = self.save(viewer, *keys)
            self.succeed("compare", saved, f"headless.{ending}", "--max-abs", "0")
        coverage = self.coverage("headless.exr")
        inside = [3 * i for i, part in enumerate(coverage) if part == 1]
        outside = [3 * i for i, part in enumerate(coverage) if part == 0]
        self.assertGreater(min(len(inside), len(outside)), len(coverage) / 10)

        colour = self.choose_backdrop(viewer, COLOUR)
        self.assertEqual([i for i in inside if colour[i:i + 3] != plain[2][i:i + 3]], [])
        self.assertEqual([i for i in outside if colour[i:i + 3] != WHITE], [])
        self.assertEqual(self.pixels(self.save(viewer, "p"))[2], colour)

        blurred = self.choose_backdrop(viewer, BLURRED, lines=2)
        self.assertEqual([i for i in inside if blurred[i:i + 3] != plain[2][i:i + 3]], [])
        self.assertEqual(self.pixels(self.save(viewer, "p"))[2], blurred)
        behind = set(outside)
        steps = [abs(blurred[i + c] - blurred[i + 3 + c]) for i in outside if i + 3 in behind for c in range(3)]
        self.assertLess(max(steps), 8)
        colours = {blurred[i:i + 3] for i in outside}
        self.assertGreater(len(colours), 10)
        self.assertNotIn(WHITE, colours)
        viewer.key("minus")  # the exposure is that of the scene
        viewer.wait_for_still_other_than((460, 800, blurred))
        darker = viewer.screenshot()[2]
        self.assertLess(sum(darker[i] for i in outside), sum(blurred[i] for i in outside))
        self.quit(viewer)


if __name__ == "__main__":
    main()

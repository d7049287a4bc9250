# SPDX-License-Identifier: MIT
"""Saves pictures of the window to files."""
from viewer import CORNELL, ViewerTest, main


class SavingTest(ViewerTest):
    def test_both_kinds(self):
        viewer = self.open(CORNELL, "--spp", "5", "--filter", "tent")
        viewer.wait_for_samples()
        (self.tmp / "cornell_002.png").write_text("somebody else's")
        for name in ("cornell_001.png", "cornell_003.png"):
            viewer.key("p")
            viewer.wait_for_line(rf"saved {self.tmp}/{name}, 5 samples a pixel")
        for name in ("cornell_001.exr", "cornell_002.exr"):
            viewer.key("Control_L", "s")
            viewer.wait_for_line(rf"saved {self.tmp}/{name}, 5 samples a pixel")
        self.assertEqual((self.tmp / "cornell_002.png").read_text(), "somebody else's")
        for ending in ("png", "exr"):
            self.succeed("render", CORNELL, "--spp", "5", "--filter", "tent", "--size", "160x120", "--quiet", "-o", f"headless.{ending}")
        for name in ("cornell_001.png", "cornell_003.png"):
            self.succeed("compare", name, "headless.png", "--max-abs", "0")
        for name in ("cornell_001.exr", "cornell_002.exr"):
            self.succeed("compare", name, "headless.exr", "--max-abs", "0")
        self.assertEqual(set(self.read_picture("cornell_001.exr")), set(self.read_picture("headless.exr")))
        self.quit(viewer)

    def test_views_and_their_refusal(self):
        viewer = self.open(CORNELL, "--spp", "1", "--view", "normals")
        shown = viewer.wait_for_still()
        viewer.key("p")
        viewer.wait_for_line(f"saved {self.tmp}/cornell_001.png")
        self.assertEqual(self.pixels("cornell_001.png"), shown)
        viewer.key("Control_L", "s")
        viewer.wait_for_line("a view has no film to save: .*")
        self.assertEqual([file.name for file in self.tmp.iterdir()], ["cornell_001.png"])
        self.quit(viewer)

    def test_with_what_lies_over_it(self):
        viewer = self.open(CORNELL, "--spp", "1", "--view", "normals")
        viewer.click(80, 90)  # marks a triangle
        shown = viewer.wait_for_still()
        viewer.key("Shift_L", "p")
        viewer.wait_for_line(f"saved {self.tmp}/cornell_001.png, all that the window shows")
        self.assertEqual(self.pixels("cornell_001.png"), shown)
        viewer.key("p")
        viewer.wait_for_line(f"saved {self.tmp}/cornell_002.png")
        viewer.key("Escape")
        plain = viewer.wait_for_still_other_than(shown)
        self.assertEqual(self.pixels("cornell_002.png"), plain)
        self.quit(viewer)

    def test_a_folder_that_takes_no_files(self):
        viewer = self.open(CORNELL, "--spp", "1")
        viewer.wait_for_samples()
        self.tmp.rmdir()
        viewer.key("p")
        viewer.wait_for_line(r".*cannot write cornell_001\.png.*")
        self.tmp.mkdir()
        self.quit(viewer)


if __name__ == "__main__":
    main()

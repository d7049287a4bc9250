# SPDX-License-Identifier: MIT
"""Calls that open no window: exit code and the one line on stderr."""
import os

from viewer import CORNELL, ViewerTest, main


class RefusalTest(ViewerTest):
    def test_without_a_display(self):
        self.assertRegex(self.refuse(4, "view", CORNELL, DISPLAY="", WAYLAND_DISPLAY=""),
                         r"\Ano display to open a window on \(.*\); `metamarch render` needs none\Z")
        without = {name: os.environ.pop(name) for name in ("DISPLAY", "WAYLAND_DISPLAY") if name in os.environ}
        try:
            self.assertIn("no display", self.refuse(4, "view", CORNELL))
        finally:
            os.environ.update(without)
        self.assertIn("no display", self.refuse(4, "view", CORNELL, DISPLAY=":65000"))

    def test_bad_arguments(self):
        for words, line in (
                ((CORNELL, "--view", "sideways"), r"--view sideways: give steps, .* or headlight"),
                ((CORNELL, "--traversal", "nap"), r"--traversal nap: give meta_table, .*"),
                ((CORNELL, "--split", "nap"), r"--split nap: give meta_table, .*"),
                ((CORNELL, "--integrator", "primary"), r"--integrator primary: give path, direct or ao"),
                ((CORNELL, "--size", "0x5"), r"--size \S+: give WIDTHxHEIGHT in pixels, .*"),
                ((CORNELL, "--size", "much"), r"--size \S+: give WIDTHxHEIGHT in pixels, .*"),
                ((CORNELL, "--spp", "0"), r".*--spp.*"),
                ((CORNELL, "--eye", "0,0,1"), r"--eye needs --target"),
                ((CORNELL, "--camera", "nobody"), r"there is no camera nobody; the scene has 0 'front' \(--camera\)"),
                ((CORNELL, "--eye", "0,0,1", "--target", "0,0,1"), r".+"),
                ((CORNELL, "--shaders", "nowhere"), r"--shaders nowhere: there is no such folder"),
                ((CORNELL, "--vfov", "180"), r"--vfov 180: .*"),
                ((CORNELL, "--exposre", "1"), r"view: unknown argument `--exposre`; did you mean `--exposure`\? .*"),
        ):
            with self.subTest(words=words):
                self.assertRegex(self.refuse(2, "view", *words, DISPLAY=self.display.name), rf"\A{line}\Z")
        self.assertEqual(self.display.windows(), [])

    def test_scenes_that_cannot_be_read(self):
        (self.tmp / "prose.glb").write_text("It was a dark and stormy night.\n")
        for words, line in ((("missing.glb", ), "missing.glb: no such file"), (("prose.glb", ), "prose.glb: .*"),
                            ((CORNELL, "--env", "missing.hdr"), ".*missing.hdr.*")):
            with self.subTest(words=words):
                self.assertRegex(self.refuse(3, "view", *words, DISPLAY=self.display.name), rf"\A{line}\Z")
        self.assertEqual(self.display.windows(), [])

    def test_devices(self):
        self.assertIn("nothing", self.refuse(4, "view", CORNELL, "--device", "nothing", DISPLAY=self.display.name))


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: MIT
"""tools/contact_sheet: every scene on one picture, failures by name."""
import os
import shutil
import subprocess

from program import SCENES, SOURCE, ProgramTest, main, metamarch


class ContactSheetTest(ProgramTest):
    def sheet(self, *words):
        return subprocess.run([SOURCE / "tools/contact_sheet", "--program", metamarch(), *words], cwd=self.tmp,
                              capture_output=True, text=True, timeout=300, check=False,
                              env={**os.environ, **self.environment})

    def scenes(self):
        folder = self.tmp / "scenes"
        (folder / "below").mkdir(parents=True)
        shutil.copy(SCENES / "cornell.glb", folder / "a#1 {wide}.GLB")
        shutil.copy(SCENES / "objects.glb", folder / "below")
        (folder / "note.txt").write_text("no scene")
        return folder

    def test_every_scene_has_its_place(self):
        result = self.sheet(self.scenes(), "all.png", "--size", "48x36", "--columns", "1")
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "all.png: 2 scenes, 0 failed\n", ""))
        picture = self.read_picture("all.png")
        self.assertEqual((len(picture["R"]), len(picture["R"][0])), (2 * (36 + 18) + 4, 48))
        # Each picture and each label must contain something other than the background.
        for top, bottom in ((0, 36), (36, 54), (58, 94), (94, 112)):
            self.assertGreater(len({value for row in picture["R"][top:bottom] for value in row}), 3, top)
        self.assertEqual(sorted(path.name for path in self.tmp.iterdir()), ["all.png", "scenes"])

    def test_failures_are_named(self):
        folder = self.scenes()
        (folder / "bad.ply").write_text("ply\nnot at all\n")
        result = self.sheet(folder, "all.png", "--size", "16x12", "--columns", "9")
        self.assertEqual(result.returncode, 1, result.stderr)
        lines = result.stdout.splitlines()
        self.assertRegex(lines[0], r"\Abad.ply: exit code 3: .*bad.ply: ")
        self.assertEqual(lines[1:], ["all.png: 3 scenes, 1 failed"])
        self.assertEqual(len(self.read_picture("all.png")["R"][0]), 3 * 16 + 2 * 4)

    def test_passes_arguments_on(self):
        result = self.sheet(self.scenes(), "all.png", "--size", "16x12", "--", "--traversal", "none")
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertEqual(result.stdout.count("--traversal"), 2, result.stdout)

    def test_refuses(self):
        (self.tmp / "empty").mkdir()
        for words, part in ((("none", "all.png"), "none is no folder"), (("empty", "all.png"), "no file ends in"),
                            (("empty", "all.jpg"), "written as .png"), (("empty", "no/all.png"), "no is no folder"),
                            (("empty", "all.png", "--size", "0x9"), "give WIDTHxHEIGHT")):
            result = self.sheet(*words)
            self.assertNotEqual(result.returncode, 0)
            self.assertIn(part, result.stderr.splitlines()[-1])


if __name__ == "__main__":
    main()

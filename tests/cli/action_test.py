# SPDX-License-Identifier: MIT
"""Runs the script of the action .github/actions/compare, and reads what the action says of it."""
import os
import re
import subprocess

from program import SCENES, SOURCE, ProgramTest, main, metamarch

ACTION = SOURCE / ".github" / "actions" / "compare"
OPTIONS = ("--size", "8x8", "--spp", "1")


class ActionTest(ProgramTest):
    def compare(self, golden, *options):
        return subprocess.run([ACTION / "compare", SCENES / "cornell.glb", golden, "pictures", *options], cwd=self.tmp,
                              env={**os.environ, **self.environment, "METAMARCH": str(metamarch()),
                                   "METAMARCH_VALIDATION": "0"}, capture_output=True, text=True, check=False)

    def pictures(self):
        return sorted(file.name for file in (self.tmp / "pictures").iterdir())

    def test_equal_pictures(self):
        self.succeed("render", SCENES / "cornell.glb", "-o", "golden.exr", "--quiet", *OPTIONS)
        done = self.compare("golden.exr", *OPTIONS)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(self.pictures(), ["cpu.exr", "gpu.exr"])

    def test_a_difference_is_shown(self):
        self.succeed("render", SCENES / "cornell.glb", "-o", "golden.exr", "--quiet", *OPTIONS, "--seed", "1")
        done = self.compare("golden.exr", *OPTIONS)
        self.assertEqual(done.returncode, 1)
        self.assertEqual(len(re.findall("differ: .* of 64 pixels", done.stderr)), 2)
        self.assertEqual(self.pictures(), ["cpu.exr", "difference-cpu.exr", "difference-gpu.exr", "gpu.exr"])
        difference = self.read_picture("pictures/difference-gpu.exr", {"R"})["R"]
        one, golden = (self.read_picture(name, {"R"})["R"] for name in ("pictures/gpu.exr", "golden.exr"))
        self.assertAlmostEqual(difference[3][4], abs(one[3][4] - golden[3][4]), 6)

    def test_a_missing_golden_picture_is_no_difference(self):
        done = self.compare("none.exr", *OPTIONS)
        self.assertEqual(done.returncode, 3)
        self.assertIn("none.exr", done.stderr)

    def test_the_action_runs_what_exists(self):
        text = (ACTION / "action.yml").read_text()
        tools = re.findall(r"outputs\.root \}\}/(tools/\w+)", text)
        self.assertEqual(tools, ["tools/setup", "tools/build"])
        for path in tools:
            self.assertTrue(os.access(ACTION / "../../.." / path, os.X_OK), path)
        # In a container these are paths of the host.
        self.assertNotRegex(text, r"\{\{ *(github\.action_path|runner\.temp)")
        self.assertIn('"$GITHUB_ACTION_PATH/compare" "$SCENE" "$GOLDEN"', text)


if __name__ == "__main__":
    main()

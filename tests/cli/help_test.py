# SPDX-License-Identifier: MIT
"""Tests every sub-command's --help, and that its example works as typed after tools/demo."""
import re
import shlex
import subprocess

from program import SCENES, ProgramTest, main, metamarch


class HelpTest(ProgramTest):
    def sub_commands(self):
        listing = self.succeed("--help").split("Subcommands:")[1].split("Exit codes:")[0]
        return re.findall(r"^  (\w+) ", listing, re.MULTILINE)

    def make_tree(self):
        """Makes those parts of the repository after tools/demo that the examples use."""
        (self.tmp / "build" / "demo").mkdir(parents=True)
        (self.tmp / "build" / "metamarch").symlink_to(metamarch())
        (self.tmp / "scenes").symlink_to(SCENES)
        self.succeed("render", "scenes/objects.glb", "-o", "build/demo/objects.exr", "--size", "64x36")
        for name, samples in (("a", "0:2"), ("b", "2:3")):
            self.succeed("render", "scenes/cornell.glb", "-o", f"build/{name}.part", "--size", "8x8", "--samples", samples,
                         "--backend", "cpu")

    def test_every_help_ends_with_an_example_that_works(self):
        self.make_tree()
        commands = self.sub_commands()
        self.assertLessEqual({"render", "info", "compare", "devices"}, set(commands))
        for command in ["", *commands]:
            with self.subTest(command=command):
                text = self.succeed(*command.split(), "--help")
                self.assertRegex(text, rf"(?s)Example:\n(  build/metamarch {command}[^\n]*\n)+\Z")
                if command == "view":
                    continue  # it opens a window, which tests/viewer does
                for example in text.split("Example:\n")[1].splitlines():
                    self.succeed(*shlex.split(example)[1:])

    def test_the_scenes_are_as_they_were(self):
        """The scenes must not change: an example could write to them through the link."""
        subprocess.run([SCENES.parent / "tools" / "make_scenes", "--check"], check=True)


if __name__ == "__main__":
    main()

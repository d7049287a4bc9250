# SPDX-License-Identifier: MIT
"""Tests the manual page and the completion of bash, which the build writes beside the program."""
import re
import shutil
import subprocess
import unittest

from program import ProgramTest, main, metamarch


class DocumentsTest(ProgramTest):
    def complete(self, *words):
        """Returns what bash offers for the last of the words."""
        script = ('source "$0"; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _metamarch; '
                  'for word in "${COMPREPLY[@]}"; do echo "$word"; done')
        done = subprocess.run(["bash", "-c", script, metamarch().with_name("metamarch.bash"), "metamarch", *words],
                              capture_output=True, text=True, check=True)
        self.assertEqual(done.stderr, "")
        return done.stdout.split()

    def options(self, *command):
        return set(re.findall(r"^  (?:-\w,)?(--[a-z][a-z-]+)", self.succeed(*command, "--help"), re.MULTILINE))

    def test_completion(self):
        self.assertEqual(self.complete("ren"), ["render"])
        self.assertEqual(self.complete("--v"), ["--version"])
        self.assertEqual(self.complete("render", "--integ"), ["--integrator"])
        self.assertEqual(self.complete("render", "a.glb", "--integrator", ""), ["path", "direct", "ao", "primary"])
        self.assertEqual(self.complete("render", "-o", "a.exr", "--backend", "c"), ["cpu"])
        self.assertEqual(self.complete("bench", "tr"), ["traversal"])
        self.assertEqual(self.complete("bench", "paper", "--ou"), ["--out"])
        for files in (["render", ""], ["render", "a.glb", "-o", ""], ["compare", "--json", "a"]):
            self.assertEqual(self.complete(*files), [], files)  # bash offers files then

    def test_completion_has_every_option(self):
        for command in (["render"], ["info"], ["compare"], ["merge"], ["bench", "traversal"]):
            self.assertEqual(set(self.complete(*command, "--")), self.options(*command), command)

    def test_manual_page(self):
        if not shutil.which("groff"):
            raise unittest.SkipTest("groff is absent")
        page = metamarch().with_name("metamarch.1")
        done = subprocess.run(["groff", "-man", "-Tascii", "-ww", page], capture_output=True, text=True, check=True)
        self.assertEqual(done.stderr, "")
        text = re.sub(r".\x08|\x1b\[[0-9;]*m", "", done.stdout)  # bold letters
        words = set(re.findall(r"--[a-z][a-z-]+", text))
        for command in (["render"], ["info"], ["compare"], ["merge"], ["bench", "traversal"]):
            self.assertLessEqual(self.options(*command), words | {"--help"}, command)


if __name__ == "__main__":
    main()

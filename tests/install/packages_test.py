# SPDX-License-Identifier: MIT
"""packages_test.py BUILD FOLDER: makes the Debian packages of a build in FOLDER, unpacks them there, and uses them."""

import os
import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

BUILD, FOLDER = Path(sys.argv[1]), Path(sys.argv[2])


def run(*words, **options):
    return subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False, **options)


def depends(package):
    """Returns the names of the packages that a package depends on."""
    line = run("dpkg-deb", "--field", *FOLDER.glob(f"{package}_*.deb"), "Depends").stdout
    return set(re.findall(r"(?:^|, )([a-z0-9.+-]+)", line))


class PackagesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(FOLDER, ignore_errors=True)
        FOLDER.mkdir(parents=True)
        made = run("cpack", "--config", BUILD / "CPackConfig.cmake", "-B", FOLDER, cwd=BUILD)
        assert made.returncode == 0, made.stdout + made.stderr

    def unpack(self, *packages):
        root = FOLDER / "_".join(packages)
        for package in packages:
            done = run("dpkg-deb", "--extract", *FOLDER.glob(f"{package}_*.deb"), root)
            self.assertEqual(done.returncode, 0, done.stderr)
        return root / "usr"

    def test_only_the_viewer_needs_windows(self):
        self.assertIn("libglfw3", depends("metamarch-viewer"))
        self.assertIn("metamarch", depends("metamarch-viewer"))
        for package in ("metamarch", "metamarch-dev"):
            self.assertNotIn("libglfw3", depends(package))
            self.assertNotIn("metamarch-viewer", depends(package))

    def test_the_program_runs_and_names_the_package_of_the_viewer(self):
        program = self.unpack("metamarch") / "bin/metamarch"
        version = run(program, "--version").stdout
        self.assertIn("metamarch", version)
        self.assertEqual(version, run(BUILD / "metamarch", "--version").stdout, "the package holds an old program")
        asked = run(program, "view")
        self.assertEqual(asked.returncode, 4)
        self.assertIn("install the package metamarch-viewer", asked.stderr)

    def test_the_program_becomes_the_viewer(self):
        """The viewer alone looks for the folder of --shaders, and it does so before it opens a window."""
        usr = self.unpack("metamarch", "metamarch-viewer")
        for words in (("--shaders", "no where"), ("--shaders", "*")):
            asked = run(usr / "bin/metamarch", "view", *words, env={**os.environ, "DISPLAY": "", "WAYLAND_DISPLAY": ""})
            self.assertEqual((asked.returncode, asked.stderr), (2, f"metamarch: --shaders {words[1]}: there is no such folder\n"))

    def test_the_libraries_need_what_their_package_file_looks_for(self):
        needed = depends("metamarch-dev")
        self.assertLessEqual({"libglm-dev", "libtbb-dev", "libfmt-dev", "libvulkan-dev", "libopenimageio-dev"}, needed)
        known = run("dpkg-query", "--show", "--showformat", "${Package}\n", *needed)
        self.assertEqual(known.returncode, 0, known.stderr)
        self.assertTrue((self.unpack("metamarch-dev") / "lib/cmake/metamarch/metamarch-config.cmake").is_file())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])

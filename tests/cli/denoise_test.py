# SPDX-License-Identifier: MIT
"""`render --denoise`: with a library that stands in for Open Image Denoise, and with the real one where it is installed."""
import ctypes
import os
import struct
import subprocess
import unittest

from program import SCENES, ProgramTest, main, metamarch

CORNELL = SCENES / "cornell.glb"
SMALL = ("--size", "16x12", "--spp", "2", "--backend", "cpu", "--quiet")
LIGHT = ("--aov", "direct,indirect,albedo")


def is_installed():
    try:
        ctypes.CDLL("libOpenImageDenoise.so.2")
    except OSError:
        return False
    return True


def half(value):
    """The value as a 16-bit float."""
    return struct.unpack("<e", struct.pack("<e", value))[0]


class DenoiseTest(ProgramTest):
    def render(self, *words, library=None):
        """Starts the program itself, because the linker looks for libraries where the environment says at the start."""
        environment = {**os.environ, **self.environment}
        if library:
            environment["LD_LIBRARY_PATH"] = library
        return subprocess.run([str(word) for word in (metamarch(), "render", CORNELL, *words)], cwd=self.tmp, env=environment,
                              capture_output=True, text=True, timeout=60, check=False)

    def stand_in(self, *words):
        done = self.render(*words, library=os.environ["METAMARCH_FAKE_DENOISER"])
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_what_is_denoised_and_what_stays(self):
        self.succeed("render", CORNELL, "-o", "plain.exr", *SMALL, *LIGHT)
        self.stand_in("-o", "clean.exr", *SMALL, *LIGHT, "--denoise", "--half")
        plain, clean = self.read_picture("plain.exr"), self.read_picture("clean.exr")
        for layer in ("", "direct.", "indirect."):
            for channel in "RGB":
                name = layer + channel
                values = [value for row in plain[name] for value in row]
                self.assertEqual([half(value) for value in values],
                                 [value for row in clean["noisy." + name] for value in row], name)
                mean = half(sum(values) / len(values))
                for row in clean[name]:
                    for value in row:
                        self.assertAlmostEqual(value, mean, delta=mean / 1000, msg=name)
        self.assertEqual(set(clean) - set(plain), {f"noisy.{layer}{c}" for layer in ("", "direct.", "indirect.") for c in "RGB"})
        for name in ("A", "albedo.R"):
            self.assertEqual([[half(value) for value in row] for row in plain[name]], clean[name])

    def test_other_channels_and_files(self):
        self.stand_in("-o", "a.exr", *SMALL, "--denoise")
        self.assertIn("noisy.R", self.read_picture("a.exr"))
        self.assertNotIn("noisy.direct.R", self.read_picture("a.exr"))
        header = self.header("a.exr")
        self.assertEqual(header["metamarch/denoiser"], "Open Image Denoise 2.17.3")
        self.assertIn("--denoise", header["metamarch/options"])
        self.stand_in("-o", "a.png", *SMALL, "--denoise")
        first = {tuple(self.read_picture("a.png")[c][y][x] for c in "RGB") for y in range(12) for x in range(16)}
        self.assertEqual(len(first), 1)

    def header(self, name):
        import OpenImageIO

        file = OpenImageIO.ImageInput.open(str(self.tmp / name))
        return {attribute.name: attribute.value for attribute in file.spec().extra_attribs}

    def test_a_failure_keeps_the_picture(self):
        self.succeed("render", CORNELL, "-o", "plain.png", *SMALL)
        self.environment["METAMARCH_FAKE_FAULT"] = "1"
        done = self.render("-o", "a.png", *SMALL, "--denoise", library=os.environ["METAMARCH_FAKE_DENOISER"])
        self.assertEqual((done.returncode, done.stderr.count("\n")), (0, 1), done.stderr)
        self.assertIn("keeps its noise", done.stderr)
        self.assertEqual((self.tmp / "a.png").read_bytes(), (self.tmp / "plain.png").read_bytes())

    def test_refusals(self):
        for words, text in ((("-o", "a.part"), "a .part holds sums"), (("-o", "a.exr", "--integrator", "primary"), "no noise")):
            done = self.run_program("render", CORNELL, *SMALL[:2], "--backend", "cpu", *words, "--denoise")
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
            self.assertIn(text, done.stderr)
            self.assertIn("--denoise", done.stderr)
        done = self.run_program("render", CORNELL, *SMALL, "-o", "a.exr", "--aov", "noisy")
        self.assertEqual(done.returncode, 2)

    @unittest.skipIf(is_installed(), "Open Image Denoise is installed")
    def test_absent_library(self):
        done = self.render("-o", "a.exr", *SMALL, "--denoise")
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
        self.assertIn("tools/setup --denoise", done.stderr)
        self.assertFalse((self.tmp / "a.exr").exists())

    @unittest.skipUnless(is_installed(), "Open Image Denoise is not installed: tools/setup --denoise")
    def test_less_noise(self):
        size = ("--size", "64x64", "--backend", "cpu", "--quiet")
        self.succeed("render", CORNELL, "-o", "truth.exr", *size, "--spp", "256")
        self.assertEqual(self.render("-o", "clean.exr", *size, "--spp", "4", "--seed", "1", "--denoise").returncode, 0)
        truth, clean = self.read_picture("truth.exr"), self.read_picture("clean.exr")

        def error(layer):
            """Relative to the light, so that the lamp does not outweigh the room."""
            return sum((clean[layer + c][y][x] - truth[c][y][x]) ** 2 / (truth[c][y][x] ** 2 + 0.01)
                       for c in "RGB" for y in range(64) for x in range(64))

        self.assertLess(error(""), 0.25 * error("noisy."))


if __name__ == "__main__":
    main()

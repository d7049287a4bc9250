# SPDX-License-Identifier: MIT
"""The switch of the panel that removes noise, with a library that stands in for Open Image Denoise and makes a picture its mean."""
import ctypes
import os
import unittest

from panel import BAR, CONTROL, MIDDLE
from viewer import CORNELL, ViewerTest, main

SWITCH = (20, 9 + 2 * BAR + 4 * CONTROL + MIDDLE)  # below view, samples, traversal and split
SIZE = "460x400"


def is_installed():
    try:
        ctypes.CDLL("libOpenImageDenoise.so.2")
    except OSError:
        return False
    return True


def colors(picture):
    return {picture[2][i:i + 3] for i in range(0, len(picture[2]), 3)}


class DenoiserTest(ViewerTest):
    def toggle(self, viewer):
        viewer.click(*SWITCH)
        viewer.settle()

    def test_the_switch(self):
        stand_in = {"LD_LIBRARY_PATH": os.environ["METAMARCH_FAKE_DENOISER"]}
        viewer = self.open(CORNELL, "--spp", "3", size=SIZE, panels=True, environment=stand_in)
        viewer.wait_for_samples()
        self.toggle(viewer)
        viewer.key("Tab")
        viewer.wait_until("a picture of one colour", lambda: len(colors(viewer.screenshot())) == 1)
        shown = viewer.screenshot()
        viewer.key("p")
        self.assertEqual(self.pixels(viewer.wait_for_line(r"saved (.*), 3 samples a pixel")[1]), shown)
        viewer.key("Home")  # another picture is denoised too
        viewer.wait_for_samples()
        viewer.wait_until("its one colour", lambda: len(colors(viewer.screenshot())) == 1)
        options = viewer.camera_options()
        viewer.key("Tab")
        viewer.settle()
        self.toggle(viewer)
        viewer.key("Tab")
        self.assert_shows(viewer, self.render(CORNELL, "--spp", "3", *options, size=SIZE))
        self.quit(viewer)

    @unittest.skipIf(is_installed(), "Open Image Denoise is installed")
    def test_says_what_is_missing(self):
        viewer = self.open(CORNELL, "--spp", "3", size=SIZE, panels=True)
        viewer.wait_for_samples()
        before = len(viewer.stdout())
        self.toggle(viewer)
        viewer.read = before  # toggle() reads on
        viewer.wait_for_line(r".*Open Image Denoise.*tools/setup --denoise.*")
        viewer.key("Tab")
        self.assert_shows(viewer, self.render(CORNELL, "--spp", "3", size=SIZE))
        self.quit(viewer)


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: MIT
"""Uses the viewer for METAMARCH_SOAK_SECONDS, 15 by default. Its memory must not grow."""
import os
import random
import re
import shutil
import sys
import time
from pathlib import Path

from animated_scene import animated
from panel import BAR, CONTROL, MIDDLE, PanelTest
from viewer import CORNELL, OBJECTS, READY, main

SECONDS = float(os.environ.get("METAMARCH_SOAK_SECONDS", "15"))
# All traversals together take minutes. The memory of compilers grows until each has been compiled once.
EVERY_TRAVERSAL = SECONDS >= 300
WARM_ROUNDS = 12 if EVERY_TRAVERSAL else 1
# The heaps of the driver and its compiler vary by some MiB. A leak in each frame is far larger.
MOST_GROWTH = 24  # MiB
DENOISE = (20, 9 + 2 * BAR + 4 * CONTROL + MIDDLE)  # the switch of the panel
POSES = 5  # different pictures that are waited for between two looks at the memory


def resident(process):
    status = Path(f"/proc/{process.pid}/status").read_text()
    return int(re.search(r"VmRSS:\s+(\d+) kB", status)[1]) / 1024


class SoakTest(PanelTest):
    def round(self, viewer, scene):
        """Does everything that creates and destroys objects on the device, and returns to the first state."""
        dice = random.Random(1)
        for keys in ((), ("h", ), ("h", )):
            viewer.key(*keys)
            for _ in range(3):
                start = dice.randrange(20, 140), dice.randrange(20, 100)
                viewer.drag(start, (start[0] + dice.randrange(-20, 20), start[1] + dice.randrange(-15, 15)))
                viewer.settle()
        for key in ("Tab", "Tab", "x", "x", *(["t"] if EVERY_TRAVERSAL else [])):
            viewer.key(key)
            viewer.wait_for_samples()  # each round compiles the same kernels, also on a busy machine
        for _ in range(2):
            viewer.resize(dice.randrange(100, 200), dice.randrange(100, 150))
            viewer.settle()
        viewer.resize(160, 120)
        for source in (OBJECTS, CORNELL):
            shutil.copyfile(source, scene)
            viewer.key("r")
            viewer.settle()
            viewer.wait_for_title(READY)
        viewer.key("Home")
        viewer.wait_for_samples()

    def expect_flat(self, sizes, warm):
        curve = ", ".join(f"{size:.1f}" for size in sizes[::max(1, len(sizes) // 20)])
        print(f"{len(sizes)} rounds; resident MiB: {sizes[warm]:.1f} after {warm + 1}, {sizes[-1]:.1f} at the end; {curve}",
              file=sys.stderr)
        self.assertLess(sizes[-1] - sizes[warm], MOST_GROWTH)

    def setUp(self):
        super().setUp()
        # The validation layers keep a MiB of each destroyed pipeline.
        self.environment["METAMARCH_VALIDATION"] = "0"
        # AddressSanitizer, if the program is built with it, keeps freed memory; keep that small.
        self.environment["ASAN_OPTIONS"] = os.environ.get("ASAN_OPTIONS", "") + ":quarantine_size_mb=1"

    def test_memory_stays_flat(self):
        # glibc gives threads that collide an arena each and never shrinks it: steps of 50 MiB that are no leak.
        self.environment["MALLOC_ARENA_MAX"] = "1"
        scene = self.tmp / "scene.glb"
        shutil.copyfile(CORNELL, scene)
        viewer = self.open(scene, "--spp", "2")
        end = time.monotonic() + SECONDS
        sizes = []
        while len(sizes) < WARM_ROUNDS + 3 or time.monotonic() < end:
            self.round(viewer, scene)
            sizes.append(resident(viewer.process))
        self.quit(viewer)
        self.expect_flat(sizes, WARM_ROUNDS)

    def play(self, viewer):
        """Waits for some poses of the animation."""
        for _ in range(POSES):
            viewer.wait_for_other_than(viewer.screenshot())

    def test_animation_and_denoiser(self):
        viewer = self.open_playing()
        end = time.monotonic() + SECONDS
        sizes = []
        while len(sizes) < 8 or time.monotonic() < end:
            self.play(viewer)
            sizes.append(resident(viewer.process))
        self.quit(viewer)
        self.expect_flat(sizes, len(sizes) // 4)

    def test_animation_and_denoiser_with_validation(self):
        """A message of the validation layers would be on stderr."""
        self.environment["METAMARCH_VALIDATION"] = "1"
        viewer = self.open_playing()
        self.play(viewer)
        self.quit(viewer)

    def open_playing(self):
        """Opens a window that plays an animation, with a library that stands in for Open Image Denoise."""
        scene = self.tmp / "animated.gltf"
        animated(scene)
        stand_in = {"LD_LIBRARY_PATH": os.environ["METAMARCH_FAKE_DENOISER"]}
        viewer = self.open(scene, "--spp", "64", "--sky", size="460x400", panels=True, environment=stand_in)
        viewer.wait_for_samples()
        self.click(viewer, *DENOISE)
        viewer.key("Tab")
        viewer.wait_for_still()
        viewer.key("space")
        return viewer


if __name__ == "__main__":
    main()

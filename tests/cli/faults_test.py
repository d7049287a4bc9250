# SPDX-License-Identifier: MIT
"""Devices that are worse than lavapipe, by the layer tests/vulkan/fault_layer: a command works, or one line says why not."""
import os
import subprocess

from program import SCENES, ProgramTest, main, metamarch

CORNELL = SCENES / "cornell.glb"
SMALL = ("--size", "16x8", "--spp", "2", "--quiet")
NO_DEVICE, TOO_LARGE = 4, 6  # exit codes


class FaultsTest(ProgramTest):
    def run_with(self, faults, *words):
        """Starts the program itself: the loader reads the environment when it loads layers."""
        environment = {**os.environ, **self.environment, "METAMARCH_FAULTS": faults,
                       "VK_INSTANCE_LAYERS": "VK_LAYER_METAMARCH_faults", "VK_ADD_LAYER_PATH": os.environ["METAMARCH_FAULT_LAYER"]}
        return subprocess.run([str(word) for word in (metamarch(), *words)], cwd=self.tmp, env=environment,
                              capture_output=True, text=True, timeout=120, check=False)

    def render(self, faults, name, *words):
        return self.run_with(faults, "render", CORNELL, "-o", name, *SMALL, *words)

    def plain(self):
        self.succeed("render", CORNELL, "-o", "plain.exr", *SMALL)
        return (self.tmp / "plain.exr").read_bytes()

    def test_clocks_that_say_nothing(self):
        plain = self.plain()
        for faults in ("timestampBits=0", "stampsAreEqual=1", "timestampBits=36,stampsWrap=1", "timestampBits=64"):
            with self.subTest(faults=faults):
                done = self.render(faults, "a.exr")
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                self.assertEqual((self.tmp / "a.exr").read_bytes(), plain)

    def test_limits(self):
        """Either the picture of a better device, or one line with the limit's name."""
        plain = self.plain()
        for faults, limit in (("storageBuffers=8", "maxPerStageDescriptorStorageBuffers"),
                              ("storageBuffers=31", "maxPerStageDescriptorStorageBuffers"),
                              ("sampledImages=16", "maxPerStageDescriptorSampledImages"),
                              ("storageRange=134217728", "maxStorageBufferRange"), ("texels=65536", "maxTexelBufferElements"),
                              ("storageRange=4096", "maxStorageBufferRange"), ("texels=16", "maxTexelBufferElements"),
                              ("workGroups=1", "maxComputeWorkGroupCount"), ("allocation=4096", "maxMemoryAllocationSize")):
            with self.subTest(faults=faults):
                done = self.render(faults, "a.exr")
                if done.returncode == 0:
                    self.assertEqual((self.tmp / "a.exr").read_bytes(), plain)
                else:
                    self.assertIn(done.returncode, (NO_DEVICE, TOO_LARGE), done.stderr)
                    self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
                    self.assertIn(limit, done.stderr)
                (self.tmp / "a.exr").unlink(missing_ok=True)

    def test_a_lost_device(self):
        """What was finished is written; the line says that the device was lost."""
        for at in (1, 4, 9):
            with self.subTest(at=at):
                done = self.render(f"lostAt={at}", "a.exr", "--write-every", "0.001")
                self.assertEqual((done.returncode, done.stderr.count("\n")), (NO_DEVICE, 1), done.stderr)
                self.assertRegex(done.stderr, "lost|Lost|LOST")
                if (self.tmp / "a.exr").exists():
                    self.succeed("compare", "a.exr", "a.exr")

    def test_memory_that_runs_out(self):
        for at in (1, 6, 30):
            with self.subTest(at=at):
                done = self.render(f"memoryEndsAt={at}", "a.exr")
                if done.returncode != 0:
                    self.assertEqual((done.returncode, done.stderr.count("\n")), (TOO_LARGE, 1), done.stderr)
                    self.assertIn("memory", done.stderr)


if __name__ == "__main__":
    main()

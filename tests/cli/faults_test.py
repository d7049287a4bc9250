# SPDX-License-Identifier: MIT
"""Devices that are worse than lavapipe, by the layer tests/vulkan/fault_layer: a command works, or one line says why not."""
import os
import re
import subprocess

from program import SCENES, ProgramTest, main, metamarch, skip_over_least_texels

CORNELL = SCENES / "cornell.glb"
SMALL = ("--size", "16x8", "--quiet")
SAMPLES = ("--spp", "2")
NO_DEVICE, TOO_LARGE = 4, 6  # exit codes


class FaultsTest(ProgramTest):
    def run_with(self, faults, *words):
        """Starts the program itself: the loader reads the environment when it loads layers."""
        environment = {**os.environ, **self.environment, "METAMARCH_FAULTS": faults,
                       "VK_INSTANCE_LAYERS": "VK_LAYER_METAMARCH_faults", "VK_ADD_LAYER_PATH": os.environ["METAMARCH_FAULT_LAYER"]}
        return subprocess.run([str(word) for word in (metamarch(), *words)], cwd=self.tmp, env=environment,
                              capture_output=True, text=True, timeout=120, check=False)

    def render(self, faults, name, *words):
        return self.run_with(faults, "render", CORNELL, "-o", name, *SMALL, *(words or SAMPLES))

    def options_of(self, name):
        import OpenImageIO
        return OpenImageIO.ImageInput.open(str(self.tmp / name)).spec().getattribute("metamarch/options")

    def plain(self):
        self.succeed("render", CORNELL, "-o", "plain.exr", *SMALL, *SAMPLES)
        return (self.tmp / "plain.exr").read_bytes()

    def test_clocks_that_say_nothing(self):
        plain = self.plain()
        for faults in ("timestampBits=0", "stampsAreEqual=1", "timestampBits=36,stampsWrap=1", "timestampBits=64"):
            with self.subTest(faults=faults):
                done = self.render(faults, "a.exr")
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                self.assertEqual((self.tmp / "a.exr").read_bytes(), plain)

    def test_limits(self):
        """The picture of a better device, or one line with the limit's name. lavapipe reads texel buffers."""
        plain = self.plain()
        for faults in ("storageBuffers=8", "storageBuffers=24", "storageBuffers=31", "storageRange=134217728", "texels=65536", "workGroups=1"):
            with self.subTest(faults=faults):
                done = self.render(faults, "a.exr")
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                self.assertEqual((self.tmp / "a.exr").read_bytes(), plain)
                (self.tmp / "a.exr").unlink()
        for faults, code, limit in (("sampledImages=16", NO_DEVICE, "maxPerStageDescriptorSampledImages 16"),
                                    ("storageRange=4096", TOO_LARGE, "maxStorageBufferRange, 4.0 KiB; the backend cpu has no such limit (--backend)\n"),
                                    ("texels=16", TOO_LARGE, "maxTexelBufferElements, 16; the backend cpu has no such limit (--backend)\n"),
                                    ("allocation=4096", TOO_LARGE, "maxMemoryAllocationSize")):
            with self.subTest(faults=faults):
                done = self.render(faults, "a.exr")
                self.assertEqual((done.returncode, done.stderr.count("\n")), (code, 1), done.stderr)
                self.assertIn(limit, done.stderr)
                self.assertFalse((self.tmp / "a.exr").exists())

    def test_more_rays_than_a_buffer_has_texels(self):
        done = self.run_with("texels=65536", "bench", "traversal", CORNELL, "--traversals", "meta_table", "--size", "160x120",
                             "--rays", "far", "--repeat", "1", "--seconds", "0")  # 76,800 rays of two texels
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_a_driver_that_gets_kernels_without_else(self):
        """The kernels that SwiftShader gets compute the same."""
        plain = self.plain()
        done = self.render("driver=10", "a.exr")  # VK_DRIVER_ID_GOOGLE_SWIFTSHADER
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual((self.tmp / "a.exr").read_bytes(), plain)

    def test_a_lost_device(self):
        """Before the first result there is no picture; after it, what was finished is written, and the header says how much."""
        # With the fault deviceHeap the host does not see the device's memory, so each upload is a submission.
        for faults, samples, is_written in (("lostAt=1", 2, False), ("lostAt=9,deviceHeap=1073741824", 2, False),
                                            ("lostAt=90", 4096, True)):
            with self.subTest(faults=faults):
                done = self.render(faults, "a.exr", "--spp", str(samples), "--write-every", "0.001",
                                   "--aov", "samples")
                self.assertEqual((done.returncode, done.stderr.count("\n")), (NO_DEVICE, 1), done.stderr)
                self.assertIn("DeviceLost", done.stderr)
                self.assertEqual((self.tmp / "a.exr").exists(), is_written)
                if is_written:
                    claimed = re.search(r"--spp (\d+)", self.options_of("a.exr"))
                    self.assertEqual(min(min(row) for row in self.read_picture("a.exr")["samples"]), int(claimed[1]) if claimed else 64)

    def test_a_slow_device_with_a_watchdog(self):
        """No submission takes 2 s, which loses the device, where the 96 tiles together take 2.4 s.

        A device that needs 3 s for the smallest work is lost. One line says so."""
        large = ("render", CORNELL, "--quiet", "--size", "96x64", *SAMPLES, "-o")
        self.succeed(*large, "plain.exr")
        done = self.run_with("groupMicroseconds=25000", *large, "a.exr")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual((self.tmp / "a.exr").read_bytes(), (self.tmp / "plain.exr").read_bytes())
        done = self.render("groupMicroseconds=3000000", "b.exr")
        self.assertEqual((done.returncode, done.stderr.count("\n")), (NO_DEVICE, 1), done.stderr)
        self.assertIn("DeviceLost", done.stderr)

    def test_memory_that_runs_out(self):
        for faults in ("memoryEndsAt=1", "memoryEndsAt=6", "memoryEndsAt=25", "memoryEndsAt=30,deviceHeap=1073741824"):
            with self.subTest(faults=faults):
                done = self.render(faults, "a.exr")
                self.assertEqual((done.returncode, done.stderr.count("\n")), (TOO_LARGE, 1), done.stderr)
                self.assertIn("does not fit into device memory", done.stderr)

    def test_memory_that_is_short(self):
        """The film shrinks to bands before it leaves the device. What finds no place there lies in host memory, and one line says so."""
        large = ("render", CORNELL, "--quiet", "--size", "160x160", *SAMPLES, "-o")  # a film of twice 2.9 MB
        self.succeed(*large, "plain.exr")
        plain = (self.tmp / "plain.exr").read_bytes()
        for faults, is_spilled in (("deviceHeap=4194304", False), ("fragmentedAbove=2500000", False),
                                   ("deviceHeap=65536", True)):
            with self.subTest(faults=faults):
                done = self.run_with(faults, *large, "a.exr")
                self.assertEqual((done.returncode, done.stderr.count("\n")), (0, int(is_spilled)), done.stderr)
                self.assertEqual("in host memory" in done.stderr, is_spilled, done.stderr)
                self.assertEqual((self.tmp / "a.exr").read_bytes(), plain)

    def test_division_that_is_off_by_2_ulp(self):
        """Every traversal's hits agree with the stack traversal's on the CPU, and the picture is another in its last bits alone."""
        for scene in ("objects.glb", "cornell.glb"):
            with self.subTest(scene=scene):
                done = self.run_with("roughDivision=1", "bench", "traversal", SCENES / scene, "--size", "64x48",
                                     "--repeat", "1", "--seconds", "0")
                skip_over_least_texels(done.stderr)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.plain()
        done = self.render("roughDivision=1", "rough.exr")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        plain, rough = self.read_picture("plain.exr"), self.read_picture("rough.exr")
        differences = [abs(a - b) for rows in zip(plain["R"], rough["R"]) for a, b in zip(*rows)]
        self.assertGreater(max(differences), 0.0)
        self.assertLess(sum(differences) / len(differences), 1e-4)

    def test_floats_that_are_rounded_to_zero(self):
        """With divisions off by 2 ulp besides, every traversal finds brute force's hits: all pictures are the same to the bit."""
        lists, lacking = self.bench_lists()
        words = ("--size", "32x24", *SAMPLES, "--quiet", "--traversal")
        both = "truncation=1,roughDivision=1"
        for scene in ("objects.glb", "cornell.glb"):
            with self.subTest(scene=scene):
                expected = self.radiance(both, scene, *words, "brute_force")
                for faults in ("", "truncation=1", "roughDivision=1"):
                    self.assertNotEqual(self.radiance(faults, scene, *words, "brute_force"), expected, "a fault does nothing")
                for name in lists["traversals"]:
                    if name not in lacking:
                        with self.subTest(scene=scene, traversal=name):
                            self.assertTrue(self.radiance(both, scene, *words, name) == expected)

    def radiance(self, faults, scene, *words):
        done = self.run_with(faults, "render", SCENES / scene, "-o", "a.exr", *words)
        skip_over_least_texels(done.stderr)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        picture = self.read_picture("a.exr")
        return [picture[channel] for channel in "RGB"]


if __name__ == "__main__":
    main()

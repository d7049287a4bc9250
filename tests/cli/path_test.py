# SPDX-License-Identifier: MIT
"""The pictures of the path tracer: channels, equality of both backends, light, statistics."""
import json

from program import SCENES, ProgramTest, channels_of, main, skip_over_least_texels

CORNELL = SCENES / "cornell.glb"
DEGENERATE = SCENES / "degenerate.glb"
OBJECTS = SCENES / "objects.glb"


def mean(picture, channel):
    values = sum(picture[channel], [])
    return sum(values) / len(values)


class PathTest(ProgramTest):
    def render(self, scene, *words, name="a.exr"):
        return self.succeed("render", scene, "-o", name, "--size", "32x24", *words)

    def picture(self, scene, *words):
        self.render(scene, *words)
        return self.read_picture("a.exr")

    def test_channels(self):
        picture = self.picture(CORNELL, "--spp", "2")
        self.assertEqual(set(picture), channels_of("path"))
        self.assertGreater(mean(picture, "R"), 0)

    def test_both_backends_draw_the_same_picture(self):
        for scene, *words in ((CORNELL, "--seed", "7", "--clamp", "1"), (CORNELL, "--integrator", "ao"),
                              (OBJECTS, "--brdf", "gltf"), (OBJECTS, "--integrator", "direct", "--background", "1,0.5,2"),
                              (OBJECTS, "--sun", "1,1,0.5")):
            with self.subTest(scene=scene.name, words=words):
                self.render(scene, "--spp", "5", "--quiet", *words, name="gpu.exr")
                self.render(scene, "--spp", "5", "--quiet", *words, "--backend", "cpu", name="cpu.exr")
                self.succeed("compare", "gpu.exr", "cpu.exr", "--max-abs", "0")

    def test_samples_are_a_function_of_the_seed(self):
        self.render(CORNELL, "--spp", "3", name="a.exr")
        self.render(CORNELL, "--spp", "3", name="b.exr")
        self.render(CORNELL, "--spp", "3", "--seed", "1", name="c.exr")
        self.succeed("compare", "a.exr", "b.exr", "--max-abs", "0")
        self.refuse(1, "compare", "a.exr", "c.exr", "--max-abs", "0")

    def test_every_traversal_draws_the_same_picture(self):
        lists, lacking = self.bench_lists()
        self.render(OBJECTS, "--spp", "2", "--backend", "cpu", name="cpu.exr")
        for traversal in lists["traversals"]:
            if traversal not in lacking:
                with self.subTest(traversal=traversal):
                    self.render(OBJECTS, "--spp", "2", "--traversal", traversal, name="gpu.exr")
                    self.succeed("compare", "gpu.exr", "cpu.exr", "--max-abs", "0")

    def test_occlusion_is_white_where_nothing_is_near(self):
        picture = self.picture(CORNELL, "--integrator", "ao", "--spp", "16")
        self.assertTrue(all(0 <= value <= 1.0001 for value in sum(picture["R"], [])))
        self.assertEqual(picture["R"], picture["G"])
        self.assertTrue(0.05 < mean(picture, "R") < 0.95)

    def test_direct_light_is_less_than_all(self):
        direct = self.picture(CORNELL, "--integrator", "direct", "--spp", "16")
        none = self.picture(CORNELL, "--max-bounces", "0", "--spp", "16")
        whole = self.picture(CORNELL, "--spp", "16")
        self.assertEqual(direct["R"], none["R"])
        self.assertLess(mean(direct, "R"), 0.9 * mean(whole, "R"))

    def test_light_scales_the_picture(self):
        """Powers of two multiply every sum exactly."""
        dim = self.picture(DEGENERATE, "--background", "0.5,0.5,0.5", "--spp", "4")
        bright = self.picture(DEGENERATE, "--background", "2,2,2", "--spp", "4")
        self.assertGreater(mean(dim, "G"), 0)
        for low, high in zip(sum(dim["G"], []), sum(bright["G"], [])):
            self.assertAlmostEqual(4 * low, high, places=7)  # what oiiotool prints of it

    def test_a_scene_without_light_gets_a_sky_and_says_so(self):
        result = self.run_program("render", DEGENERATE, "-o", "a.exr", "--size", "32x24", "--spp", "1", "--quiet")
        skip_over_least_texels(result.stderr)
        self.assertEqual((result.returncode, result.stdout), (0, ""))
        self.assertRegex(result.stderr, r"\Ametamarch: warning: .*: no light; a clear sky lights it\n\Z")
        self.render(DEGENERATE, "--spp", "1", "--sky", name="b.exr")
        self.succeed("compare", "a.exr", "b.exr", "--max-abs", "0")

    def test_a_png_shows_the_background(self):
        self.render(DEGENERATE, "--background", "1,1,1", "--tone-map", "none", "--spp", "1", name="a.png")
        picture = self.read_picture("a.png")
        self.assertEqual(set(picture), {"R", "G", "B"})
        self.assertEqual(picture["R"][0][0], 1.0)

    def test_statistics(self):
        self.render(CORNELL, "--spp", "4", "--stats", "s.json")
        stats = json.loads((self.tmp / "s.json").read_text())
        self.assertEqual((stats["integrator"], stats["samplesPerPixel"], stats["rejectedSamples"]), ("path", 4, 0))
        self.assertEqual(stats["options"], "--size 32x24 --spp 4")
        self.assertGreaterEqual(stats["rays"], 32 * 24 * 4)
        for key in ("msamplesPerSecond", "mraysPerSecond", "shadowRays"):
            self.assertGreater(stats[key], 0, key)


if __name__ == "__main__":
    main()

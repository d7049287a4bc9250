# SPDX-License-Identifier: MIT
"""Compares with pictures of other path tracers: ../shared/references, or the folder that METAMARCH_REFERENCES names.

Each case is rendered with few samples. Its mean must agree with that of the reference. The differences of pixels and of
means over small blocks must not exceed the noise of the picture (its variance channels) and of the reference.
"""
import json
import math
import sys

from program import ProgramTest, asset, main, skip_over_least_texels

SIDE = 256
SAMPLES = 16
READ = ("R", "G", "B", "variance.R", "variance.G", "variance.B")
BLOCK = 8  # pixels; the mean over a block of this side has 1 / BLOCK of the noise but all of a bias
TRIMMED = 0.005  # fraction of the worst pixels or blocks that the error leaves out: fireflies, edges of lights


def numbers(values):
    return ",".join(repr(float(value)) for value in values)


def flat(picture, channel):
    return sum(picture[channel], [])


def block_means(values):
    means = []
    for top in range(0, SIDE, BLOCK):
        for left in range(0, SIDE, BLOCK):
            rows = (values[y * SIDE + left:y * SIDE + left + BLOCK] for y in range(top, top + BLOCK))
            means.append(sum(map(sum, rows)) / BLOCK**2)
    return means


def trimmed_root(squares):
    """Returns the root of the mean of per-channel squares, without the worst places."""
    places = sorted(map(sum, zip(*squares)))
    kept = places[:int(len(places) * (1 - TRIMMED))]
    return math.sqrt(sum(kept) / (len(squares) * len(kept)))


class Comparison:
    """The means per channel, and the trimmed errors and the noise relative to the mean of the reference."""

    def __init__(self, ours, reference):
        def error_between(a, b):
            return trimmed_root([[(v - w) ** 2 for v, w in zip(x, y)] for x, y in zip(a, b)]) / mean

        a = [flat(ours, channel) for channel in "RGB"]
        b = [flat(reference, channel) for channel in "RGB"]
        mean = sum(map(sum, b)) / (3 * len(b[0]))
        self.ratios = [sum(x) / sum(y) for x, y in zip(a, b)]
        self.error = error_between(a, b)
        self.block_error = error_between(list(map(block_means, a)), list(map(block_means, b)))
        variance = [flat(ours, "variance." + channel) for channel in "RGB"]
        self.noise = trimmed_root(variance) / mean
        self.block_noise = trimmed_root(list(map(block_means, variance))) / BLOCK / mean


class ReferencesTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.folder = asset("METAMARCH_REFERENCES", "references", "")

    def render(self, name, *words):
        case = json.loads((self.folder / "cases" / f"{name}.json").read_text())
        camera = case["camera"]
        environment = case["environment"]
        light = (["--background=" + numbers(environment["color"])] if environment["type"] == "constant"
                 else ["--env", self.folder / environment["file"]])
        self.assertEqual((case["width"], case["height"], case["max_bounces"]), (SIDE, SIDE, 8))
        result = self.run_program("render", self.folder / case["scene"], "-o", "ours.exr", "--size", f"{SIDE}x{SIDE}",
                                  "--eye=" + numbers(camera["position"]), "--target=" + numbers(camera["target"]),
                                  "--vfov", str(camera["vfov_degrees"]), *light, "--spp", str(SAMPLES),
                                  "--max-bounces", "8", "--quiet", *words)
        skip_over_least_texels(result.stderr)
        self.assertEqual(result.returncode, 0, result.stderr)  # there may be warnings about the environment
        return self.read_picture("ours.exr", READ)

    def expect_same(self, picture, reference, mean_tolerance, model_error=0.0):
        """`model_error` is the difference of the two BRDFs as a fraction of the mean."""
        file = self.folder / "ref" / f"{reference}.exr"
        noise = json.loads(file.with_suffix(".json").read_text())["noise_rel_rmse_trim0p5"]
        compared = Comparison(picture, self.read_picture(file, READ))
        said = (f"{reference}: means {', '.join(f'{r:.4f}' for r in compared.ratios)}; error {compared.error:.4f}, "
                f"noise {compared.noise:.4f} and {noise:.4f}; of blocks {compared.block_error:.4f}, "
                f"{compared.block_noise:.4f} and {noise / BLOCK:.4f}")
        print(said, file=sys.stderr)
        for ratio in compared.ratios:
            self.assertLess(abs(ratio - 1), mean_tolerance, said)
        # Samples are stratified, so their variance is an upper bound of the error.
        self.assertLess(compared.error, math.hypot(compared.noise, noise, model_error), said)
        self.assertLess(compared.block_error, math.hypot(compared.block_noise, noise / BLOCK, model_error), said)

    def test_diffuse_scenes(self):
        for name in ("a_cornell", "c2_bunny_hdr_soft", "l_lights_diffuse"):
            with self.subTest(case=name):
                picture = self.render(name)
                for renderer in ("cycles", "mitsuba"):
                    with self.subTest(renderer=renderer):
                        self.expect_same(picture, f"{name}.{renderer}", 0.005)

    def test_helmet(self):
        self.expect_same(self.render("e_damaged_helmet"), "e_damaged_helmet.cycles", 0.01, 0.02)

    def test_spheres_of_every_roughness(self):
        self.expect_same(self.render("f_spheres_hdr"), "f_spheres_hdr.cycles", 0.01, 0.02)
        self.expect_same(self.render("f_spheres_hdr", "--brdf", "gltf"), "f_spheres_hdr.mitsuba_gltf", 0.01, 0.02)


if __name__ == "__main__":
    main()

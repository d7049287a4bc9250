# SPDX-License-Identifier: MIT
"""Pictures of `render --integrator primary`: channels, cameras, equality of both backends, statistics, memory."""
import json
import math
import os
import struct
import subprocess
from array import array

from arguments_test import triangle
from program import SCENES, ProgramTest, channels_of, main, metamarch, skip_over_least_texels

CORNELL = SCENES / "cornell.glb"
# Three beams and two corners: boxes that no kd-tree can make.
PINWHEEL = {"resolution": [7, 6, 5], "boxes": [[0, 0, 0, 3, 4, 2], [0, 0, 2, 7, 4, 5], [3, 0, 0, 7, 6, 2],
                                               [0, 4, 0, 3, 6, 5], [3, 4, 2, 7, 6, 5]]}
CUBE = """v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 3 4 8 7
f 1 5 8 4
f 2 3 7 6
"""
SHEET_SIDE = 708  # squares, of two triangles each
MAX_RESIDENT = 3 << 30  # bytes, for a sheet of a million triangles


def write_sheet(path, side):
    """Writes a GLB of a wavy sheet of side x side squares."""
    positions = array("f")
    for y in range(side + 1):
        for x in range(side + 1):
            positions.extend((x / side, math.sin(20 * x / side) * math.cos(15 * y / side) / 20, y / side))
    indices = array("I")
    for corner in (y * (side + 1) + x for y in range(side) for x in range(side)):
        above = corner + side + 1
        indices.extend((corner, above, corner + 1, corner + 1, above, above + 1))
    views = [positions.tobytes(), indices.tobytes()]
    document = json.dumps({
        "asset": {"version": "2.0"}, "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(positions) // 3, "type": "VEC3"},
                      {"bufferView": 1, "componentType": 5125, "count": len(indices), "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteLength": len(views[0])},
                        {"buffer": 0, "byteOffset": len(views[0]), "byteLength": len(views[1])}],
        "buffers": [{"byteLength": sum(map(len, views))}]}).encode()
    document += b" " * (-len(document) % 4)
    chunks = [(b"JSON", document), (b"BIN\0", b"".join(views))]
    body = b"".join(struct.pack("<I", len(content)) + kind + content for kind, content in chunks)
    path.write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body)


class RenderTest(ProgramTest):
    def render(self, scene, *words, name="a.exr"):
        return self.succeed("render", scene, "-o", name, "--integrator", "primary", *words)

    def picture(self, scene, *words):
        self.render(scene, *words)
        return self.read_picture("a.exr")

    def test_channels(self):
        picture = self.picture(CORNELL, "--size", "16x12")
        self.assertEqual(set(picture), channels_of("primary"))
        self.assertEqual([len(row) for row in picture["Z"]], [16] * 12)
        pixels = list(zip(*(sum(picture[channel], []) for channel in ("A", "id.triangle", "Z", "t"))))
        hits = [pixel for pixel in pixels if pixel[0] == 1]
        misses = [pixel for pixel in pixels if pixel[0] != 1]
        self.assertTrue(hits and misses)
        for _, triangle, z, t in hits:
            self.assertIn(triangle, range(32))
            self.assertTrue(0 < z <= t < math.inf)
        self.assertEqual(set(misses), {(0, 4294967295, math.inf, math.inf)})

    def test_the_picture_is_upright_and_not_mirrored(self):
        picture = self.picture(CORNELL, "--size", "40x30")
        red, green, up = picture["R"], picture["G"], picture["N.Y"]
        row = [(red[15][x], green[15][x]) for x in range(40) if picture["A"][15][x] == 1]
        self.assertGreater(row[0][0], 3 * row[0][1])  # the left wall is red
        self.assertGreater(row[-1][1], 2 * row[-1][0])  # the right one green
        column = [up[y][20] for y in range(30) if picture["A"][y][20] == 1]
        self.assertEqual((column[0], column[-1]), (-1, 1))  # ceiling above floor

    def test_rays_go_through_pixel_centres(self):
        """With a vertical field of view of 90 degrees, pixel (x, y) of 8x6 looks along ((x - 3.5) / 3, (2.5 - y) / 3, -1)."""
        picture = self.picture(CORNELL, "--size", "8x6", "--eye", "0,0.27,0.2", "--target", "0,0.27,-1", "--vfov", "90")
        for y in range(6):
            for x in range(8):
                ray = math.hypot((x - 3.5) / 3, (2.5 - y) / 3, 1)
                self.assertAlmostEqual(picture["t"][y][x] / picture["Z"][y][x], ray, places=5)
        self.assertAlmostEqual(picture["Z"][0][3], min(0.4796, 0.2788 * 3 / 2.5), places=5)  # the ceiling

    def test_up(self):
        view = ("--size", "9x9", "--eye", "0,0.27,1.5", "--target", "0,0.27,0")
        upright = self.picture(CORNELL, *view)
        turned = self.picture(CORNELL, *view, "--up", "1,0,0")  # what was on the right is on top
        self.assertGreater(upright["G"][4][6], 2 * upright["R"][4][6])
        self.assertGreater(turned["G"][2][4], 2 * turned["R"][2][4])

    def test_cameras_by_name_and_index(self):
        for name, words in {"default": (), "name": ("--camera", "front"), "index": ("--camera", "0")}.items():
            self.render(CORNELL, "--size", "16x12", *words, name=f"{name}.exr")
        self.succeed("compare", "default.exr", "name.exr")
        self.succeed("compare", "default.exr", "index.exr")

    def test_a_scene_without_a_camera_is_framed(self):
        (self.tmp / "cube.obj").write_text(CUBE)
        alpha = self.picture("cube.obj", "--size", "24x16")["A"]
        border = [*alpha[0], *alpha[-1], *(row[0] for row in alpha), *(row[-1] for row in alpha)]
        self.assertEqual(set(border), {0})
        self.assertGreater(sum(map(sum, alpha)), 24 * 16 / 5)

    def test_orthographic_camera(self):
        """A picture two units high of half the unit square, turned back by 45 degrees about its lower side."""
        eye = [0.5, 0.5, 3]
        triangle(self.tmp / "cameras.gltf",
                 nodes=[{"mesh": 0, "rotation": [-math.sin(math.pi / 8), 0, 0, math.cos(math.pi / 8)]},
                        {"camera": 0, "translation": eye}, {"camera": 1, "translation": eye}],
                 cameras=[{"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.01}},
                          {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "zfar": 100, "znear": 0.01}}])
        picture = self.picture("cameras.gltf", "--camera", "1", "--size", "48x36")
        hits = [(x, y) for y in range(36) for x in range(48) if picture["A"][y][x] == 1]
        height = 18 * math.sqrt(0.5)
        self.assertEqual(hits, [(x, y) for y in range(27) for x in range(15, 48)
                                if (x + 0.5 - 15) / 18 + (27 - y - 0.5) / height < 1])
        self.assertEqual(picture["t"], picture["Z"])  # parallel rays

    def test_both_backends_draw_the_same_picture(self):
        for scene in ("cornell", "objects", "degenerate"):
            with self.subTest(scene=scene):
                self.render(SCENES / f"{scene}.glb", "--size", "161x119", name="gpu.exr")
                self.render(SCENES / f"{scene}.glb", "--size", "161x119", "--backend", "cpu", name="cpu.exr")
                self.succeed("compare", "gpu.exr", "cpu.exr", "--max-abs", "0")

    def test_any_partition_draws_what_the_tree_draws(self):
        (self.tmp / "pinwheel.json").write_text(json.dumps(PINWHEEL))
        for words in (["--partition", "pinwheel.json"], ["--partition", "pinwheel.json", "--no-exit-boxes"], ["--merge"]):
            with self.subTest(words=words):
                self.render(CORNELL, "--size", "161x119", "--stats", "s.json", *words, name="march.exr")
                self.render(CORNELL, "--size", "161x119", "--backend", "cpu", *words, name="tree.exr")
                if words[0] == "--partition":
                    self.assertEqual(json.loads((self.tmp / "s.json").read_text())["scene"]["table"]["leaves"], 5)
                self.succeed("compare", "march.exr", "tree.exr", "--max-abs", "0")

    def test_uneven_cells_draw_what_the_tree_draws(self):
        uneven = ["--size", "161x119", "--table", "rectilinear"]
        self.render(CORNELL, "--size", "161x119", "--backend", "cpu", name="tree.exr")
        for words in (uneven, [*uneven, "--no-exit-boxes"], [*uneven, "--tree-depth", "3"],
                      ["--size", "161x119", "--traversal", "rectilinear_table"]):
            with self.subTest(words=words):
                self.render(CORNELL, *words, "--stats", "s.json", name="march.exr")
                stats = json.loads((self.tmp / "s.json").read_text())
                self.assertEqual(stats["traversal"], "rectilinear_table")
                self.assertGreater(stats["scene"]["rectilinear"]["cells"], 1)
                self.succeed("compare", "march.exr", "tree.exr", "--max-abs", "0")
        self.render(CORNELL, *uneven, "--backend", "cpu", name="cpu.exr")
        self.succeed("compare", "cpu.exr", "tree.exr")

    def test_stats(self):
        self.render(CORNELL, "--size", "16x12", "--stats", "s.json")
        stats = json.loads((self.tmp / "s.json").read_text())
        self.assertEqual((stats["size"], stats["rays"], stats["scene"]["triangles"]), ([16, 12], 192, 32))
        self.assertTrue(0 < stats["hits"] < 192)
        for key in ("device", "driver", "traversal", "stepsPerRay", "testsPerRay", "mraysPerSecond"):
            self.assertTrue(stats[key], key)
        self.assertGreater(stats["seconds"]["render"], 0)

    def test_png(self):
        self.render(CORNELL, "--size", "40x30", name="a.png")
        self.assertEqual((self.tmp / "a.png").read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        picture = self.read_picture("a.png")
        self.assertEqual((set(picture), len(picture["R"])), ({"R", "G", "B", "A"}, 30))

    def test_quiet(self):
        self.assertEqual(self.render(CORNELL, "--size", "8x6", "--quiet"), "")
        self.assertRegex(self.render(CORNELL, "--size", "8x6"), r"\Aa.exr: 8 x 6, 32 triangles, .* tests per ray\n\Z")

    def test_only_the_named_files_are_left(self):
        self.render(CORNELL, "--size", "8x6", "--stats", "s.json")
        self.assertEqual(sorted(path.name for path in self.tmp.iterdir()), ["a.exr", "s.json"])

    def test_a_failure_leaves_the_old_picture(self):
        (self.tmp / "a.exr").write_text("old")
        self.refuse(3, "render", "missing.glb", "-o", "a.exr", "--stats", "s.json")
        self.assertEqual((self.tmp / "a.exr").read_text(), "old")

    def test_a_folder_without_write_permission(self):
        if os.geteuid() == 0:
            self.skipTest("root may write everywhere")
        (self.tmp / "locked").mkdir(mode=0o555)
        self.assertRegex(self.refuse(5, "render", CORNELL, "-o", "locked/a.exr"), r"cannot write locked/a.exr: .*denied")

    def test_memory_of_a_million_triangles(self):
        scene = self.tmp / "sheet.glb"
        write_sheet(scene, SHEET_SIDE)
        words = [metamarch(), "render", scene, "-o", self.tmp / "a.exr", "--size", "640x480", "--quiet", "--integrator", "primary"]
        # The program's own memory: without the validation layers, and without the freed blocks AddressSanitizer keeps.
        own = {"METAMARCH_VALIDATION": "0", "ASAN_OPTIONS": f"{os.environ.get('ASAN_OPTIONS', '')}:quarantine_size_mb=1"}
        with subprocess.Popen(words, env={**os.environ, **self.environment, **own}, stderr=subprocess.PIPE, text=True) as process:
            messages = process.stderr.read()
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
        skip_over_least_texels(messages)
        self.assertEqual((process.returncode, messages), (0, ""))
        print(f"{scene.name}: {usage.ru_maxrss / 1024:.0f} MiB resident")
        self.assertLess(usage.ru_maxrss * 1024, MAX_RESIDENT)


if __name__ == "__main__":
    main()

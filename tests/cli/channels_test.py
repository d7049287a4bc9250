# SPDX-License-Identifier: MIT
"""Channels, headers and storage of pictures, read back by OpenImageIO's Python library."""
import base64
import json
import math
import struct
import subprocess
import unittest

from program import SCENES, ProgramTest, main, metamarch, write_moving

CORNELL = SCENES / "cornell.glb"
MISS = 4294967295
WIDTH, HEIGHT = 60, 30
SIZE = ("--size", f"{WIDTH}x{HEIGHT}")


def murmur_hash(text):
    """MurmurHash3_x86_32 with seed 0, from its description."""
    data = text.encode()
    word = lambda x: x & 0xffffffff
    turn = lambda x, by: word(x << by) | x >> (32 - by)
    mix = lambda k: word(turn(word(k * 0xcc9e2d51), 15) * 0x1b873593)
    whole = len(data) // 4 * 4
    h = 0
    for i in range(0, whole, 4):
        h = word(turn(h ^ mix(int.from_bytes(data[i:i + 4], "little")), 13) * 5 + 0xe6546b64)
    h ^= mix(int.from_bytes(data[whole:], "little")) ^ len(data)
    h = word((h ^ h >> 16) * 0x85ebca6b)
    h = word((h ^ h >> 13) * 0xc2b2ae35)
    return h ^ h >> 16


def cryptomatte_id(name):
    """The specification's conversion: no float of these bits is a denormal, an infinity or no number."""
    h = murmur_hash(name)
    return h ^ 1 << 23 if h >> 23 & 255 in (0, 255) else h


def bits(value):
    return struct.unpack("<I", struct.pack("<f", value))[0]


def transformed(point, matrix):
    """A row vector times OpenEXR's matrix, divided by its last number."""
    x, y, z, w = (sum(a * matrix[4 * row + column] for row, a in enumerate([*point, 1])) for column in range(4))
    return x / w, y / w, z / w


def write_quads(file, quads):
    """Writes quads (corner, right, up, reflectance) as a glTF with a lamp far away. The materials are diffuse."""
    greys = sorted({grey for *_, grey in quads})
    data, views, accessors, primitives = b"", [], [], []
    for grey in greys:
        points = []
        for corner, right, up in ((c, r, u) for c, r, u, g in quads if g == grey):
            a, b, c, d = ([corner[i] + s * right[i] + t * up[i] for i in range(3)] for s, t in ((0, 0), (1, 0), (1, 1), (0, 1)))
            points += [a, b, c, a, c, d]
        flat = [number for point in points for number in point]
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": 4 * len(flat)})
        accessors.append({"bufferView": len(views) - 1, "componentType": 5126, "count": len(points), "type": "VEC3"})
        primitives.append({"attributes": {"POSITION": len(accessors) - 1}, "material": len(primitives)})
        data += struct.pack(f"<{len(flat)}f", *flat)
    materials = [{"name": f"grey {grey}", "extensions": {"KHR_materials_specular": {"specularFactor": 0}},
                  "pbrMetallicRoughness": {"baseColorFactor": [grey, grey, grey, 1], "metallicFactor": 0}} for grey in greys]
    file.write_text(json.dumps({
        "asset": {"version": "2.0"}, "meshes": [{"primitives": primitives}], "materials": materials,
        # The lamp shines along -z of its node, which the rotation turns to (2, -2, 1) / 3.
        "nodes": [{"mesh": 0}, {"rotation": [-0.5773503, -0.5773503, 0, 0.5773503], "extensions": {"KHR_lights_punctual": {"light": 0}}}],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "directional", "intensity": 2}]}},
        "extensionsUsed": ["KHR_lights_punctual", "KHR_materials_specular"], "scenes": [{"nodes": [0, 1]}], "scene": 0,
        "bufferViews": views, "accessors": accessors,
        "buffers": [{"byteLength": len(data), "uri": "data:;base64," + base64.b64encode(data).decode()}]}))


BOX = [((-0.5, 1, -0.5), (0, 0, 1), (1, 0, 0), 0.6), ((-0.5, 0, 0.5), (1, 0, 0), (0, 1, 0), 0.6), ((0.5, 0, -0.5), (-1, 0, 0), (0, 1, 0), 0.6),
       ((0.5, 0, 0.5), (0, 0, -1), (0, 1, 0), 0.6), ((-0.5, 0, -0.5), (0, 0, 1), (0, 1, 0), 0.6)]
CHECKERS = [((x, 0, z), (0, 0, 1), (1, 0, 0), 0.8 if (x + z) % 2 else 0.2) for x in range(-6, 6) for z in range(-6, 6)]


class ChannelsTest(ProgramTest):
    def render(self, *words, scene=CORNELL, name="a.exr", backend="cpu"):
        self.succeed("render", scene, "-o", name, *SIZE, "--quiet", "--backend", backend, *words)
        return self.read_picture(name) if name.endswith(".exr") else None

    def specs(self, name="a.exr"):
        """The specs of a picture's parts."""
        import OpenImageIO

        file = OpenImageIO.ImageInput.open(str(self.tmp / name))
        self.assertTrue(file, OpenImageIO.geterror())
        found = []
        while file.seek_subimage(len(found), 0):
            found.append(file.spec())
        return found

    def hits(self, picture):
        """The pixels whose first sample hits something."""
        return [(x, y) for y in range(HEIGHT) for x in range(WIDTH) if picture["id.triangle"][y][x] != MISS]

    def test_first_samples_and_light(self):
        picture = self.render("--spp", "2", "--aov", "all")
        spec, = self.specs()
        matrix = spec.getattribute("worldtoNDC")
        eye = [float(number) for number in spec.getattribute("metamarch/eye").split(",")]
        hits = self.hits(picture)
        self.assertTrue(0 < len(hits) < WIDTH * HEIGHT)
        for x, y in hits:
            at = lambda channel: picture[channel][y][x]
            point = [at("P.X"), at("P.Y"), at("P.Z")]
            right, down, _ = transformed(point, matrix)
            self.assertTrue(-0.01 <= right * WIDTH - x <= 1.01 and -0.01 <= down * HEIGHT - y <= 1.01, (x, y, right, down))
            self.assertAlmostEqual(math.dist(point, eye), at("t"), places=4)
            self.assertAlmostEqual(transformed(point, spec.getattribute("worldtocamera"))[2], at("Z"), places=4)
            self.assertNotIn(MISS, (at("id.mesh"), at("id.instance"), at("id.material")))
            for color in "RGB":
                parts = at(f"emission.{color}") + at(f"direct.{color}") + at(f"indirect.{color}")
                self.assertAlmostEqual(parts, at(color), delta=1e-5 * max(1, abs(at(color))))
        self.assertEqual({value for row in picture["samples"] for value in row}, {2})
        for y in range(HEIGHT):
            for x in range(WIDTH):
                if (x, y) not in hits:
                    self.assertEqual({picture[f"id.{kind}"][y][x] for kind in ("triangle", "mesh", "instance", "material")}, {MISS})
                    self.assertEqual((picture["Z"][y][x], picture["P.X"][y][x], picture["UV.U"][y][x]), (math.inf, 0, 0))

    def test_only_what_is_asked(self):
        self.assertEqual(set(self.render("--spp", "1", "--aov", "UV,id.mesh")), {*"RGBA", "UV.U", "UV.V", "id.mesh"})
        picture = self.render("--integrator", "primary", "--aov", "all", "--miss-depth", "1e10")
        self.assertIn("P.X", picture)
        self.assertNotIn("albedo.R", picture)
        self.assertEqual({picture["Z"][y][x] for y in range(HEIGHT) for x in range(WIDTH)
                          if picture["id.triangle"][y][x] == MISS}, {1e10})

    def test_both_backends(self):
        words = ("--spp", "17", "--aov", "all")
        self.render(*words, name="gpu.exr", backend="gpu")
        self.render(*words, name="cpu.exr")
        self.succeed("compare", "gpu.exr", "cpu.exr", "--max-abs", "0")

    def test_header_has_the_camera(self):
        headers = set()
        for words in (("--vfov", "20"), ("--vfov", "70"), ("--orthographic", "3")):
            self.render("--integrator", "primary", "--eye", "0,0,4", "--target", "0,0,0", *words)
            spec, = self.specs()
            headers.add(tuple(spec.getattribute("worldtoNDC")))
            right, down, _ = transformed((0, 0, 0), spec.getattribute("worldtoNDC"))
            self.assertAlmostEqual(right, 0.5)
            self.assertAlmostEqual(down, 0.5)
            # Left-handed: x to the right, y up, z ahead.
            for point, expected in {(1, 0, 4): (1, 0, 0), (0, 1, 4): (0, 1, 0), (0, 0, 3): (0, 0, 1)}.items():
                self.assertEqual([round(a, 6) + 0 for a in transformed(point, spec.getattribute("worldtocamera"))], list(expected))
            if words[0] == "--vfov":
                self.assertAlmostEqual(spec.getattribute("metamarch/vfov"), float(words[1]), places=4)
                edge = 4 * math.tan(math.radians(float(words[1]) / 2))
            else:
                self.assertEqual(spec.getattribute("metamarch/orthographicHeight"), 3)
                edge = 1.5
            right, down, _ = transformed((edge * WIDTH / HEIGHT, edge, 0), spec.getattribute("worldtoNDC"))
            self.assertAlmostEqual(right, 1, places=5)
            self.assertAlmostEqual(down, 0, places=5)
        self.assertEqual(len(headers), 3)
        sha1 = subprocess.run(["sha1sum", CORNELL], capture_output=True, text=True, check=True).stdout.split()[0]
        self.assertEqual(spec.getattribute("metamarch/sceneSha1"), sha1)

    def test_layers_and_types(self):
        words = ("--spp", "1", "--aov", "all", "--half")
        self.render(*words)
        self.render(*words, "--multipart", name="parts.exr")
        layers = {}
        for spec in self.specs("parts.exr"):
            layers[spec.getattribute("oiio:subimagename")] = spec.channelnames
            for i, channel in enumerate(spec.channelnames):
                small = channel in "RGBA" or channel.split(".")[0] in ("N", "Ns", "albedo", "emission", "direct", "indirect", "shadow")
                whole = channel.startswith("id.") or channel == "samples"
                self.assertEqual(str(spec.channelformat(i)), "half" if small else "uint" if whole else "float", channel)
        self.assertEqual(layers["rgba"], ("R", "G", "B", "A"))
        self.assertEqual(layers["N"], ("N.X", "N.Y", "N.Z"))
        self.assertEqual(layers["P"], ("P.X", "P.Y", "P.Z"))
        self.assertEqual(layers["Z"], ("Z",))
        self.assertEqual(layers["CryptoObject00"], tuple(f"CryptoObject00.{c}" for c in "RGBA"))
        self.assertEqual(set(layers["id"]), {"id.triangle", "id.mesh", "id.instance", "id.material"})
        self.succeed("compare", "a.exr", "parts.exr")
        self.render(*words, "--multipart", "--compression", "dwaa:200", name="lossy.exr")
        exact, lossy = self.read_picture("a.exr"), self.read_picture("lossy.exr")
        for channel in exact:
            if channel.split(".")[0] in ("Z", "t", "P", "UV", "id", "samples") or channel.startswith("Crypto"):
                self.assertEqual(repr(exact[channel]), repr(lossy[channel]), channel)
        self.assertNotEqual(exact["R"], lossy["R"])

    def test_cryptomatte(self):
        picture = self.render("--spp", "16", "--aov", "cryptomatte,id.triangle", "--filter", "blackman-harris")
        spec, = self.specs()
        attributes = {a.name: a.value for a in spec.extra_attribs}
        with open(CORNELL, "rb") as file:
            length, = struct.unpack("<I", file.read(20)[12:16])
            gltf = json.loads(file.read(length))
        names = {"CryptoObject": {node["name"] for node in gltf["nodes"] if "mesh" in node},
                 "CryptoMaterial": {material["name"] for material in gltf["materials"]}}
        names["CryptoAsset"] = names["CryptoObject"]  # nodes without parents
        for layer, expected in names.items():
            key = f"cryptomatte/{murmur_hash(layer):08x}"[:len("cryptomatte/") + 7]
            self.assertEqual(attributes[f"{key}/name"], layer)
            self.assertEqual(attributes[f"{key}/hash"], "MurmurHash3_32")
            self.assertEqual(attributes[f"{key}/conversion"], "uint32_to_float32")
            manifest = json.loads(attributes[f"{key}/manifest"])
            self.assertEqual(manifest, {name: f"{cryptomatte_id(name):08x}" for name in manifest})
            self.assertLessEqual(set(manifest), expected)
            seen = set()
            mixed = 0
            for y in range(HEIGHT):
                for x in range(WIDTH):
                    ranks = [(bits(picture[f"{layer}{rank // 2:02}.{'RB'[rank % 2]}"][y][x]),
                              picture[f"{layer}{rank // 2:02}.{'GA'[rank % 2]}"][y][x]) for rank in range(6)]
                    self.assertEqual([part for _, part in ranks], sorted((part for _, part in ranks), reverse=True))
                    self.assertEqual(sum(part for _, part in ranks), picture["A"][y][x])
                    self.assertTrue(all((part > 0) == (number != 0) for number, part in ranks))
                    seen |= {number for number, _ in ranks} - {0}
                    mixed += ranks[1][1] > 0
            self.assertEqual({f"{number:08x}" for number in seen}, set(manifest.values()))
            self.assertGreater(mixed, 0)

    def test_transparent(self):
        words = ("--spp", "4", "--background", "0.5,0.6,0.7")
        shown = self.render(*words)
        hidden = self.render(*words, "--transparent", name="b.exr")
        full = part = 0
        for y in range(HEIGHT):
            for x in range(WIDTH):
                alpha = hidden["A"][y][x]
                self.assertEqual(alpha, shown["A"][y][x])
                if alpha == 1:
                    full += 1
                    self.assertEqual(hidden["R"][y][x], shown["R"][y][x])
                if alpha == 0:
                    self.assertEqual((hidden["R"][y][x], shown["R"][y][x]), (0, 0.5))
                if 0 < alpha < 1:
                    part += 1
                    self.assertAlmostEqual(hidden["B"][y][x] + (1 - alpha) * 0.7, shown["B"][y][x], places=4)
        self.assertTrue(full and part)
        self.render(*words, "--transparent", name="a.png")
        self.assertEqual(self.specs("a.png")[0].nchannels, 4)

    def test_shadow_catcher_over_a_checkerboard(self):
        """A picture of a box and its shadow, laid over one of a checkerboard, is one of the box on the checkerboard: where a
        pixel of the ground has one colour, to the last digits, because both take the same samples."""
        for name, quads in (("box", BOX), ("board", CHECKERS), ("both", BOX + CHECKERS)):
            write_quads(self.tmp / f"{name}.gltf", quads)
        words = ("--spp", "20", "--integrator", "direct", "--background", "0.4,0.4,0.4", "--eye", "1.5,3,2.5", "--target", "0,0.2,0")
        render = lambda scene, *more, **keys: self.render(*words, *more, scene=f"{scene}.gltf", **keys)
        catcher = ("--shadow-catcher", "y=0", "--transparent")
        box = render("box", *catcher, "--aov", "shadow,Z,id.material", name="box.exr")
        board = render("board", "--aov", "albedo")
        plain = render("both")
        shown = render("box", "--shadow-catcher", "y=0")
        exact = dark = edges = surplus = 0
        for y in range(HEIGHT):
            for x in range(WIDTH):
                alpha = box["A"][y][x]
                laid = box["R"][y][x] + (1 - alpha) * board["R"][y][x]
                albedo = board["albedo.R"][y][x]
                if box["R"][y][x] == 0 and min(abs(albedo - 0.2), abs(albedo - 0.8)) < 1e-5:
                    exact += 1
                    self.assertAlmostEqual(laid, plain["R"][y][x], places=5)
                surplus += laid - plain["R"][y][x]
                self.assertAlmostEqual(box["R"][y][x] + (1 - alpha) * 0.4, shown["R"][y][x], places=5)
                self.assertLessEqual(1 - alpha, box["shadow.G"][y][x] + 1e-6)
                self.assertEqual(box["Z"][y][x] == math.inf, box["id.material"][y][x] == MISS)
                if 0 < box["shadow.G"][y][x] < 1 - alpha + 1e-6:  # nothing but ground
                    dark += box["shadow.G"][y][x] < 0.6
                    self.assertEqual((box["R"][y][x], box["id.material"][y][x]), (0, MISS))
                elif box["shadow.R"][y][x] < 1:
                    edges += 1
        self.assertGreater(exact, WIDTH * HEIGHT / 2)
        self.assertGreater(dark, 20)
        self.assertGreater(edges, 10)
        self.assertAlmostEqual(surplus / (WIDTH * HEIGHT), 0, delta=0.002)  # the box sees the end of the board

        more = ("--aov", "shadow,Z,id.material")
        for name, ground in (("auto.exr", "auto"), ("below.exr", "y=-0.00025")):  # of the size of the scene, 1
            render("box", "--shadow-catcher", ground, "--transparent", *more, name=name)
        self.succeed("compare", "auto.exr", "below.exr", "--max-abs", "0")
        for name, samples in (("a.part", "0:7"), ("b.part", "7:20")):
            self.succeed("render", "box.gltf", "-o", name, *SIZE, "--quiet", "--backend", "cpu", *words[2:], *catcher, "--aov", "shadow",
                         "--samples", samples)
        self.succeed("merge", "a.part", "b.part", "-o", "merged.exr")
        merged = self.read_picture("merged.exr")
        self.assertEqual((merged["A"], merged["shadow.B"]), (box["A"], box["shadow.B"]))

    def test_reflection_of_a_shadow_catcher(self):
        """A card fills the mirror, 45 degrees below the camera: it covers the reflectance of a dielectric (C. Schlick 1994)."""
        write_quads(self.tmp / "card.gltf", [((-9, 0.5, -9), (18, 0, 0), (0, 90, 0), 0.25)])
        words = ("--spp", "4", "--background", "0.4,0.4,0.4", "--eye", "0,1,4", "--target", "0,0,3", "--vfov", "1", "--transparent")
        catcher = ("--shadow-catcher", "y=0", "--aov", "shadow,direct,indirect")
        plain = self.render(*words, *catcher, scene="card.gltf")
        for roughness, delta in (("0", 1e-3), ("0.2", 1e-2)):
            picture = self.render(*words, *catcher, "--catcher-reflection", roughness, scene="card.gltf")
            covered = []
            for y in range(HEIGHT):
                for x in range(WIDTH):
                    left = sum(weight * picture[f"shadow.{c}"][y][x] for c, weight in (("R", 0.2126), ("G", 0.7152), ("B", 0.0722)))
                    covered.append(1 - (1 - picture["A"][y][x]) / left)
            self.assertAlmostEqual(sum(covered) / len(covered), 0.04 + 0.96 * (1 - 0.5 ** 0.5) ** 5, delta=delta)
            y, x = HEIGHT // 2, WIDTH // 2
            self.assertGreater(picture["R"][y][x], 0)
            self.assertAlmostEqual(picture["direct.R"][y][x] + picture["indirect.R"][y][x], picture["R"][y][x], places=6)
        self.assertEqual(plain["R"][y][x], 0)

    def test_shadow_catcher_of_a_material(self):
        write_quads(self.tmp / "both.gltf", BOX + [((-9, 0, -9), (0, 0, 18), (18, 0, 0), 0.3)])
        words = ("--spp", "4", "--background", "0.4,0.4,0.4", "--eye", "1.5,3,2.5", "--target", "0,0.2,0", "--transparent")
        for chosen in ("grey 0.3", "0"):
            picture = self.render(*words, "--shadow-catcher", chosen, scene="both.gltf")
            ground = [picture["A"][y][x] for y in range(HEIGHT) for x in range(WIDTH) if picture["R"][y][x] == 0]
            self.assertGreater(len(ground), WIDTH * HEIGHT / 2)
            self.assertGreater(ground.count(0), len(ground) / 4)  # not only nearly
            self.assertTrue(0.1 < max(ground) < 1)
        # Parts of the usual channels go together too.
        part = ("render", "both.gltf", *SIZE, "--backend", "cpu", "--quiet", *words[2:], "--shadow-catcher", "0")
        self.succeed(*part, "-o", "a.part", "--samples", "0:1")
        self.succeed(*part, "-o", "b.part", "--samples", "1:4")
        self.succeed("merge", "a.part", "b.part", "-o", "merged.exr", "--quiet")
        self.assertEqual((self.tmp / "merged.exr").read_bytes(), (self.tmp / "a.exr").read_bytes())
        line = self.refuse(2, "render", "both.gltf", "-o", "b.exr", "--shadow-catcher", "floor")
        self.assertEqual(line, "there is no material floor; the scene has 0 'grey 0.3', 1 'grey 0.6'; a plane is y=HEIGHT or auto (--shadow-catcher)")

    def test_motion(self):
        write_moving(self.tmp / "a.gltf")
        parallel = ("--eye", "0.2,0,4", "--target", "0.2,0,0", "--orthographic", "3")  # 10 pixels a unit
        for words, expected in ((parallel, (3 / 24 * 10, 0.6 / 24 * 10)), ((*parallel, "--frame-rate", "12"), (2.5, 0.5)),
                                (("--animation", "of node 1"), (-1.2 / 24 * 6, 0)), ((), (1.8 / 24 * 6, 0.6 / 24 * 6)),
                                ((*parallel, "--time", "1"), (0, 0))):  # the last key
            time = () if "--time" in words else ("--time", "0.1")
            picture = self.render("--integrator", "primary", "--aov", "motion,id.triangle", *words, *time, scene="a.gltf")
            hits = self.hits(picture)
            self.assertTrue(0 < len(hits) < WIDTH * HEIGHT)
            for y in range(HEIGHT):
                for x in range(WIDTH):
                    right, up = expected if (x, y) in hits else (0, 0)
                    self.assertAlmostEqual(picture["motion.X"][y][x], right, places=5)
                    self.assertAlmostEqual(picture["motion.Y"][y][x], up, places=5)
        still = self.render("--integrator", "primary", "--aov", "all", scene="a.gltf")
        self.assertEqual({value for row in still["motion.X"] for value in row}, {0})

    def test_pictures_for_people(self):
        self.render("--spp", "1", name="a.png")
        shown = self.read_picture("a.png")
        for name, words, kind, delta in (("b.png", ("--bits", "16"), "uint16", 0.5 / 255), ("c.tif", (), "uint8", 0),
                                         ("d.tiff", ("--bits", "16"), "uint16", 0.5 / 255), ("e.jpg", (), "uint8", 0.2),
                                         ("f.webp", (), "uint8", 0.2)):
            with self.subTest(name=name):
                for copy in (name, f"again_{name}"):
                    self.render("--spp", "1", *words, name=copy)
                self.assertEqual((self.tmp / name).read_bytes(), (self.tmp / f"again_{name}").read_bytes())
                self.assertEqual(str(self.specs(name)[0].format), kind)
                self.assertEqual(len(self.specs(name)), 1)
                read = self.read_picture(name)
                mean = lambda picture: sum(map(sum, picture["R"])) / (WIDTH * HEIGHT)
                self.assertAlmostEqual(mean(read), mean(shown), delta=max(delta, 1e-6))
                if delta < 0.1:
                    worst = max(abs(a - b) for rows in zip(read["R"], shown["R"]) for a, b in zip(*rows))
                    self.assertLessEqual(worst, delta + 1e-6)

    def test_streams(self):
        self.render("--spp", "1", name="a.png")
        run = lambda *words, **more: subprocess.run([metamarch(), "render", *words, *SIZE, "--spp", "1", "--backend", "cpu"], cwd=self.tmp, capture_output=True,
                                                    check=True, **more).stdout
        self.assertEqual(run(CORNELL, "-o", "-", "--format", "png"), (self.tmp / "a.png").read_bytes())
        self.assertEqual(run("-", "-o", "-", "--format", "png", input=CORNELL.read_bytes()), (self.tmp / "a.png").read_bytes())
        for data, expected in ((b"", "standard input: nothing to read"), (b"glTF", "standard input: ")):
            result = subprocess.run([metamarch(), "render", "-", "-o", "a.exr"], cwd=self.tmp, input=data, capture_output=True, check=False)
            self.assertEqual(result.returncode, 3)
            self.assertIn(expected, result.stderr.decode())
            self.assertEqual(result.stderr.count(b"\n"), 1)

    def test_refusals(self):
        for words, expected in (("-o a.jpg --bits 16", "only a PNG or a TIFF has 16 bits"),
                                ("-o a.png --half", "only an EXR has these"),
                                ("-o a.exr --bits 16", "an EXR has floats"),
                                ("-o a.png --format jpeg", "the ending stands for another format"),
                                ("-o a.exr --aov Q", "'Q' is no channel"),
                                ("-o a.exr --aov all,Z", "'all' is no channel"),
                                ("-o a.png --aov Z", "only an EXR has further channels"),
                                ("-o a.exr --aov albedo --integrator primary", "primary does not know the channel albedo"),
                                ("-o a.exr --aov cryptomatte --compression dwaa", "would change the points P and the ids of Cryptomatte"),
                                ("-o a.exr --compression dwa", "give zip, zips, piz, none, dwaa or dwaa:LEVEL"),
                                ("-o a.exr --compression dwaa:x", "level from 0 to 100000"),
                                ("-o a.exr --miss-depth nan", "give inf or a finite number"),
                                ("-o a.jpg --transparent", "a JPEG cannot be transparent"),
                                ("-o a.exr --shadow-catcher y=low", "give y=HEIGHT with a finite number"),
                                ("-o a.exr --shadow-catcher y=inf", "give y=HEIGHT with a finite number"),
                                ("-o a.exr --shadow-catcher auto --integrator primary", "has no shadows"),
                                ("-o a.exr --shadow-catcher auto --noise-threshold 0.1", "give --spp alone"),
                                ("-o a.exr --catcher-reflection 0.1", "needs --shadow-catcher"),
                                ("-o a.exr --shadow-catcher auto --catcher-reflection 1.5", "give a roughness from 0 to 1"),
                                ("-o a.exr --aov motion", "give the time"),
                                ("-o a.exr --aov motion --frame-rate 24", "--time"),
                                ("-o a.exr --aov motion --time 0 --frame-rate 0", "frames per second, from 0.001 to 1e6"),
                                ("-o a.exr --aov shadow", "name it by --shadow-catcher")):
            with self.subTest(words=words):
                self.assertIn(expected, self.refuse(2, "render", CORNELL, *words.split()))


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: MIT
"""The report of `info`."""
import json

from program import SCENES, ProgramTest, main, shared_scene

# A dot opens an object.
KEYS = """vertices triangles bounds.min bounds.max lattice.resolution lattice.unit table.cells table.leaves tree.nodes
tree.leaves tree.emptyLeaves tree.references tree.depth bytes.tree bytes.table bytes.exitBoxes bytes.triangles
seconds.tree seconds.table""".split()


def value(report, key):
    for name in key.split("."):
        report = report[name]
    return report


class InfoTest(ProgramTest):
    def info(self, *words):
        return json.loads(self.succeed("info", *words, "--json"))

    def test_keys(self):
        for scene in ("cornell", "objects", "degenerate"):
            report = self.info(SCENES / f"{scene}.glb")
            for key in KEYS:
                with self.subTest(scene=scene, key=key):
                    self.assertIsNotNone(value(report, key))

    def test_numbers(self):
        report = self.info(SCENES / "cornell.glb", "--unit", "0.1")
        self.assertEqual(report["triangles"], 32)
        self.assertEqual(report["bounds"], {"min": [-0.278, 0.0, -0.2796], "max": [0.278, 0.5488, 0.2796]})
        self.assertEqual(report["lattice"], {"resolution": [6, 6, 6], "unit": [0.1, 0.1, 0.1]})
        self.assertEqual((report["table"]["cells"], report["bytes"]["table"]), (216, (1 + 8**3 + 3) * 4))  # a brick, padded
        leaves, references = report["table"]["leaves"], report["tree"]["references"]
        self.assertEqual(report["bytes"]["exitBoxes"], 16 * leaves)
        # A frame for each leaf with triangles, and groups of four boxes and of four indices.
        boxes = report["bytes"]["referenceBoxes"] - 16 * report["tree"]["leaves"]
        self.assertEqual(boxes % 32, 0)
        self.assertGreaterEqual(boxes, 8 * references)
        self.assertLess(boxes, 8 * references + 32 * report["tree"]["leaves"])
        self.assertEqual(report["bytes"]["triangles"], 48 * report["triangles"])

    def test_scale(self):
        report = self.info(SCENES / "cornell.glb", "--scale", "-2")
        self.assertEqual(report["bounds"], {"min": [-0.556, -1.0976, -0.5592], "max": [0.556, 0.0, 0.5592]})

    def test_planes_rounded_to_quanta(self):
        report = self.info(SCENES / "objects.glb", "--table", "gcd", "--quantum", "0.125")
        planes = report["planes"]
        self.assertAlmostEqual(planes["quantum"], 0.125, 4)
        self.assertAlmostEqual(planes["movedAtMost"], 0.0625, 4)
        for unit, quanta in zip(report["lattice"]["unit"], planes["quantaPerCell"]):
            self.assertEqual(unit, 0.125 * quanta)
        self.assertNotIn("planes", self.info(SCENES / "objects.glb"))
        text = self.succeed("info", SCENES / "objects.glb", "--table", "gcd")
        self.assertRegex(text, r"(?m)^planes +moved by at most 0\.03516, to multiples of 0\.07031; ") # 18 / 256

    def test_uneven_planes(self):
        table = self.info(SCENES / "objects.glb", "--table", "rectilinear")["rectilinear"]
        x, y, z = (planes - 1 for planes in table["planes"])
        self.assertEqual(table["cells"], x * y * z)
        self.assertLess(table["bytes"]["table"], 4 * table["cells"])
        self.assertEqual(table["bytes"]["triangles"], 48 * table["references"])
        self.assertGreater(table["seconds"], 0)
        shallow = self.info(SCENES / "objects.glb", "--table", "rectilinear", "--tree-depth", "3")["rectilinear"]
        self.assertEqual(shallow["depth"], 3)
        self.assertLessEqual(shallow["leaves"], 8)
        self.assertNotIn("rectilinear", self.info(SCENES / "objects.glb"))

    def test_merged_leaves(self):
        whole = self.info(SCENES / "objects.glb")["table"]
        merged = self.info(SCENES / "objects.glb", "--merge")["table"]
        self.assertLess(merged["leaves"], whole["leaves"])
        self.assertEqual(merged["cells"], whole["cells"])

    def test_text(self):
        text = self.succeed("info", SCENES / "objects.glb", "--cells", "1e5")
        for label in ("vertices", "triangles", "bounds", "lattice", "kd-tree", "leaves", "table", "memory", "built in"):
            self.assertRegex(text, rf"(?m)^{label} +\S")

    def test_scenes(self):
        (self.tmp / "a.off").write_text("OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
        self.assertEqual(self.info("a.off")["scenes"], [""])
        self.assertRegex(self.succeed("info", "a.off"), r"(?m)^scenes +0 ''$")
        names = ["near", "far\x1b[2J", *(str(i) for i in range(2, 53))]
        # No scene has a mesh, so none has triangles.
        (self.tmp / "b.gltf").write_text(json.dumps(
            {"asset": {"version": "2.0"}, "nodes": [{}], "scenes": [{"name": name, "nodes": [0]} for name in names]}))
        self.assertEqual(self.info("b.gltf", "--scene", "near")["scenes"], names)
        text = self.succeed("info", "b.gltf")
        self.assertRegex(text, r"(?m)^scenes +0 'near'\n {13}1 'far\\u001b\[2J'\n {13}2 '2'$")
        self.assertRegex(text, r"(?m)^ {13}49 '49'\n {13}and 3 more, see --json$")

    def test_the_papers_settings(self):
        words = SCENES / "objects.glb", "--unit", "0.1"
        paper, ours = self.info(*words, "--preset", "paper"), self.info(*words)
        self.assertEqual(paper["lattice"], ours["lattice"])
        self.assertEqual(paper["tree"]["depth"], 16)
        self.assertGreater(ours["tree"]["depth"], 16)
        self.assertEqual((paper["triangles"], paper["table"]["cells"]), (17044, 180 * 77 * 180))

    def test_the_papers_models(self):
        folder = shared_scene("paper")
        models = {
            "bunny.ply": (["--unit", "0.002"], 69451, [78, 78, 61], 371124),
            "cow_viewpoint.obj": (["--scale", "0.1", "--unit", "0.02"], 5804, [53, 32, 18], 30528),
        }
        for name, (options, triangles, resolution, cells) in models.items():
            with self.subTest(name=name):
                report = self.info(folder / name, *options, "--preset", "paper")
                self.assertEqual(report["triangles"], triangles)
                self.assertEqual(report["lattice"]["resolution"], resolution)
                self.assertEqual(report["table"]["cells"], cells)
                self.assertLessEqual(report["tree"]["depth"], 16)
                if name == "bunny.ply":  # which has nothing but positions: none is split
                    self.assertEqual(report["vertices"], 35947)


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: MIT
"""Tests `metamarch bench` from outside: its output, its files and its refusals."""
import csv
import json
import struct
import subprocess

from program import SCENES, SOURCE, ProgramTest, main, shared_scene

ROW_KEYS = {"scene", "rays", "traversal", "backend", "rayCount", "hits", "mraysPerSecond", "spread", "visitsPerRay",
            "testsPerRay", "bytesPerRay", "floorMultiple"}
QUICK = ["--repeat", "1", "--seconds", "0"]


class TraversalTest(ProgramTest):
    def bench(self, *words):
        self.text = self.succeed("bench", "traversal", str(SCENES / "objects.glb"), "--size", "24x16", *QUICK,
                                 "--json", "rows.json", *words)
        return json.loads((self.tmp / "rows.json").read_text())

    def test_every_traversal_and_ray_set_has_a_row(self):
        lists, lacking = self.bench_lists()
        report = self.bench()
        self.assertEqual(report["schema"], 1)
        self.assertLessEqual({"device", "driver", "commit", "rows"}, report.keys())
        on_device = [row for row in report["rows"] if row["backend"] == "gpu"]
        names = {*lists["traversals"], "floor"} - {"brute_force", *lacking}
        self.assertEqual({(row["rays"], row["traversal"]) for row in on_device},
                         {(rays, name) for rays in lists["ray sets"] for name in names})
        for name in lacking:
            self.assertIn(f"{name} is left out", self.text)
        for row in report["rows"]:
            self.assertLessEqual(ROW_KEYS, row.keys())
            self.assertGreater(row["mraysPerSecond"], 0)
        for row in on_device:
            if row["traversal"] != "ray_query":  # the bytes that the driver reads are unknown
                self.assertGreater(row["bytesPerRay"], 0, row)
            self.assertEqual(row["differingHits"], 0, row)

    def test_every_time_is_a_multiple_of_the_floor(self):
        rows = self.bench("--rays", "close,shadow", "--traversals", "meta_table,kd_stack")["rows"]
        floors = {(row["rays"], row["backend"]): row for row in rows if row["traversal"] == "floor"}
        self.assertLessEqual({("close", "gpu"), ("shadow", "gpu")}, floors.keys())
        for floor in floors.values():
            self.assertEqual(floor["floorMultiple"], 1)
            self.assertEqual(floor["visitsPerRay"], 0)
            self.assertAlmostEqual(floor["testsPerRay"], floor["hits"] / floor["rayCount"])  # none for a miss
        for row in rows:
            floor = floors[row["rays"], row["backend"]]
            self.assertEqual(row["hits"], floor["hits"])
            self.assertAlmostEqual(row["floorMultiple"], floor["mraysPerSecond"] / row["mraysPerSecond"])

    def test_uneven_cells_are_marched_by_their_own_traversal(self):
        rows = self.bench("--rays", "close", "--table", "rectilinear", "--tree-depth", "6")["rows"]
        self.assertEqual({row["traversal"] for row in rows if row["backend"] == "gpu"}, {"floor", "rectilinear_table"})

    def test_ray_queries_run_or_are_refused(self):
        lists, lacking = self.bench_lists()
        self.assertIn("ray_query", lists["traversals"])
        words = ["--rays", "close", "--traversals", "ray_query"]
        if "ray_query" not in lacking:
            self.assertIn("ray_query", {row["traversal"] for row in self.bench(*words)["rows"]})
            return
        scene = str(SCENES / "objects.glb")
        for command in (["bench", "traversal", scene, *words],
                        ["render", scene, "-o", "out.exr", "--traversal", "ray_query"]):
            line = self.refuse(4, *command)
            self.assertRegex(line, r"traversal ray_query: .* lacks .*\(--traversal\)$")
            self.assertIn(f"lacks {lacking['ray_query']}", line)

    def test_rays_come_from_a_file(self):
        (self.tmp / "two.rays").write_bytes(struct.pack("<12f", 0, 0.5, 9, 0, 0, -1, 0, 0.5, 9, 0, 0, 1))
        rows = self.bench("--rays", "two.rays", "--traversals", "meta_table")["rows"]
        self.assertEqual({(row["rays"], row["rayCount"]) for row in rows}, {("two.rays", 2)})
        self.assertLessEqual({row["hits"] for row in rows}, {0, 1})

    def test_a_page_for_a_readme(self):
        report = self.bench("--rays", "far", "--traversals", "meta_table", "--markdown", "rows.md")
        page = (self.tmp / "rows.md").read_text()
        self.assertRegex(page, r"\n## objects\.glb: \d+ triangles\n")
        self.assertRegex(page, r"\n\| meta_table \| .* \| \d+\.\d\d \(\d+\.\d\) \|\n")
        self.assertRegex(page, r"\| objects.glb \| far \| meta_table \| gpu \|")
        for key in ("device", "driver", "commit", "date", "setting"):
            self.assertIn(f"| {key} | {report[key]} |", page)

    def test_bad_input_is_refused(self):
        (self.tmp / "nan.rays").write_bytes(struct.pack("<6f", 0, 0, 0, 0, float("nan"), 1))
        (self.tmp / "short.rays").write_bytes(b"12345")
        scene = str(SCENES / "objects.glb")
        for code, part, words in [(3, "not finite", [scene, "--rays", "nan.rays"]),
                                  (3, "5 bytes", [scene, "--rays", "short.rays"]),
                                  (3, "no such file", [scene, "--rays", "nowhere"]),
                                  (3, "absent.glb", ["absent.glb"]),
                                  (2, "warp", [scene, "--traversals", "warp"]),
                                  (2, "--repeat", [scene, "--repeat", "0"]),
                                  (2, "--seconds", [scene, "--seconds", "-1"]),
                                  (2, "--size", [scene, "--size", "0x1"]),
                                  (4, "nowhere", [scene, "--devices", "nowhere"]),
                                  (5, "nowhere", [scene, "--json", "nowhere/rows.json"])]:
            with self.subTest(words=words):
                self.assertIn(part, self.refuse(code, "bench", "traversal", *words))
        self.assertIn("traversal or paper", self.refuse(2, "bench"))


class PaperTest(ProgramTest):
    def test_the_experiment(self):
        text = self.succeed("bench", "paper", "--scenes", shared_scene(), "--out", "paper", "--size", "40x30", *QUICK)
        self.assertIn("A visit is an inner node or a leaf", text)
        self.assertIn("80 to 85 % fewer visits", text)
        self.assertIn("30 to 50 % less render time", text)
        rows = json.loads((self.tmp / "paper" / "paper.json").read_text())["rows"]
        self.assertEqual(len(rows), 2 * 4 * 4 * 2 * 3)  # models, views, ray sets, backends, floor and traversals
        with open(self.tmp / "paper" / "paper.csv", newline="") as file:
            self.assertEqual(len(list(csv.DictReader(file))), len(rows))
        for row in rows:
            if row["rays"] == "primary":
                self.assertEqual(row["rayCount"], 1200)
        visits = {(row["scene"], row["rays"], row["view"], row["traversal"]): row["visitsPerRay"] for row in rows}
        for (scene, rays, view, traversal), count in visits.items():
            if traversal == "meta_table":
                self.assertLess(count, visits[scene, rays, view, "kd_stack"])
        self.draw()

    def draw(self):
        plot = subprocess.run([str(SOURCE / "tools" / "plot_bench"), "paper/paper.json", "paper"],
                              cwd=self.tmp, capture_output=True, text=True, check=False)
        if "matplotlib" in plot.stderr:
            self.assertEqual((plot.returncode, len(plot.stderr.splitlines())), (1, 1))
            self.skipTest("pictures need python3-matplotlib")
        self.assertEqual((plot.returncode, plot.stderr), (0, ""))
        for name in ("fig9.svg", "fig9.png", "fig10.svg", "fig10.png"):
            self.assertGreater((self.tmp / "paper" / name).stat().st_size, 1000)

    def test_missing_models_are_named(self):
        line = self.refuse(3, "bench", "paper", "--scenes", ".", "--out", "paper")
        self.assertIn("cow.off", line)
        self.assertIn("tools/fetch_scenes", line)


class SizesTest(ProgramTest):
    def plot(self, *words):
        return subprocess.run([str(SOURCE / "tools" / "plot_sizes"), *words], cwd=self.tmp, capture_output=True, text=True,
                              check=False)

    def test_every_size_has_its_rows_and_a_picture(self):
        plot = self.plot("sizes", "400", "1600")
        if "matplotlib" in plot.stderr:
            self.assertEqual((plot.returncode, len(plot.stderr.splitlines())), (1, 1))
            self.skipTest("pictures need python3-matplotlib")
        self.assertEqual((plot.returncode, plot.stderr), (0, ""))
        rows = [line.split(" | ") for line in (self.tmp / "sizes" / "sizes.md").read_text().splitlines()[4:]]
        self.assertEqual([(row[0], row[1], row[4]) for row in rows],
                         [(f"| {size}", traversal, rays) for size in (400, 1600) for rays in ("close", "diffuse")
                          for traversal in ("meta_table", "bvh_stack")])
        for row in rows:
            for number in (*row[2:4], *row[5:7], row[7].rstrip(" |")):
                self.assertGreaterEqual(float(number), 0)
        for name in ("sizes.svg", "sizes.png"):
            self.assertGreater((self.tmp / "sizes" / name).stat().st_size, 1000)

    def test_wrong_words_have_one_line(self):
        for words in ((), ("sizes", "1e3"), ("sizes", "99"), ("sizes", "20000001")):
            plot = self.plot(*words)
            self.assertEqual((plot.returncode, len(plot.stderr.splitlines())), (1, 1), words)
            self.assertFalse((self.tmp / "sizes").exists())


if __name__ == "__main__":
    main()

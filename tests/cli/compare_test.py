# SPDX-License-Identifier: MIT
"""The reports and the files of `compare`."""
import json

from arguments_test import make_files
from program import ProgramTest, main


class CompareTest(ProgramTest):
    def setUp(self):
        super().setUp()
        make_files(self.tmp)

    def test_json(self):
        result = self.run_program("compare", "black.png", "grey.png", "--json")
        report = json.loads(result.stdout)
        self.assertEqual(result.returncode, 1)
        self.assertIs(report["passed"], False)
        self.assertEqual((report["pixels"], report["failingPixels"], report["mismatches"]), (2, 2, []))
        green = report["channels"][1]
        self.assertEqual((green["name"], green["judged"], green["failingPixels"]), ("G", True, 2))
        for key, value in {"rmse": 0.2, "meanDifference": -0.2, "maxDifference": 0.2}.items():
            self.assertAlmostEqual(green[key], value, places=6)

    def test_writes_the_difference(self):
        self.assertEqual(self.run_program("compare", "black.png", "grey.png", "--out", "d.exr").returncode, 1)
        self.succeed("compare", "d.exr", "grey.png")


if __name__ == "__main__":
    main()

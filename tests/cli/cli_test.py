"""The program from outside: arguments, exit codes, the one line on stderr.

cli_test.py METAMARCH: runs every case below, in a temporary folder that `{tmp}` stands for.
To test another call, add a line to CASES; to test a file, write it in make_files().
"""
import json
import re
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

METAMARCH = ""

NO_OUTPUT = r""
ANYTHING = r".*"


def png(path, color):
    """A 2x1 picture of one RGB colour, written by hand: the tests need no image library."""
    def chunk(name, body):
        return struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body))

    rows = b"\0" + bytes(color) * 2
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 2, 1, 8, 2, 0, 0, 0))
                     + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def make_files(tmp):
    png(tmp / "black.png", (0, 0, 0))
    png(tmp / "grey.png", (0, 51, 0))  # 51 / 255 = 0.2
    (tmp / "text.exr").write_text("this is no picture\n")
    (tmp / "empty.exr").write_bytes(b"")
    (tmp / "folder.exr").mkdir()


# (arguments, exit code, stdout, the line on stderr without "metamarch: "); the last two are regular expressions for the
# whole of it, and on stdout `.` also matches the end of a line.
CASES = [
    # the program itself
    ("", 2, ANYTHING, r"no sub-command given; see `metamarch SUBCOMMAND --help`"),
    ("--version", 0, r"metamarch \d+\.\d+\.\d+ \([0-9a-z-]+\)\nVulkan headers +1\.\d+\.\d+\n.*", NO_OUTPUT),
    ("--help", 0, r".*Exit codes:\n.*Example:\n  build/metamarch .*\n", NO_OUTPUT),
    ("compar", 2, NO_OUTPUT, r"unknown sub-command `compar`; did you mean `compare`\? .*"),
    ("qqqqqq", 2, NO_OUTPUT, r"unknown sub-command `qqqqqq` \(see `metamarch --help`: .*"),
    ("--versoin", 2, NO_OUTPUT, r"unknown option `--versoin`; did you mean `--version`\? .*"),
    # compare: bounds
    ("compare {tmp}/black.png {tmp}/black.png", 0, r"channel .*within bounds: 0 of 2 pixels fail.*", NO_OUTPUT),
    ("compare {tmp}/black.png {tmp}/grey.png", 1, r".*\nout of bounds: 2 of 2 pixels fail.*",
     r"\S+black.png and \S+grey.png differ: 2 of 2 pixels .*"),
    ("compare {tmp}/black.png {tmp}/grey.png --max-abs 0.19", 1, ANYTHING, r".* differ: .*"),
    ("compare {tmp}/black.png {tmp}/grey.png --max-abs 0.21", 0, ANYTHING, NO_OUTPUT),
    ("compare {tmp}/black.png {tmp}/grey.png --max-fail-percent 99", 1, ANYTHING, r".* differ: .*"),
    ("compare {tmp}/black.png {tmp}/grey.png --max-fail-percent 100", 0, ANYTHING, NO_OUTPUT),
    # compare: bad arguments
    ("compare", 2, NO_OUTPUT, r"compare: A is required \(see `metamarch compare --help`\)"),
    ("compare {tmp}/black.png", 2, NO_OUTPUT, r"compare: B is required .*"),
    ("compare a b c", 2, NO_OUTPUT, r"compare: unknown argument `c` .*"),
    ("compare a b --maxabs 1", 2, NO_OUTPUT, r"compare: unknown argument `--maxabs`; did you mean `--max-abs`\? .*"),
    ("compare a b --max-abs -1", 2, NO_OUTPUT, r"--max-abs: -1 is no bound; .*"),
    ("compare a b --max-abs nan", 2, NO_OUTPUT, r"--max-abs: nan is no bound; .*"),
    ("compare a b --max-abs much", 2, NO_OUTPUT, r"compare: .*--max-abs.*"),
    ("compare a b --max-fail-percent -0.1", 2, NO_OUTPUT, r"--max-fail-percent: -0.1 is no bound; .*"),
    ("compare a b --out {tmp}/difference.jpg", 2, NO_OUTPUT, r"\S+difference.jpg: a picture is written as .exr or .png"),
    # compare: unreadable pictures
    ("compare {tmp}/missing.exr {tmp}/black.png", 3, NO_OUTPUT, r"cannot read \S+/missing.exr: No such file or directory"),
    ("compare {tmp}/black.png {tmp}/text.exr", 3, NO_OUTPUT, r"cannot read \S+/text.exr: .*"),
    ("compare {tmp}/black.png {tmp}/empty.exr", 3, NO_OUTPUT, r"cannot read \S+/empty.exr: .*"),
    ("compare {tmp}/black.png {tmp}", 3, NO_OUTPUT, r"cannot read \S+: it is a folder"),
    # compare: unwritable output
    ("compare {tmp}/black.png {tmp}/grey.png --out {tmp}/no/a.exr", 5, NO_OUTPUT,
     r"cannot write \S+/no/a.exr: there is no such folder"),
    ("compare {tmp}/black.png {tmp}/grey.png --out {tmp}/folder.exr", 5, NO_OUTPUT,
     r"cannot write \S+/folder.exr: it is a folder"),
]


def run(arguments, tmp):
    words = [word.format(tmp=tmp) for word in arguments.split()]
    return subprocess.run([METAMARCH, *words], capture_output=True, text=True, timeout=120, check=False)


def sub_commands():
    listing = subprocess.run([METAMARCH, "--help"], capture_output=True, text=True, check=True).stdout
    return re.findall(r"^  (\w+) ", listing.split("Subcommands:")[1].split("Exit codes:")[0], re.MULTILINE)


class CliTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="metamarch-cli-")
        self.addCleanup(folder.cleanup)
        self.tmp = Path(folder.name)
        make_files(self.tmp)

    def test_cases(self):
        for arguments, code, stdout, stderr in CASES:
            with self.subTest(arguments=arguments):
                result = run(arguments, self.tmp)
                self.assertEqual(result.returncode, code, result.stderr)
                self.assertTrue(re.fullmatch(stdout, result.stdout, re.DOTALL), result.stdout)
                line = rf"metamarch: (?:{stderr})\n" if stderr else ""
                self.assertTrue(re.fullmatch(line, result.stderr), result.stderr)

    def test_every_help_ends_with_an_example(self):
        self.assertIn("compare", sub_commands())
        for command in sub_commands():
            with self.subTest(command=command):
                result = run(f"{command} --help", self.tmp)
                self.assertEqual((result.returncode, result.stderr), (0, ""))
                self.assertRegex(result.stdout, rf"(?s)Example:\n(  build/metamarch {command}[^\n]*\n)+\Z")

    def test_compare_json(self):
        result = run("compare {tmp}/black.png {tmp}/grey.png --json", self.tmp)
        report = json.loads(result.stdout)
        self.assertEqual(result.returncode, 1)
        self.assertIs(report["passed"], False)
        self.assertEqual((report["pixels"], report["failingPixels"], report["mismatches"]), (2, 2, []))
        green = report["channels"][1]
        self.assertEqual((green["name"], green["judged"], green["failingPixels"]), ("G", True, 2))
        for key, value in {"rmse": 0.2, "meanDifference": -0.2, "maxDifference": 0.2}.items():
            self.assertAlmostEqual(green[key], value, places=6)

    def test_compare_writes_the_difference(self):
        self.assertEqual(run("compare {tmp}/black.png {tmp}/grey.png --out {tmp}/d.exr", self.tmp).returncode, 1)
        self.assertEqual(run("compare {tmp}/d.exr {tmp}/grey.png", self.tmp).returncode, 0)


if __name__ == "__main__":
    METAMARCH = sys.argv.pop(1)
    unittest.main()

# SPDX-License-Identifier: MIT
"""Code that the tests of the program share: runs the program, finds scenes, reads pictures.

Every test file is called as `FILE METAMARCH [arguments of unittest]` and ends with a call of main().
"""
import atexit
import base64
import json
import math
import os
import re
import select
import struct
import subprocess
import sys
import tempfile
import threading
import unittest
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
SCENES = SOURCE / "scenes"
LONGEST = 300  # seconds that a run of the program may take
ALL_SKIPPED = 77  # exit code if all tests were skipped; CTest knows it by SKIP_RETURN_CODE
LEAST_TEXELS = 65536  # maxTexelBufferElements of the least device that Vulkan allows; SwiftShader is one

# The tests of the viewer and of the program run kernels with the same cache as the tests in C++: a driver compiles each
# kernel once.
CACHE = Path(tempfile.gettempdir()) / "metamarch-tests"

_metamarch = None
_servers = threading.local()


def metamarch():
    return _metamarch


def main():
    global _metamarch
    _metamarch = Path(sys.argv.pop(1)).resolve()
    result = unittest.main(exit=False).result
    for test, reason in result.skipped:
        print(f"skipped {test.id()}: {reason}")
    if not result.wasSuccessful():
        sys.exit(1)
    whole = [test for test, _ in result.skipped if not hasattr(test, "test_case")]  # without the parts that subTest() makes
    if whole and len(whole) == result.testsRun:
        sys.exit(ALL_SKIPPED)


def skip_over_least_texels(messages):
    """Ends the test, or its part, as skipped where the program says that an array has more texels than every device takes.

    A device that takes more must take the tests' arrays too. There this line is a failure.
    """
    if match := re.search(rf"buffer '.*' of \d+ texels is over maxTexelBufferElements, {LEAST_TEXELS}\b", messages):
        raise unittest.SkipTest(match[0])


class Server:
    """A process that runs the program in child processes: see program_server.cpp."""

    def __init__(self, file):
        self.process = subprocess.Popen([file], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                                        text=True)
        atexit.register(self.close)

    def close(self):
        self.process.communicate()

    @classmethod
    def of_this_thread(cls):
        """Returns None where METAMARCH_PROGRAM_SERVER names no server: then each call starts the program itself."""
        file = os.environ.get("METAMARCH_PROGRAM_SERVER")
        if file and not hasattr(_servers, "server"):
            _servers.server = cls(file)
        return getattr(_servers, "server", None)

    def run(self, words, cwd, environment):
        with tempfile.TemporaryDirectory(prefix="metamarch-streams-") as folder:
            streams = {name: str(Path(folder) / name) for name in ("stdout", "stderr")}
            request = {"words": words, "cwd": str(cwd), "environment": environment, **streams}
            self.process.stdin.write(json.dumps(request) + "\n")
            self.process.stdin.flush()
            if not select.select([self.process.stdout], [], [], LONGEST)[0]:
                raise TimeoutError(f"{words}: not within {LONGEST} s")
            code = int(self.process.stdout.readline())
            return subprocess.CompletedProcess(words, code, *(Path(file).read_text() for file in streams.values()))


def asset(variable, folder, name):
    """Returns the file or folder `name` in the folder that the variable `variable` names, or in ../shared/`folder`.

    If it does not exist, the test ends in this call: it is skipped, or it fails if METAMARCH_REQUIRE_ASSETS is 1 or if
    `variable` does not name a folder.
    """
    root = Path(os.environ.get(variable, SOURCE.parent / "shared" / folder))
    path = root / name
    if path.exists():
        return path
    if os.environ.get("METAMARCH_REQUIRE_ASSETS") == "1" or (variable in os.environ and not root.is_dir()):
        raise AssertionError(f"absent: {path}")
    raise unittest.SkipTest(f"absent: {path}; {variable} names another folder of {folder}")


def shared_scene(name=""):
    """Returns the file or folder `name` in the folder of other people's scenes: see asset()."""
    return asset("METAMARCH_SCENES", "scenes", name)


def unshare(*options):
    """The end of the test, which is skipped, where this machine lets nobody have namespaces of their own."""
    if subprocess.run(["unshare", *options, "true"], capture_output=True, check=False).returncode != 0:
        raise unittest.SkipTest(f"unshare {' '.join(options)} is not permitted")


def write_moving(file):
    """Writes a square whose node goes by (3, 0.6, 0) in a second, and a camera that goes by (1.2, 0, 0): one unit of the square
    is 6 pixels of 30 in its picture."""
    points = struct.pack("<12f", -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0) + struct.pack("<6H", 0, 1, 2, 0, 2, 3)
    keys = struct.pack("<2f", 0, 1) + struct.pack("<6f", 0, 0, 0, 3, 0.6, 0) + struct.pack("<6f", 0, 0, 5, 1.2, 0, 5)
    accessors = [(0, 0, 4, "VEC3", 5126), (0, 48, 6, "SCALAR", 5123), (1, 0, 2, "SCALAR", 5126), (1, 8, 2, "VEC3", 5126),
                 (1, 32, 2, "VEC3", 5126)]
    animate = lambda node, output: {"name": f"of node {node}", "samplers": [{"input": 2, "output": output}],
                                    "channels": [{"sampler": 0, "target": {"node": node, "path": "translation"}}]}
    file.write_text(json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}], "nodes": [{"mesh": 0}, {"camera": 0}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 2 * math.atan(0.5), "znear": 0.1}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}], "animations": [animate(0, 3), animate(1, 4)],
        "accessors": [{"bufferView": view, "byteOffset": offset, "count": count, "type": kind, "componentType": component,
                       "min": [0], "max": [1]} if kind == "SCALAR" and component == 5126 else
                      {"bufferView": view, "byteOffset": offset, "count": count, "type": kind, "componentType": component}
                      for view, offset, count, kind, component in accessors],
        "bufferViews": [{"buffer": 0, "byteLength": len(points)}, {"buffer": 1, "byteLength": len(keys)}],
        "buffers": [{"byteLength": len(data), "uri": "data:;base64," + base64.b64encode(data).decode()} for data in (points, keys)]}))


def as_nobody(test):
    """What subprocess.run() takes to run the program without privileges in the test's folder. Skips the test where that
    cannot be."""
    for folder in (test.tmp.parent, test.tmp):
        folder.chmod(0o755)
    user = {"user": 65534, "group": 65534, "extra_groups": []} if os.geteuid() == 0 else {}
    user["env"] = {**os.environ, "XDG_CACHE_HOME": "/nonexistent", "HOME": "/nonexistent"}
    try:
        subprocess.run([metamarch(), "--version"], cwd=test.tmp, capture_output=True, check=True, **user)
    except (OSError, subprocess.SubprocessError) as error:
        raise unittest.SkipTest(f"nobody cannot run the program: {error}") from error
    return user


def channels_of(integrator):
    """Returns the channels that are written without --aov, of the list in README.md; image_tests compares this list with
    the program's table."""
    listing = re.search(r"^```\nR G B  .*?^```$", (SOURCE / "README.md").read_text(), re.MULTILINE | re.DOTALL).group()
    lines = [line for line in listing.splitlines()[1:-1]
             if not re.search(r"\(if (asked|denoised)\)", line) and (integrator != "primary" or "not by primary" not in line)]
    return {name for line in lines for name in line.split("  ")[0].split()}


class ProgramTest(unittest.TestCase):
    """Runs the program in a temporary folder, `self.tmp`, with the Vulkan validation layers."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="metamarch-cli-")
        self.addCleanup(folder.cleanup)
        self.tmp = Path(folder.name) / "work"
        self.tmp.mkdir()
        self.environment = {"METAMARCH_VALIDATION": "1", "XDG_CACHE_HOME": str(CACHE),
                            "XDG_STATE_HOME": str(CACHE / "state")}

    def run_program(self, *words, cwd=None, **environment):
        words = [str(word) for word in words]
        environment = {**os.environ, **self.environment, **environment}
        server = Server.of_this_thread()
        if server:
            return server.run(words, cwd or self.tmp, environment)
        return subprocess.run([metamarch(), *words], cwd=cwd or self.tmp, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              text=True, timeout=LONGEST, check=False, env=environment)

    def succeed(self, *words):
        """Runs a call that must succeed without output on stderr; returns its stdout."""
        result = self.run_program(*words)
        skip_over_least_texels(result.stderr)
        self.assertEqual((result.returncode, result.stderr), (0, ""), words)
        return result.stdout

    def refuse(self, code, *words, **environment):
        """Runs a call that must fail with one line on stderr, after any warnings, and no new file; returns the line."""
        before = sorted(self.tmp.rglob("*"))
        result = self.run_program(*words, **environment)
        self.assertEqual(result.returncode, code, (words, result.stderr))
        *warnings, line = result.stderr.splitlines()
        for warning in warnings:
            self.assertRegex(warning, r"\Ametamarch: warning: .")
        self.assertRegex(line, r"\Ametamarch: (?!warning).")
        self.assertEqual(sorted(self.tmp.rglob("*")), before, words)
        return line.removeprefix("metamarch: ")

    def bench_lists(self):
        """Returns the lists of `bench --list` by name, and {traversal that the device cannot run: what it lacks}."""
        lists, lacking = {}, {}
        for line in self.succeed("bench", "--list").splitlines():
            if match := re.match(r"not on 0 .*: (\w+) \(it lacks (.*)\)$", line):
                lacking[match[1]] = match[2]
            else:
                name, words = line.split(": ")
                lists[name] = words.split()
        return lists, lacking

    def read_picture(self, name, wanted=None):
        """Reads a picture with OpenImageIO. Returns {channel: rows of values from the top}, for all channels or for those
        that are wanted. Whole numbers stay whole."""
        import OpenImageIO  # not at the top: Pythons without it run tests that read no picture

        file = OpenImageIO.ImageInput.open(str(self.tmp / name))
        self.assertTrue(file, OpenImageIO.geterror())
        picture = {}
        part = 0
        while file.seek_subimage(part, 0):
            spec = file.spec()
            for i, channel in enumerate(spec.channelnames):
                if wanted is not None and channel not in wanted:
                    continue
                kind = "uint" if str(spec.channelformat(i)) == "uint" else "float"
                picture[channel] = file.read_image(part, 0, i, i + 1, kind)[:, :, 0].tolist()
            part += 1
        return picture

# SPDX-License-Identifier: MIT
"""What the tests of the viewer share: the real program in a window of a screen without a monitor, and hands.

Every test file is called as `FILE METAMARCH [arguments of unittest]` and ends with a call of main(). Nothing in here asserts
how long a thing takes: waits end when what is waited for has come, or far too late.
"""
import os
import re
import subprocess
import tempfile
import time

from Xlib import X

from arguments_test import triangle
from display import LEFT, Display, die_with_parent
from drop import Source
from program import SCENES, SOURCE, ProgramTest, main, metamarch

CORNELL = SCENES / "cornell.glb"
DEGENERATE = SCENES / "degenerate.glb"
OBJECTS = SCENES / "objects.glb"
TOO_LATE = 120  # seconds
READY = r".* - (?!busy)[\w |]+ - metamarch"  # a title while nothing is being read


def wait_until(what, condition):
    """The first answer of `condition` that counts as true."""
    end = time.monotonic() + TOO_LATE
    while True:
        found = condition()
        if found:
            return found
        if time.monotonic() > end:
            raise TimeoutError(f"{what() if callable(what) else what}: not within {TOO_LATE} s")
        time.sleep(0.02)


def written(file):
    """So far, by the process that has the file, too: its place in it must not move."""
    return os.pread(file.fileno(), os.fstat(file.fileno()).st_size, 0).decode()


class Viewer:
    """`metamarch view WORDS`, running. `said` follows its stdout."""

    def __init__(self, test, words, environment=None):
        self.test = test
        self.display = test.display
        self.out = tempfile.TemporaryFile()
        self.err = tempfile.TemporaryFile()
        self.process = subprocess.Popen(
            [metamarch(), "view", *words], cwd=test.tmp, stdin=subprocess.DEVNULL, stdout=self.out, stderr=self.err,
            preexec_fn=die_with_parent,
            env={**os.environ, **test.environment, "DISPLAY": self.display.name, **(environment or {})})
        self.read = 0  # of stdout, in characters
        try:
            self.window = wait_until("a window", self.find_window)
        except BaseException:
            self.end()
            raise

    def find_window(self):
        self.check_alive()
        return next(iter(self.display.windows()), None)

    def check_alive(self):
        if self.process.poll() is not None:
            raise AssertionError(f"the viewer ended with {self.process.returncode}: {self.stderr()}")

    def end(self):
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()
        self.out.close()
        self.err.close()

    def stdout(self):
        return written(self.out)

    def stderr(self):
        return written(self.err)

    def wait_until(self, what, condition):
        def alive():
            self.check_alive()
            return condition()

        def report():
            words = what() if callable(what) else what
            return f"{words}; the title is '{self.title}', stdout '{self.stdout()[-600:]}'"

        return wait_until(report, alive)

    # --- what is seen and said ---

    @property
    def title(self):
        return self.display.title(self.window)

    def screenshot(self):
        return self.display.screenshot(self.window)

    def wait_for_line(self, pattern):
        """The next line on stdout that `pattern` matches as a whole, as a match; lines before it are skipped."""
        def find():
            for line in re.finditer(r"(.*)\n", self.stdout()[self.read:]):
                matched = re.fullmatch(pattern, line[1])
                if matched:
                    self.read += line.end()
                    return matched
            return None

        return self.wait_until(f"a line '{pattern}'", find)

    def wait_for_title(self, pattern):
        return self.wait_until(f"a title '{pattern}'", lambda: re.fullmatch(pattern, self.title))

    def settle(self):
        """Until all input so far has had its effect, and the title tells of it.

        The first answer comes out of the frame that takes the last input, the second out of one after it.
        """
        for _ in range(2):
            options = self.camera_options()
        return options

    def camera_options(self):
        """What key c says: the options of `metamarch render` that make the camera."""
        self.read = len(self.stdout())
        self.key("c")
        return self.wait_for_line(r"(--(?:eye|camera) .*)")[1].split()

    def wait_for_samples(self):
        """Until the path tracer has taken all of its samples."""
        self.settle()
        self.wait_for_title(r".* - \w+, (\d+) of \1 samples - [\w |]+ - metamarch")

    def wait_for_still(self):
        """The picture that no longer changes."""
        self.settle()
        before = None
        equal = 0
        end = time.monotonic() + TOO_LATE
        while equal < 4:
            now = self.screenshot()
            equal = equal + 1 if now == before else 0
            before = now
            if time.monotonic() > end:
                raise TimeoutError("the picture does not come to rest")
            time.sleep(0.1)
        return now

    def wait_for_picture(self, expected):
        """Until the window shows `expected`, to the bit: its last picture may still be on the way to the screen."""
        self.wait_until(lambda: f"the expected picture; {difference(self.screenshot(), expected)}",
                        lambda: self.screenshot() == expected)

    # --- hands ---

    def key(self, *names):
        self.display.key(*names)

    def click(self, x, y, *held, button=LEFT):
        self.display.move(self.window, x, y)
        for name in held:
            self.display.hold(name, True)
        self.display.press(button)
        self.display.release(button)
        for name in reversed(held):
            self.display.hold(name, False)

    def drag(self, start, end, button=LEFT):
        self.display.move(self.window, *start)
        self.display.press(button)
        self.display.move(self.window, (start[0] + end[0]) // 2, (start[1] + end[1]) // 2)
        self.display.move(self.window, *end)
        self.display.release(button)

    def drop(self, *files):
        source = Source(self.display.name)
        try:
            source.drop(self.window, 20, 20, files)
        finally:
            source.close()

    def resize(self, width, height):
        self.window.configure(width=width, height=height)
        self.display.x.sync()

    def hide(self):
        self.window.unmap()
        self.display.x.sync()

    def show(self):
        """With the keyboard, which a window manager would give it."""
        self.window.map()
        wait_until("a visible window", lambda: self.window.get_attributes().map_state == X.IsViewable)
        self.window.set_input_focus(X.RevertToParent, X.CurrentTime)
        self.display.x.sync()


def difference(a, b):
    if a[:2] != b[:2]:
        return f"{a[0]}x{a[1]} in place of {b[0]}x{b[1]}"
    pixels = [i // 3 for i in range(0, len(a[2]), 3) if a[2][i:i + 3] != b[2][i:i + 3]]
    if not pixels:
        return "no pixel differs"
    x, y = pixels[0] % a[0], pixels[0] // a[0]
    at = 3 * pixels[0]
    return (f"{len(pixels)} of {a[0] * a[1]} pixels differ, the first at {x}, {y}: "
            f"{tuple(a[2][at:at + 3])} in place of {tuple(b[2][at:at + 3])}")


class ViewerTest(ProgramTest):
    """Opens windows on a screen of its own. Each must close without a word on stderr: of the validation layers, too."""

    @classmethod
    def setUpClass(cls):
        cls.display = Display()
        cls.addClassCleanup(cls.display.close)
        # Compiled shaders, for all tests of the class: they draw the same pictures with those.
        cache = tempfile.TemporaryDirectory(prefix="metamarch-viewer-cache-")
        cls.addClassCleanup(cache.cleanup)
        cls.cache = cache.name

    def setUp(self):
        super().setUp()
        self.environment["XDG_CACHE_HOME"] = self.cache

    def open(self, scene, *words, size="160x120", panels=False):
        """A viewer; quit() closes it."""
        hidden = () if panels else ("--no-panels",)
        viewer = Viewer(self, [scene, "--size", size, *hidden, *words])
        self.addCleanup(viewer.end)
        viewer.wait_for_title(READY)
        return viewer

    def quit(self, viewer):
        viewer.key("Control_L", "q")
        viewer.process.wait(TOO_LATE)
        self.assertEqual((viewer.process.returncode, viewer.stderr()), (0, ""))
        self.assertEqual(self.display.windows(), [])

    def pixels(self, name):
        """A picture of a file as Display.screenshot() has those of windows."""
        subprocess.run(["oiiotool", name, "--ch", "R,G,B", "-d", "uint8", "-o", "read.ppm"], cwd=self.tmp, check=True,
                       capture_output=True)
        data = (self.tmp / "read.ppm").read_bytes()
        (self.tmp / "read.ppm").unlink()
        header = re.match(rb"P6\s+(\d+)\s+(\d+)\s+255\s", data)
        return int(header[1]), int(header[2]), data[header.end():]

    def render(self, scene, *words, size="160x120"):
        """What `metamarch render` makes of the same words, as screenshot() has it."""
        result = self.run_program("render", scene, "--size", size, "--quiet", *words, "-o", "headless.png")
        self.assertEqual(result.returncode, 0, result.stderr)
        return self.pixels("headless.png")

    def assert_shows(self, viewer, expected):
        try:
            viewer.wait_for_picture(expected)
        except TimeoutError as error:
            self.fail(str(error))

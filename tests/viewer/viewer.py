# SPDX-License-Identifier: MIT
"""Code that the tests of the viewer share: runs the real program in a window of a screen without a monitor.

Every test file is called as `FILE METAMARCH [arguments of unittest]` and ends with a call of main(). Nothing in here asserts
a duration: a wait ends when the awaited state is reached, or fails after a very long time.
"""
import contextlib
import os
import re
import struct
import subprocess
import tempfile
import time
import zlib

from Xlib import X

from arguments_test import triangle
from display import LEFT, Display, die_with_parent
from drop import Source
from program import SCENES, SOURCE, ProgramTest, main, metamarch, skip_over_least_texels

CORNELL = SCENES / "cornell.glb"
DEGENERATE = SCENES / "degenerate.glb"
OBJECTS = SCENES / "objects.glb"
TOO_LATE = 120  # seconds
FOLDED_BELOW, UNFOLD = 702, (18, 17)  # the panel begins folded in narrower windows; the arrow of its title
STAGES = ("reading", "building", "lighting", "uploading")  # of loading
READY = rf".* - (?!({'|'.join(STAGES)}) )[\w |]+ - metamarch"  # the title while no scene is being loaded


def wait_until(what, condition):
    """Returns the first result of `condition` that is true."""
    end = time.monotonic() + TOO_LATE
    while True:
        found = condition()
        if found:
            return found
        if time.monotonic() > end:
            raise TimeoutError(f"{what() if callable(what) else what}: not within {TOO_LATE} s")
        time.sleep(0.02)


def written(file):
    """Returns the content so far. A process still writes the file, so the shared file position must not move."""
    return os.pread(file.fileno(), os.fstat(file.fileno()).st_size, 0).decode()


class Viewer:
    """A running `metamarch view WORDS`."""

    def __init__(self, test, words, environment=None, stdin=subprocess.DEVNULL):
        self.test = test
        self.display = test.display
        self.out = tempfile.TemporaryFile()
        self.err = tempfile.TemporaryFile()
        self.process = subprocess.Popen(
            [metamarch(), "view", *words], cwd=test.tmp, stdin=stdin, stdout=self.out, stderr=self.err,
            preexec_fn=die_with_parent,
            env={**os.environ, **test.environment, "METAMARCH_MESSAGE_SECONDS": "0", "DISPLAY": self.display.name,
                 **(environment or {})})
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
        skip_over_least_texels(self.stdout())  # the viewer says there why a scene is not shown

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

    # --- window, picture and output ---

    @property
    def title(self):
        return self.display.title(self.window)

    def screenshot(self):
        return self.display.screenshot(self.window)

    def wait_for_line(self, pattern):
        """Returns the match of the next whole line on stdout that matches `pattern`; skips lines before it."""
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
        """Waits until all input so far has had its effect and the title shows it.

        The first answer comes from the frame that takes the last input, the second from a frame after it.
        """
        for _ in range(2):
            options = self.camera_options()
        return options

    def camera_options(self):
        """Returns the output of the key C: the options of `metamarch render` that make the same camera."""
        self.read = len(self.stdout())
        self.key("c")
        return self.wait_for_line(r"(--(?:eye|camera) .*)")[1].split()

    def wait_for_samples(self):
        """Waits until the path tracer has taken all of its samples."""
        self.settle()
        self.wait_for_title(r".* - [\w. ]+, (\d+) of \1 samples - [\w |]+ - metamarch")

    def has_all_samples(self):
        samples = re.search(r", (\d+) of (\d+) samples", self.title)
        return not samples or samples[1] == samples[2]

    def wait_for_still(self):
        """Waits until the picture no longer changes, and returns it. A preview is no such picture."""
        self.settle()
        before = None
        equal = 0
        end = time.monotonic() + TOO_LATE
        while equal < 4:
            now = self.screenshot()
            equal = equal + 1 if now == before and self.has_all_samples() else 0
            before = now
            if time.monotonic() > end:
                raise TimeoutError("the picture does not come to rest")
            time.sleep(0.05)
        return now

    def wait_for_other_than(self, picture):
        """Waits until the window shows anything else."""
        self.wait_until("another picture", lambda: self.screenshot() != picture)

    def wait_for_still_other_than(self, picture):
        self.wait_for_other_than(picture)
        return self.wait_for_still()

    def wait_for_picture(self, expected):
        """Waits until the window shows exactly `expected`: its last picture may still be on the way to the screen."""
        self.wait_until(lambda: f"the expected picture; {difference(self.screenshot(), expected)}",
                        lambda: self.screenshot() == expected)

    # --- input ---

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
        """Shows the window and gives it the keyboard, as a window manager would."""
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


def nearest_of(left, above, corner):
    """The predictor of PNG's filter 4."""
    guess = left + above - corner
    return min((left, above, corner), key=lambda value: abs(guess - value))


def read_png(data):
    """Reads an opaque PNG of 8 bits in the format of Display.screenshot(). A start of oiiotool takes longer than this."""
    chunks, at = {}, 8
    while at < len(data):
        length, = struct.unpack_from(">I", data, at)
        name = data[at + 4:at + 8]
        chunks[name] = chunks.get(name, b"") + data[at + 8:at + 8 + length]
        at += 12 + length
    width, height, *kind = struct.unpack(">IIBBBBB", chunks[b"IHDR"])
    assert kind == [8, 2, 0, 0, 0], kind  # RGB of 8 bits, not interlaced
    rows = zlib.decompress(chunks[b"IDAT"])
    pixels, above = bytearray(), bytearray(3 * width)
    for start in range(0, len(rows), 3 * width + 1):
        method, row = rows[start], bytearray(rows[start + 1:start + 1 + 3 * width])
        for i in range(len(row)):
            left, corner = (row[i - 3], above[i - 3]) if i >= 3 else (0, 0)
            predicted = (0, left, above[i], (left + above[i]) // 2, nearest_of(left, above[i], corner) if method == 4 else 0)
            row[i] = row[i] + predicted[method] & 255
        above = row
        pixels += row
    assert len(pixels) == 3 * width * height
    return width, height, bytes(pixels)


class ViewerTest(ProgramTest):
    """Opens windows on a separate screen. Each must close without output on stderr, even of the validation layers."""

    @classmethod
    def setUpClass(cls):
        cls.display = Display()
        cls.addClassCleanup(cls.display.close)

    def setUp(self):
        super().setUp()
        self.viewers = []

    @contextlib.contextmanager
    def subTest(self, *words, **names):
        """A part that fails or is skipped leaves no window behind: the next part would take it for its own."""
        before = len(self.viewers)
        with super().subTest(*words, **names):
            try:
                yield
            finally:
                for viewer in self.viewers[before:]:
                    viewer.end()

    def open(self, scene, *words, size="160x120", panels=False, environment=None):
        """Opens a viewer, without a scene if that is None; quit() closes it."""
        hidden = () if panels else ("--no-panels",)
        viewer = Viewer(self, [*([scene] if scene else []), "--size", size, *hidden, *words], environment)
        self.addCleanup(viewer.end)
        self.viewers.append(viewer)
        viewer.wait_for_title(READY if scene or "--tour" in words else "metamarch")
        if panels and int(size.split("x")[0]) < FOLDED_BELOW:
            viewer.settle()
            viewer.click(*UNFOLD)
            viewer.settle()
        return viewer

    def quit(self, viewer):
        viewer.key("Control_L", "q")
        viewer.process.wait(TOO_LATE)
        self.assertEqual((viewer.process.returncode, viewer.stderr()), (0, ""))
        self.assertEqual(self.display.windows(), [])

    def pixels(self, name):
        """Reads a PNG in the format of Display.screenshot()."""
        return read_png((self.tmp / name).read_bytes())

    def render(self, scene, *words, size="160x120"):
        """Returns the picture of `metamarch render` with the same words, in the format of screenshot()."""
        result = self.run_program("render", scene, "--size", size, "--quiet", *words, "-o", "headless.png")
        skip_over_least_texels(result.stderr)
        self.assertEqual(result.returncode, 0, result.stderr)
        return self.pixels("headless.png")

    def assert_shows(self, viewer, expected):
        try:
            viewer.wait_for_picture(expected)
        except TimeoutError as error:
            self.fail(str(error))

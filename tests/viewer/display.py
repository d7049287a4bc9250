# SPDX-License-Identifier: MIT
"""A screen without a monitor (Xvfb): its windows, its input and its screenshots."""
import ctypes
import os
import select
import shutil
import signal
import subprocess
import time

from Xlib import XK, X, display
from Xlib.ext import xtest

LEFT, MIDDLE, RIGHT, WHEEL_UP, WHEEL_DOWN = 1, 2, 3, 4, 5


def die_with_parent():
    """Makes a new process die with the test, so that a killed test leaves no window and no screen behind."""
    set_parent_death_signal = 1  # PR_SET_PDEATHSIG
    ctypes.CDLL(None).prctl(set_parent_death_signal, signal.SIGKILL)


class Display:
    """Starts an X server and connects to it. `name` is the value for DISPLAY."""

    def __init__(self, width=1600, height=1000):
        if shutil.which("Xvfb") is None:
            raise FileNotFoundError("Xvfb is not installed (Debian: xvfb)")
        reading, writing = os.pipe()
        self.server = subprocess.Popen(["Xvfb", "-displayfd", str(writing), "-screen", "0", f"{width}x{height}x24",
                                        "-nolisten", "tcp"], pass_fds=[writing], stdin=subprocess.DEVNULL,
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                       preexec_fn=die_with_parent)
        os.close(writing)
        with os.fdopen(reading) as pipe:
            number = pipe.readline().strip() if select.select([pipe], [], [], 60)[0] else ""
        if not number:
            self.server.kill()
            self.server.wait()
            raise RuntimeError("Xvfb does not start")
        self.name = ":" + number
        self.x = display.Display(self.name)
        self.root = self.x.screen().root

    def close(self):
        self.x.close()
        self.server.terminate()
        self.server.wait()

    # --- windows ---

    def windows(self):
        """Returns the windows that a program shows or has shown; they have a title."""
        return [window for window in self.root.query_tree().children if self.title(window)]

    def title(self, window):
        found = window.get_full_text_property(self.x.intern_atom("_NET_WM_NAME"))
        return found if found is not None else ""

    def screenshot(self, window):
        """Returns (width, height, bytes of R G B in rows from the top)."""
        shape = window.get_geometry()
        image = window.get_image(0, 0, shape.width, shape.height, X.ZPixmap, 0xffffffff)
        pixels = bytearray(3 * shape.width * shape.height)
        pixels[0::3], pixels[1::3], pixels[2::3] = image.data[2::4], image.data[1::4], image.data[0::4]
        return shape.width, shape.height, bytes(pixels)

    # --- input ---

    def move(self, window, x, y):
        place = window.translate_coords(self.root, 0, 0)
        xtest.fake_input(self.x, X.MotionNotify, x=x - place.x, y=y - place.y)
        self.x.sync()

    def press(self, button):
        xtest.fake_input(self.x, X.ButtonPress, button)
        self.x.sync()

    def release(self, button):
        xtest.fake_input(self.x, X.ButtonRelease, button)
        self.x.sync()

    def key(self, *names):
        """Presses keys one after the other and releases them in the opposite order: "Control_L", "s"."""
        codes = [self.x.keysym_to_keycode(XK.string_to_keysym(name)) for name in names]
        for code in codes:
            xtest.fake_input(self.x, X.KeyPress, code)
        for code in reversed(codes):
            xtest.fake_input(self.x, X.KeyRelease, code)
        self.x.sync()
        time.sleep(0.005)  # GLFW treats two presses of a key within a millisecond as one

    def hold(self, name, is_down):
        code = self.x.keysym_to_keycode(XK.string_to_keysym(name))
        xtest.fake_input(self.x, X.KeyPress if is_down else X.KeyRelease, code)
        self.x.sync()

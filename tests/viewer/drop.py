# SPDX-License-Identifier: MIT
"""Drops files on a window: the source's side of XDND, version 5, https://freedesktop.org/wiki/Specifications/XDND."""
import select
import time

from Xlib import X, Xatom, display
from Xlib.protocol import event

VERSION = 5
SECONDS = 60


class Source:
    """A separate program that offers files to a window and waits until the window has taken them."""

    def __init__(self, name):
        self.x = display.Display(name)
        self.window = self.x.screen().root.create_window(0, 0, 1, 1, 0, X.CopyFromParent)
        self.uris = self.x.intern_atom("text/uri-list")
        self.selection = self.x.intern_atom("XdndSelection")

    def drop(self, target, x, y, files):
        self.target = self.x.create_resource_object("window", target.id)
        self.data = "".join(f"{file.resolve().as_uri()}\r\n" for file in files).encode()
        self.window.set_selection_owner(self.selection, X.CurrentTime)
        copy = self.x.intern_atom("XdndActionCopy")
        self.say("XdndEnter", VERSION << 24, self.uris, 0, 0)
        self.say("XdndPosition", 0, x << 16 | y, X.CurrentTime, copy)
        if not self.wait_for("XdndStatus")[1] & 1:
            raise RuntimeError("the window does not take what is dropped")
        self.say("XdndDrop", 0, X.CurrentTime, 0, 0)
        self.wait_for("XdndFinished")  # its flag is ignored: GLFW 3.3 stores a number of bytes there

    def close(self):
        self.x.close()

    def say(self, message, *values):
        body = event.ClientMessage(window=self.target, client_type=self.x.intern_atom(message),
                                   data=(32, (self.window.id, *values)))
        self.target.send_event(body)
        self.x.flush()

    def wait_for(self, message):
        """Returns the five numbers of the target's answer. Meanwhile the target may ask for the data."""
        wanted = self.x.intern_atom(message)
        end = time.monotonic() + SECONDS
        while time.monotonic() < end:
            if not self.x.pending_events():
                select.select([self.x], [], [], 0.1)
                continue
            seen = self.x.next_event()
            if seen.type == X.SelectionRequest:
                self.hand_over(seen)
            elif seen.type == X.ClientMessage and seen.client_type == wanted:
                return seen.data[1]
        raise TimeoutError(f"no {message} within {SECONDS} s")

    def hand_over(self, request):
        request.requestor.change_property(request.property, request.target or Xatom.STRING, 8, self.data)
        request.requestor.send_event(event.SelectionNotify(
            time=request.time, requestor=request.requestor, selection=request.selection, target=request.target,
            property=request.property))
        self.x.flush()

# SPDX-License-Identifier: MIT
"""Runs the examples of host/python/examples, with little work, and the examples in the docstrings."""
import base64
import doctest
import importlib
import inspect
import json
import os
import re
import sys
import unittest

import program

os.environ["XDG_CACHE_HOME"] = str(program.CACHE)
sys.path.insert(0, str(program.SOURCE / "host/python/examples"))

import metamarch  # noqa: E402
import numpy as np  # noqa: E402


def example(name):
    """Returns the example; skips the test where this machine lacks a package that it imports."""
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError as error:
        raise unittest.SkipTest(str(error)) from error


class Examples(program.ProgramTest):
    def test_views(self):
        scene = program.SCENES / "cornell.glb"
        example("views").main([str(scene), str(self.tmp), "--views", "3", "--size", "12x8", "--spp", "1"])
        self.assertEqual(sorted(file.name for file in self.tmp.iterdir()),
                         [f"00{i}.{ending}" for i in range(3) for ending in ("npz", "png")])
        view = np.load(self.tmp / "002.npz")
        self.assertEqual({name: view[name].shape for name in view.files},
                         {"mask": (8, 12), "mesh": (8, 12), "depth": (8, 12), "normal": (8, 12, 3),
                          "world_to_camera": (4, 4)})
        seen = view["mesh"] != 4294967295
        self.assertTrue(seen.any() and not seen.all())
        self.assertTrue((view["depth"][seen] > 0).all() and (view["depth"][~seen] == 0).all())
        np.testing.assert_allclose(np.linalg.norm(view["normal"][seen], axis=1), 1, atol=1e-5)

    def test_turntable(self):
        turntable = example("turntable")
        output = self.tmp / "turn.gif"
        turntable.main([str(program.SCENES / "objects.glb"), str(output), "--pictures", "3", "--size", "8x8", "--spp", "1"])
        from PIL import Image
        with Image.open(output) as picture:
            self.assertEqual((picture.n_frames, picture.size), (3, (8, 8)))

    def test_handler(self):
        handler = example("handler").handler
        glb = base64.b64encode((program.SCENES / "cornell.glb").read_bytes()).decode()
        answer = handler({"glb": glb, "width": 8, "height": 8, "spp": 1})
        self.assertEqual(answer["statusCode"], 200)
        self.assertTrue(base64.b64decode(answer["body"]).startswith(b"\x89PNG"))
        refused = handler({"glb": base64.b64encode(b"nothing").decode()})
        self.assertEqual(refused["statusCode"], 400)
        self.assertRegex(refused["body"], "^the scene: not glTF")
        body = json.dumps({"glb": glb, "width": 8, "height": 8, "spp": 1})
        self.assertEqual(handler({"body": body}), answer)

    def test_handler_refuses_in_one_line(self):
        handler = example("handler").handler
        glb = base64.b64encode((program.SCENES / "cornell.glb").read_bytes()).decode()
        refused = [
            (400, "^the request is not JSON$", {"body": "{"}),
            (400, "^the request is not JSON$", {"body": None}),
            (400, "^the request is not JSON$", {"body": "[" * 100000}),
            (400, "^the request is not an object", {"body": "[]"}),
            (400, "^the request is not an object", "glb"),
            (400, "^the request is not an object", None),
            (400, "^glb is missing$", {}),
            (400, "^glb: give the file in base64$", {"glb": 3}),
            (400, "^glb: give the file in base64$", {"glb": "?"}),
            (400, "^the scene: nothing to read$", {"glb": ""}),
            (400, "^width: give a whole number$", {"glb": glb, "width": "wide"}),
            (400, "^height: give a whole number$", {"glb": glb, "height": float("inf")}),
            (400, "^spp: give a whole number$", {"glb": glb, "spp": None}),
            (400, "^size -8x8: give ", {"glb": glb, "width": -8, "height": 8}),
            (400, "^spp 0: give ", {"glb": glb, "spp": 0}),
            (413, "^at most ", {"glb": glb, "width": 4096, "height": 4096}),
            (413, "^at most ", {"glb": glb, "width": 10**400}),
            (413, "^at most ", {"glb": glb, "spp": 257}),
        ]
        for status, pattern, event in refused:
            with self.subTest(pattern=pattern):
                answer = handler(event)
                self.assertEqual(answer["statusCode"], status)
                self.assertRegex(answer["body"], pattern)
                self.assertNotIn("\n", answer["body"])

    def test_from_trimesh(self):
        from_trimesh = example("from_trimesh")
        from_trimesh.main([str(self.tmp / "sphere.png")])
        self.assertTrue((self.tmp / "sphere.png").exists())

    def test_docstrings(self):
        before = os.getcwd()
        os.chdir(program.SOURCE)
        self.addCleanup(os.chdir, before)
        result = doctest.testmod(metamarch, optionflags=doctest.NORMALIZE_WHITESPACE)
        self.assertEqual((result.failed, result.attempted > 10), (0, True))

    def test_everything_that_is_called_has_an_example(self):
        files = (program.SOURCE / "host/python/examples").glob("*.py")
        text = "\n".join(file.read_text() for file in files)
        text += "\n".join(one.source for test in doctest.DocTestFinder().find(metamarch) for one in test.examples)
        called = [name for name in metamarch.__all__ if inspect.isfunction(getattr(metamarch, name))]
        self.assertEqual([name for name in called if not re.search(rf"\b{name}\(", text)], [])
        members = [name for kind in ("Film", "Scene", "Tracer") for name in vars(getattr(metamarch, kind))
                   if not name.startswith("_")]
        self.assertEqual([name for name in members if not re.search(rf"\.{name}\b", text)], [])


if __name__ == "__main__":
    program.main()

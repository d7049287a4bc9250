# SPDX-License-Identifier: MIT
"""An EXR with all channels, read by OpenEXR's own Python library: names, layers, types and values are those that
OpenImageIO reads. tools/test --long runs it, because that library is no Debian package.

Blender reads LAYER.PASS.CHANNEL, where CHANNEL is one letter and what is before it may be missing; the letters of one pass are
R G B A, X Y Z or U V (source/blender/imbuf/intern/openexr). Nuke reads LAYER.CHANNEL with any words without blanks.
"""
import json
import re
import subprocess
import sys
import unittest

import OpenEXR

WHOLE_NUMBERS = {"samples", "id.triangle", "id.mesh", "id.instance", "id.material"}
WORDS = WHOLE_NUMBERS | {"steps", "tests"}  # that versions of Blender leave out that want a letter


class OpenExrTest(unittest.TestCase):
    def render(self, *words):
        subprocess.run([sys.argv[1], "render", "scenes/cornell.glb", "-o", "build/openexr.exr", "--size", "24x16", "--spp", "2",
                        "--backend", "cpu", "--aov", "all", "--quiet", *words], check=True)
        with OpenEXR.File("build/openexr.exr") as file:
            grouped = {name: channel.pixels for part in file.parts for name, channel in part.channels.items()}
            names = [part.name() for part in file.parts]
        with OpenEXR.File("build/openexr.exr", separate_channels=True) as file:
            single = {name: channel.pixels for part in file.parts for name, channel in part.channels.items()}
            header = dict(file.parts[0].header)
        return names, grouped, single, header

    def test_layers_and_types(self):
        for words in ((), ("--half",), ("--multipart",), ("--tiled", "--compression", "piz")):
            with self.subTest(words=words):
                names, grouped, single, header = self.render(*words)
                colours = {"RGBA", "albedo", "variance", "emission", "direct", "indirect", "shadow"}
                colours |= {f"Crypto{level}{rank:02}" for level in ("Object", "Material", "Asset") for rank in range(3)}
                self.assertEqual({name for name, pixels in grouped.items() if pixels.ndim == 3}, colours)
                for layer in ("N", "Ns", "P"):
                    self.assertLessEqual({f"{layer}.{axis}" for axis in "XYZ"}, set(single))
                self.assertLessEqual({"Z", "t", "UV.U", "UV.V", "motion.X", "motion.Y"}, set(single))
                for name, pixels in single.items():
                    self.assertEqual(pixels.shape, (16, 24), name)
                    self.assertEqual(pixels.dtype == "uint32", name in WHOLE_NUMBERS, name)
                    if name not in WORDS:
                        self.assertRegex(name, r"\A(\w+\.)?[A-Za-z]\Z")
                    self.assertRegex(name, r"\A\w+(\.\w+)?\Z")
                self.assertEqual({len({*pixels.flatten()}) for name, pixels in single.items() if name == "samples"}, {1})
                self.assertEqual(single["samples"][0][0], 2)
                self.assertEqual(len(names), len(set(names)))
                self.assertEqual(len(header["worldToCamera"]), 4)
                manifests = [value for name, value in header.items() if name.endswith("/manifest")]
                if "--multipart" not in words:
                    self.assertEqual(len(manifests), 3)
                for manifest in manifests:
                    self.assertTrue(json.loads(manifest))
                self.assertTrue(re.match(r"metamarch ", header.get("software", header.get("Software", ""))), header)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])

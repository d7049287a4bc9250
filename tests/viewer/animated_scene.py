# SPDX-License-Identifier: MIT
"""A scene with an animation and variants."""
import base64
import struct

from arguments_test import triangle

SECONDS = 2.0


def animated(path):
    """Writes a white triangle that moves by half a unit in SECONDS, with two variants."""
    data = struct.pack("<9f2f6f", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, SECONDS, 0, 0, 0, 0.5, 0, 0)
    colors = ([1, 1, 1, 1], [1, 0, 0, 1], [0, 1, 0, 1])
    mappings = [{"material": 1, "variants": [0]}, {"material": 2, "variants": [1]}]
    triangle(path, extensionsUsed=["KHR_materials_variants"],
             extensions={"KHR_materials_variants": {"variants": [{"name": "red"}, {"name": "green"}]}},
             materials=[{"pbrMetallicRoughness": {"baseColorFactor": color, "metallicFactor": 0}} for color in colors],
             meshes=[{"primitives": [{"attributes": {"POSITION": 0}, "material": 0,
                                      "extensions": {"KHR_materials_variants": {"mappings": mappings}}}]}],
             accessors=[{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                        {"bufferView": 1, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [SECONDS]},
                        {"bufferView": 2, "componentType": 5126, "count": 2, "type": "VEC3"}],
             bufferViews=[{"buffer": 0, "byteOffset": offset, "byteLength": length} for offset, length in ((0, 36), (36, 8), (44, 24))],
             buffers=[{"byteLength": len(data), "uri": "data:;base64," + base64.b64encode(data).decode()}],
             animations=[{"name": "walk", "samplers": [{"input": 1, "output": 2}],
                          "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}])

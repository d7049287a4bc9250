# SPDX-License-Identifier: MIT
"""Controls of the panel: the time of animations, and material variants."""
import base64
import struct

from panel import BAR, CONTROL, MIDDLE, TEXT, PanelTest
from viewer import main, triangle

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


class ControlsTest(PanelTest):
    def test_time_and_variants(self):
        scene = self.tmp / "animated.gltf"
        animated(scene)
        words = ("--spp", "2", "--background", "1,1,1", "--eye", "0.5,0.5,2", "--target", "0.5,0.5,0")
        size = "460x800"
        viewer = self.open(scene, *words, size=size, panels=True)
        viewer.wait_for_samples()
        _title, _renderer, _statistics, _camera, scene_section, *below = self.sections(viewer)
        viewer.click(100, scene_section + MIDDLE)
        viewer.wait_until("the open section", lambda: self.sections(viewer)[5:] != below)
        controls = scene_section + BAR + TEXT

        variant = controls + MIDDLE
        pose, time = (controls + TEXT + i * CONTROL + MIDDLE for i in (1, 2))  # below the animation's name
        self.slide(viewer, (60, time), (440, time))  # to the end and beyond
        self.choose(viewer, variant, 2)
        viewer.wait_for_samples()
        viewer.key("Tab")
        self.assert_shows(viewer, self.render(scene, *words, "--time", str(SECONDS), "--variant", "green", size=size))
        viewer.key("Tab")
        viewer.settle()
        self.click(viewer, 20, pose)  # off again
        viewer.wait_for_samples()
        viewer.key("Tab")
        self.assert_shows(viewer, self.render(scene, *words, "--variant", "green", size=size))
        self.quit(viewer)


if __name__ == "__main__":
    main()

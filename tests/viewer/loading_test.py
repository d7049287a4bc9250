# SPDX-License-Identifier: MIT
"""Scenes that take long to read, that go, and that are several in a file."""
import re

from arguments_test import triangle
from panel import BAR, MIDDLE, TEXT, PanelTest
from viewer import READY, Viewer, main


class LoadingTest(PanelTest):
    def test_closes_while_it_loads(self):
        scene = self.tmp / "large.obj"
        scene.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\n" + "f 1 2 3\n" * 4000000)
        viewer = Viewer(self, [scene, "--size", "160x120"])
        self.addCleanup(viewer.end)
        viewer.wait_for_title(".* - busy - metamarch")
        self.quit(viewer)

    def test_a_file_that_goes(self):
        scene = self.tmp / "plain.gltf"
        triangle(scene)
        viewer = self.open(scene, "--view", "normals")
        before = viewer.wait_for_still()
        scene.unlink()
        viewer.wait_for_line(rf"{re.escape(str(scene))} is gone; the window shows what it has read")
        self.assert_shows(viewer, before)
        self.quit(viewer)

    def test_several_scenes_in_a_file(self):
        scene = self.tmp / "two.gltf"
        triangle(scene, nodes=[{"mesh": 0}, {"mesh": 0, "translation": [0.3, 0, 0]}],
                 scenes=[{"name": "left", "nodes": [0]}, {"name": "right", "nodes": [1]}], scene=0)
        words = ("--spp", "2", "--background", "1,1,1", "--eye", "0.5,0.5,2", "--target", "0.5,0.5,0")
        size = "720x800"
        viewer = self.open(scene, *words, size=size, panels=True)
        viewer.wait_for_samples()
        _title, _renderer, _statistics, _camera, scene_section, *below = self.sections(viewer)
        viewer.click(100, scene_section + MIDDLE)
        viewer.wait_until("the open section", lambda: self.sections(viewer)[5:] != below)
        self.choose(viewer, scene_section + BAR + TEXT + MIDDLE, 2)
        viewer.wait_for_title(READY)
        viewer.wait_for_samples()
        viewer.key("Tab")
        self.assert_shows(viewer, self.render(scene, *words, "--scene", "right", size=size))
        self.quit(viewer)


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: MIT
"""Scenes that take long to read, that go, and that are several in a file."""
import os
import re
import subprocess

from arguments_test import triangle
from panel import BAR, MIDDLE, TEXT, PanelTest
from viewer import READY, STAGES, Viewer, main

PANEL = 27 * 13 + 7  # the column of its right edge
DONE = bytes((0xff, 0xd2, 0x3c))  # the colour of the bar


class LoadingTest(PanelTest):
    def load_without_end(self, *words):
        """Opens a window on standard input, to which nobody writes."""
        reading, writing = os.pipe()
        self.addCleanup(os.close, writing)
        with open(reading) as stdin:
            viewer = Viewer(self, ["-", *words], stdin=stdin)
        self.addCleanup(viewer.end)
        viewer.wait_for_title(".* - reading - metamarch")
        return viewer

    def test_closes_while_it_loads(self):
        """A window that waits for what reads the scene would never close."""
        self.quit(self.load_without_end("--size", "160x120"))

    def test_the_bar_lies_beside_the_panel(self):
        for words, expected in ((("--no-panels", ), 12), ((), PANEL + 12)):
            with self.subTest(words=words):
                viewer = self.load_without_end("--size", "800x400", *words)

                def places():
                    """The columns of the part that is done, in the rows that have it."""
                    width, height, pixels = viewer.screenshot()
                    rows = (pixels[3 * width * y:3 * width * (y + 1)] for y in range(height))
                    return {tuple(x for x in range(width) if row[3 * x:3 * x + 3] == DONE) for row in rows} - {()}

                done, = viewer.wait_until("a bar", places)
                self.assertEqual(done[0], expected)
                self.assertEqual(list(done), list(range(expected, expected + len(done))))
                self.quit(viewer)

    def test_stages(self):
        """A title lasts for a frame at least, which is longer than a look at it."""
        scene = self.tmp / "grid.obj"
        side = 300
        points = (f"v {x} {y} {x * y % 7}" for y in range(side) for x in range(side))
        faces = (f"f {i} {i + 1} {i + side}\nf {i + 1} {i + side} {i + side + 1}"
                 for i in range(1, side * (side - 1)) if i % side != 0)
        scene.write_text("\n".join((*points, *faces)))
        subprocess.run(["oiiotool", "--pattern", "constant:color=1,2,0.5", "4096x2048", "3", "-o", "map.exr"], cwd=self.tmp,
                       check=True, capture_output=True)
        viewer = Viewer(self, [scene, "--size", "160x120", "--spp", "1", "--env", "map.exr"])
        self.addCleanup(viewer.end)
        stages = []
        while not re.fullmatch(READY, title := viewer.title):
            viewer.check_alive()
            stage = title.split(" - ")[-2] if title.count(" - ") > 1 else ""
            if stage in STAGES and stages[-1:] != [stage]:
                stages.append(stage)
        self.assertEqual(tuple(stages), STAGES)
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

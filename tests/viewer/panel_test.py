# SPDX-License-Identifier: MIT
"""Controls of the panel: the time of animations, and material variants."""
from animated_scene import SECONDS, animated
from arguments_test import triangle
from panel import BAR, CONTROL, MIDDLE, TEXT, PanelTest
from viewer import READY, Viewer, main


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

    def columns(self, viewer):
        """The first and the last column of the triangle; the panel is hidden meanwhile."""
        viewer.key("Tab")
        width, height, pixels = viewer.wait_for_still()
        viewer.key("Tab")
        viewer.settle()
        background = pixels[-3:]
        hit = [i % width for i in range(width * height) if pixels[3 * i:3 * i + 3] != background]
        return min(hit), max(hit)

    def test_the_model_lies_beside_it(self):
        scene = self.tmp / "plain.gltf"
        triangle(scene)
        viewer = self.open(scene, "--view", "normals", size="1000x300", panels=True)
        free = (359 + 1000) / 2  # the middle of what the panel leaves
        for key in (None, "1", "Home"):
            if key:
                viewer.key(key)
            first, last = self.columns(viewer)
            self.assertGreater(first, 359, key)
            self.assertLess(abs((first + last) / 2 - free), 60, key)
        viewer.drag((700, 100), (960, 100))  # half a turn, around the middle of the free part
        first, last = self.columns(viewer)
        self.assertGreater(first, 359)
        self.assertLess(abs((first + last) / 2 - free), 60)
        viewer.key("Tab")  # without the panel the middle is the window's
        viewer.key("Home")
        viewer.key("Tab")
        first, last = self.columns(viewer)
        self.assertLess(abs((first + last) / 2 - 500), 60)
        self.quit(viewer)

    def test_begins_folded_in_a_small_window(self):
        scene = self.tmp / "plain.gltf"
        triangle(scene)
        # The title, Renderer, Statistics, Camera, Scene, A and B, Messages.
        for width, sections in ((600, 1), (760, 7)):
            words = ("--view", "normals", "--size", f"{width}x700")
            viewer = Viewer(self, [scene, *words])
            self.addCleanup(viewer.end)
            viewer.wait_for_title(READY)
            self.assertEqual(len(self.sections(viewer)), sections)
            self.quit(viewer)


if __name__ == "__main__":
    main()

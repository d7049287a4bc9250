# SPDX-License-Identifier: MIT
"""Controls of the panel: the time of animations, and material variants."""
from animated_scene import SECONDS, animated
from panel import BAR, CONTROL, MIDDLE, TEXT, PanelTest
from viewer import main


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

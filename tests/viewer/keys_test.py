# SPDX-License-Identifier: MIT
"""Keys that go back, look along axes, play animations and show messages."""
from panel_test import SECONDS, animated
from viewer import CORNELL, OBJECTS, ViewerTest, main


class KeysTest(ViewerTest):
    def test_ways_back(self):
        viewer = self.open(OBJECTS, "--spp", "1", "--sky", "--view", "normals")
        first = viewer.wait_for_still()
        viewer.key("7")
        top = viewer.wait_for_still_other_than(first)
        viewer.key("3")
        right = viewer.wait_for_still_other_than(top)
        self.assertNotEqual(right, first)
        for keys, expected in ((("Control_L", "z"), top), (("Control_L", "z"), first), (("Control_L", "Shift_L", "z"), top),
                               (("Return", ), first)):
            viewer.key(*keys)
            viewer.wait_for_picture(expected)
        viewer.key("7")
        viewer.wait_for_picture(top)
        viewer.key("Control_L", "7")  # from below
        below = viewer.wait_for_still_other_than(top)
        viewer.key("Home")
        viewer.wait_for_picture(below)
        self.quit(viewer)

    def test_marks_and_help(self):
        viewer = self.open(CORNELL, "--spp", "1", "--view", "normals")
        plain = viewer.wait_for_still()
        viewer.click(80, 90)
        viewer.wait_for_still_other_than(plain)
        viewer.key("Escape")
        viewer.wait_for_picture(plain)
        viewer.key("F1")
        viewer.wait_for_still_other_than(plain)
        viewer.key("F1")
        viewer.wait_for_picture(plain)
        viewer.key("space")
        viewer.wait_for_line("the scene has no animation")
        self.quit(viewer)

    def test_messages_lie_over_the_picture(self):
        viewer = self.open(CORNELL, "--spp", "1", "--view", "normals", environment={"METAMARCH_MESSAGE_SECONDS": "5"})
        viewer.key("c")
        viewer.wait_for_line("--camera.*")
        with_message = viewer.screenshot()
        viewer.wait_for_other_than(with_message)
        self.quit(viewer)

    def test_play(self):
        scene = self.tmp / "animated.gltf"
        animated(scene)
        words = ("--spp", "1", "--view", "normals", "--eye", "0.5,0.5,2", "--target", "0.5,0.5,0")
        viewer = self.open(scene, *words)
        first = viewer.wait_for_still()
        viewer.key("space")
        viewer.wait_for_other_than(first)
        viewer.key("space")
        paused = viewer.wait_for_still()
        self.assertNotEqual(paused, first)
        for _ in range(int(SECONDS * 24) + 1):
            viewer.key("Left")
            viewer.settle()
        viewer.wait_for_picture(first)
        self.quit(viewer)


if __name__ == "__main__":
    main()

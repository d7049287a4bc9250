# SPDX-License-Identifier: MIT
"""A window without a scene: files dropped on it, and the list of recent files."""
import time

from viewer import CORNELL, ViewerTest, main

MIDDLE_OF_FIRST_FILE = (160, 128)  # in a window of 320x240 with one recent file, below the line of words


class EmptyTest(ViewerTest):
    def setUp(self):
        super().setUp()
        self.state = self.tmp.parent / "state"
        self.environment["XDG_STATE_HOME"] = str(self.state)

    def shown(self, viewer):
        """Waits until an empty window shows what it has to say, and returns the picture."""
        viewer.wait_until("a picture", lambda: any(viewer.screenshot()[2]))
        before = None
        while before != (before := viewer.screenshot()):
            time.sleep(0.1)
        return before

    def recent(self):
        return (self.state / "metamarch/recent_scenes").read_text().splitlines()

    def test_scenes_and_maps_are_taken(self):
        viewer = self.open(None, "--spp", "1")
        invitation = self.shown(viewer)
        broken = self.tmp / "broken.glb"
        broken.write_text("no scene")
        viewer.drop(broken)
        viewer.wait_for_line(r".*broken\.glb: .*")
        viewer.wait_for_title("metamarch")
        viewer.wait_for_picture(invitation)
        self.succeed("render", CORNELL, "-o", "light.exr", "--size", "8x4", "--spp", "1", "--quiet")
        light = self.tmp / "light.exr"
        viewer.drop(light)
        viewer.wait_for_line(rf"{light} lights the next scene")
        viewer.drop(CORNELL)
        viewer.wait_for_title(r"cornell\.glb - path, 1 of 1 samples - meta_table - metamarch")
        self.assert_shows(viewer, self.render(CORNELL, "--spp", "1", "--env", light))
        self.quit(viewer)
        self.assertEqual(self.recent(), [str(CORNELL)])  # not the broken one

    def test_a_recent_file_opens(self):
        (self.state / "metamarch").mkdir(parents=True)
        (self.state / "metamarch/recent_scenes").write_text(f"{CORNELL}\n/absent/scene.glb\n")
        viewer = self.open(None, "--spp", "1", size="320x240")
        invitation = self.shown(viewer)
        viewer.key("F1")  # needs no scene
        viewer.wait_for_other_than(invitation)
        viewer.key("F1")
        viewer.wait_for_picture(invitation)
        viewer.display.move(viewer.window, *MIDDLE_OF_FIRST_FILE)
        viewer.wait_for_other_than(invitation)
        viewer.click(*MIDDLE_OF_FIRST_FILE)
        viewer.wait_for_title(r"cornell\.glb - path, 1 of 1 samples - meta_table - metamarch")
        self.assert_shows(viewer, self.render(CORNELL, "--spp", "1", size="320x240"))
        self.quit(viewer)

    def test_a_camera_that_the_scene_lacks(self):
        viewer = self.open(None, "--camera", "none")
        viewer.drop(CORNELL)
        viewer.wait_for_line("there is no camera none;.*")
        viewer.wait_for_title("metamarch")
        self.quit(viewer)


if __name__ == "__main__":
    main()

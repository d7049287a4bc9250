# SPDX-License-Identifier: MIT
"""The scene's file changes while it is shown."""
import os
import shutil

from camera_test import CAMERAS
from viewer import CORNELL, OBJECTS, READY, ViewerTest, main, triangle


class ReloadTest(ViewerTest):
    @staticmethod
    def replace(scene, content):
        """Replaces the file by another one, as most programs do when they save."""
        other = scene.with_suffix(".new")
        other.write_bytes(content)
        os.replace(other, scene)

    def test_a_file_that_is_replaced(self):
        scene = self.tmp / "scene.glb"
        shutil.copyfile(CORNELL, scene)
        camera = ("--eye", "1,2,9", "--target", "0,0.5,0")
        viewer = self.open(scene, "--spp", "2", *camera)
        viewer.wait_for_samples()
        before = viewer.wait_for_still()
        self.replace(scene, OBJECTS.read_bytes())
        self.assert_shows(viewer, self.render(OBJECTS, "--spp", "2", *camera))

        broken = OBJECTS.read_bytes()[:1000]
        self.replace(scene, broken)
        viewer.wait_for_line(r".*scene\.glb: GLB length \d+ is more than the file's 1000 bytes")
        self.assert_shows(viewer, self.render(OBJECTS, "--spp", "2", *camera))
        viewer.key("r")
        viewer.wait_for_line(r".*scene\.glb: GLB length .*")

        scene.unlink()
        viewer.settle()
        shutil.copyfile(CORNELL, scene)
        self.assert_shows(viewer, before)
        viewer.key("r")
        viewer.settle()
        viewer.wait_for_title(READY)
        self.assert_shows(viewer, before)
        self.quit(viewer)

    def test_the_camera_of_the_file_goes(self):
        scene = self.tmp / "scene.gltf"
        triangle(scene, **CAMERAS)
        viewer = self.open(scene, "--spp", "2", "--background", "1,1,1")
        viewer.key("n")
        viewer.wait_for_line("camera 1 'near'")
        viewer.key("period")
        options = viewer.settle()
        self.assertEqual((options[:2], options[2]), (["--camera", "1"], "--vfov"))
        self.assert_shows(viewer, self.render(scene, "--spp", "2", "--background", "1,1,1", *options))
        triangle(scene)
        viewer.wait_until("another camera", lambda: viewer.settle()[0] == "--eye")
        viewer.wait_for_samples()
        self.assert_shows(viewer, self.render(scene, "--spp", "2", "--background", "1,1,1", *viewer.settle()))
        self.quit(viewer)


if __name__ == "__main__":
    main()

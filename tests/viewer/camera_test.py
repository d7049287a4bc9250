# SPDX-License-Identifier: MIT
"""The user moves the camera, and the key C prints the options that make the same picture without a window."""
from display import MIDDLE, RIGHT, WHEEL_UP
from viewer import CORNELL, OBJECTS, ViewerTest, main, triangle

CAMERAS = {"cameras": [{"type": "orthographic", "name": "plan",
                        "orthographic": {"xmag": 1, "ymag": 1, "znear": 0.1, "zfar": 9}},
                       {"type": "perspective", "name": "near", "perspective": {"yfov": 0.7, "znear": 0.1}}],
           "nodes": [{"mesh": 0}, {"camera": 0, "translation": [0.3, 0.4, 2]},
                     {"camera": 1, "translation": [0.2, 0.1, 1.5], "rotation": [0, 0, 0.25881905, 0.96592583]}]}


class CameraTest(ViewerTest):
    def assert_renders_alike(self, viewer, scene, *words):
        """The window, its PNG and a render with the options of the key C must be equal. Returns the options."""
        options = viewer.settle()
        viewer.wait_for_samples()
        viewer.key("p")
        saved = viewer.wait_for_line(r"saved (\S+\.png), 2 samples a pixel")[1]
        expected = self.render(scene, "--spp", "2", *options, *words)
        self.assertEqual(self.pixels(saved), expected, options)
        self.assert_shows(viewer, expected)
        return options

    def open(self, scene, *words, **others):
        return super().open(scene, "--spp", "2", *words, **others)

    def test_every_gesture_changes_the_picture(self):
        viewer = self.open(CORNELL)
        options = viewer.settle()
        self.assertEqual(options[0], "--camera")
        gestures = {
            "orbit": lambda: viewer.drag((80, 60), (110, 50)),
            "look": lambda: viewer.drag((80, 60), (85, 66), RIGHT),
            "pan": lambda: viewer.drag((80, 60), (90, 70), MIDDLE),
            "zoom": lambda: viewer.click(70, 50, button=WHEEL_UP),
            "field of view": lambda: viewer.key("period"),
            "frame all": lambda: viewer.key("Home"),
            "next camera": lambda: viewer.key("n"),
        }
        before = viewer.wait_for_still()
        for name, gesture in gestures.items():
            with self.subTest(gesture=name):
                gesture()
                now = viewer.settle()
                self.assertNotEqual(now, options)
                options = now
                after = viewer.wait_for_still()
                self.assertNotEqual(after, before)
                before = after
        viewer.display.hold("w", True)
        viewer.wait_until("flight", lambda: viewer.settle() != options)
        viewer.display.hold("w", False)
        self.assert_renders_alike(viewer, CORNELL)
        self.quit(viewer)

    def test_perspective(self):
        viewer = self.open(OBJECTS, "--vfov", "30")
        viewer.drag((80, 60), (60, 71))
        self.assert_renders_alike(viewer, OBJECTS)
        self.quit(viewer)

    def test_a_lens(self):
        viewer = self.open(CORNELL)
        viewer.click(80, 70, "Control_L")
        options = self.assert_renders_alike(viewer, CORNELL)
        self.assertIn("--aperture", options)
        self.assertIn("--focus-distance", options)
        viewer.drag((80, 60), (66, 60))
        self.assert_renders_alike(viewer, CORNELL)
        self.quit(viewer)

    def test_parallel_rays(self):
        viewer = self.open(CORNELL, "--eye", "0.1,0.2,3", "--target", "0,0,0", "--orthographic", "2.2")
        viewer.drag((80, 60), (90, 65))
        viewer.click(100, 30, button=WHEEL_UP)
        options = self.assert_renders_alike(viewer, CORNELL)
        self.assertIn("--orthographic", options)
        self.quit(viewer)

    def test_a_panorama(self):
        viewer = self.open(CORNELL, "--panorama", "--eye", "0.1,0.2,0.3", "--target", "0,0,-1")
        viewer.drag((80, 60), (90, 65))
        options = self.assert_renders_alike(viewer, CORNELL)
        self.assertIn("--panorama", options)
        self.quit(viewer)

    def test_cameras_of_the_file(self):
        scene = self.tmp / "cameras.gltf"
        triangle(scene, **CAMERAS)
        light = ("--background", "1,1,1")
        viewer = self.open(scene, *light)
        self.assertEqual(self.assert_renders_alike(viewer, scene, *light), ["--camera", "0"])
        viewer.drag((80, 60), (90, 65))
        options = self.assert_renders_alike(viewer, scene, *light)
        self.assertIn("--orthographic", options)
        viewer.key("n")
        viewer.wait_for_line(r"camera 0 'plan'")
        viewer.key("n")
        viewer.wait_for_line(r"camera 1 'near'")
        self.assertEqual(self.assert_renders_alike(viewer, scene, *light), ["--camera", "1"])
        viewer.drag((80, 60), (85, 60))  # leans to a side
        self.assert_renders_alike(viewer, scene, *light)
        self.quit(viewer)


if __name__ == "__main__":
    main()

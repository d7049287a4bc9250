# SPDX-License-Identifier: MIT
"""A and B: views that are kept, and flipped without tracing again."""
from viewer import CORNELL, OBJECTS, READY, ViewerTest, main


class KeptTest(ViewerTest):
    def flip(self, viewer, name):
        viewer.read = len(viewer.stdout())
        viewer.key("j")
        viewer.wait_for_line(name)
        viewer.wait_for_title(f".* - {name} as it was kept - .*" if len(name) == 1 else ".* samples - .*")

    def keep(self, viewer, name):
        viewer.read = len(viewer.stdout())
        viewer.key(*([] if name == "A" else ["Shift_L"]), "k")
        viewer.wait_for_line(f"kept as {name}")

    def test_flips_pictures(self):
        viewer = self.open(CORNELL, "--spp", "3")
        viewer.read = len(viewer.stdout())
        viewer.key("j")
        viewer.wait_for_line("nothing is kept.*")
        viewer.wait_for_samples()
        first = viewer.wait_for_still()
        self.assertEqual(first, self.render(CORNELL, "--spp", "3"))
        self.keep(viewer, "A")
        viewer.drag((80, 60), (110, 70))
        viewer.key("equal")
        viewer.wait_for_samples()
        moved = viewer.wait_for_still()
        self.assertNotEqual(moved, first)
        camera = viewer.camera_options()
        self.flip(viewer, "A")
        self.assert_shows(viewer, first)
        self.flip(viewer, "the present view")
        self.assert_shows(viewer, moved)
        self.assertRegex(viewer.title, r", 3 of 3 samples")  # it has not begun anew
        self.keep(viewer, "B")

        viewer.key("v")  # a debug view is the present one
        viewer.wait_for_still_other_than(moved)
        self.flip(viewer, "A")
        self.assert_shows(viewer, first)
        self.flip(viewer, "B")
        self.assert_shows(viewer, moved)
        self.assertEqual(viewer.camera_options(), camera)
        viewer.read = len(viewer.stdout())
        viewer.key("p")
        self.assertEqual(self.pixels(viewer.wait_for_line(r"saved (.*)")[1]), moved)
        viewer.key("Control_L", "s")
        viewer.wait_for_line("of a kept view there is no film: .*")
        self.flip(viewer, "A")
        self.quit(viewer)

    def test_goes_on_from_a_kept_view(self):
        viewer = self.open(CORNELL, "--spp", "3")
        viewer.wait_for_samples()
        self.keep(viewer, "A")
        kept = viewer.camera_options()
        viewer.drag((80, 60), (130, 80))
        viewer.key("h")
        viewer.settle()
        self.flip(viewer, "A")
        viewer.key("equal")  # with the camera and the view of A
        viewer.wait_for_samples()
        self.assertEqual(viewer.camera_options(), kept)
        self.assert_shows(viewer, self.render(CORNELL, "--spp", "3", "--exposure", "0.25"))
        self.flip(viewer, "A")
        self.assert_shows(viewer, self.render(CORNELL, "--spp", "3"))
        viewer.key("Escape")
        viewer.wait_for_title(".* samples - .*")
        self.assert_shows(viewer, self.render(CORNELL, "--spp", "3", "--exposure", "0.25"))
        self.quit(viewer)

    def test_stretches_and_is_forgotten(self):
        viewer = self.open(CORNELL, "--spp", "1")
        viewer.wait_for_samples()
        self.keep(viewer, "A")
        kept = viewer.wait_for_still()
        viewer.key("v")
        viewer.wait_for_still_other_than(kept)
        self.flip(viewer, "A")
        viewer.resize(320, 240)
        twice = b"".join(row * 2 for row in (b"".join(kept[2][i:i + 3] * 2 for i in range(y * 480, y * 480 + 480, 3))
                                             for y in range(120)))
        self.assert_shows(viewer, (320, 240, twice))
        viewer.drop(OBJECTS)  # another scene
        viewer.wait_for_title(f"objects.glb {READY}")
        viewer.settle()
        viewer.read = len(viewer.stdout())
        viewer.key("j")
        viewer.wait_for_line("nothing is kept.*")
        self.quit(viewer)


if __name__ == "__main__":
    main()

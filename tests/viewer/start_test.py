# SPDX-License-Identifier: MIT
"""A window opens, takes all samples, and shows the same picture as `metamarch render`."""
from viewer import CORNELL, DEGENERATE, OBJECTS, ViewerTest, main


class StartTest(ViewerTest):
    def test_the_window_shows_the_headless_picture(self):
        for scene, *words in ((CORNELL, ), (OBJECTS, "--sun", "1,1,0.5"), (DEGENERATE, "--integrator", "ao")):
            with self.subTest(scene=scene.name, words=words):
                viewer = self.open(scene, "--spp", "8", *words)
                integrator = words[1] if "--integrator" in words else "path"
                viewer.wait_for_title(rf"{scene.name} - {integrator}, 8 of 8 samples - meta_table - metamarch")
                self.assert_shows(viewer, self.render(scene, "--spp", "8", *words))
                self.quit(viewer)


if __name__ == "__main__":
    main()

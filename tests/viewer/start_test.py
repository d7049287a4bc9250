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

    def test_the_window_says_that_a_kernel_is_made(self):
        """Without a cache the driver compiles for half a second, in which the window shows the frame before."""
        viewer = self.open(CORNELL, "--spp", "4", environment={"MESA_SHADER_CACHE_DISABLE": "true"})
        viewer.wait_for_title(r"cornell.glb - path, 0 of 4 samples - meta_table - preparing - metamarch")
        viewer.wait_for_title(r"cornell.glb - path, 4 of 4 samples - meta_table - metamarch")
        self.assert_shows(viewer, self.render(CORNELL, "--spp", "4"))
        self.quit(viewer)


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: MIT
"""A window that changes its size, and one that is minimised for a while."""
from viewer import CORNELL, ViewerTest, main


class ResizeTest(ViewerTest):
    def test_every_size_shows_the_headless_picture(self):
        viewer = self.open(CORNELL, "--spp", "2")
        for width, height in ((200, 90), (61, 97), (320, 240)):
            expected = self.render(CORNELL, "--spp", "2", size=f"{width}x{height}")
            viewer.resize(width, height)
            titles = set()

            def shows(picture=expected, seen=titles):
                seen.add(viewer.title)
                return viewer.screenshot() == picture

            viewer.wait_until("the headless picture", shows)
            self.assertFalse([title for title in titles if "preparing" in title])  # the kernel is there
        self.quit(viewer)

    def test_many_sizes_in_a_row(self):
        viewer = self.open(CORNELL, "--spp", "2")
        viewer.wait_for_samples()
        first = viewer.wait_for_still()
        for i in range(40):
            viewer.resize(1 + 37 * i % 300, 1 + 53 * i % 200)
            if i % 8 == 0:
                viewer.settle()
        viewer.resize(160, 120)
        self.assert_shows(viewer, first)
        self.quit(viewer)

    def test_a_window_that_is_hidden_and_shown_again(self):
        """Hides the window as window managers of X do when they minimise it."""
        viewer = self.open(CORNELL, "--spp", "2")
        viewer.wait_for_samples()
        first = viewer.wait_for_still()
        for size in ((160, 120), (100, 100), (160, 120)):
            viewer.hide()
            viewer.resize(*size)
            viewer.show()
            viewer.settle()
        self.assert_shows(viewer, first)
        self.quit(viewer)


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: MIT
"""Windows of drivers that behave worse than lavapipe's, by the layer tests/vulkan/fault_layer."""
import os

from viewer import CORNELL, ViewerTest, main


def faults(text):
    return {"METAMARCH_FAULTS": text, "VK_INSTANCE_LAYERS": "VK_LAYER_METAMARCH_faults",
            "VK_ADD_LAYER_PATH": os.environ["METAMARCH_FAULT_LAYER"]}


class FaultsTest(ViewerTest):
    def test_the_window_shows_its_picture(self):
        picture = self.render(CORNELL, "--spp", "4")
        for text in ("acquireTimesOut=3", "acquireOutOfDate=5", "suboptimal=1", "noOpaqueAlpha=1",
                     "acquireOutOfDate=5,noSizeUntil=8", "timestampBits=0", "stampsAreEqual=1"):
            with self.subTest(faults=text):
                viewer = self.open(CORNELL, "--spp", "4", environment=faults(text))
                viewer.wait_for_title(r"cornell.glb - path, 4 of 4 samples - meta_table - metamarch")
                self.assert_shows(viewer, picture)
                self.quit(viewer)

    def test_a_window_of_ten_bits_a_colour(self):
        line = self.refuse(4, "view", CORNELL, DISPLAY=self.display.name, **faults("tenBitOnly=1"))
        self.assertRegex(line, r"\A.*: this window takes no 8-bit sRGB pictures\Z")

    def test_a_film_larger_than_a_buffer_may_be(self):
        """The film takes 2.1 MB, so it lies in three bands. The window has its full size all the same."""
        picture = self.render(CORNELL, "--spp", "4")
        viewer = self.open(CORNELL, "--spp", "4", environment=faults("storageRange=800000"))
        viewer.wait_for_title(r"cornell.glb - path, 4 of 4 samples - meta_table - metamarch")
        self.assert_shows(viewer, picture)
        viewer.key("p")
        name = viewer.wait_for_line(r"saved (.*), 4 samples a pixel")[1]
        self.assertEqual(self.pixels(name), picture)
        self.quit(viewer)

    def test_a_film_that_fits_into_little_memory(self):
        """The film of 1 MiB that little memory leaves holds half of the window's width and height. It is shown enlarged."""
        width, height, pixels = self.render(CORNELL, "--spp", "4", size="80x60")
        rows = [b"".join(pixels[at:at + 3] * 2 for at in range(3 * width * y, 3 * width * (y + 1), 3)) for y in range(height)]
        viewer = self.open(CORNELL, "--spp", "4", environment=faults("deviceHeap=8388608"))
        viewer.wait_for_title(r"cornell.glb - path, 4 of 4 samples - meta_table - metamarch")
        self.assert_shows(viewer, (2 * width, 2 * height, b"".join(row * 2 for row in rows)))
        self.quit(viewer)


if __name__ == "__main__":
    main()

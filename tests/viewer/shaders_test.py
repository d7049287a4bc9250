# SPDX-License-Identifier: MIT
"""Shaders that change while the viewer uses them."""
import shutil

from viewer import CORNELL, SOURCE, ViewerTest, main


class ShadersTest(ViewerTest):
    def test_a_kernel_is_broken_mended_and_changed(self):
        folder = self.tmp / "shaders"
        shutil.copytree(SOURCE / "shaders", folder)
        kernel = folder / "kernels" / "path.glsl"
        good = kernel.read_text()
        bad = good.replace("void main() {", "void main() {\n    nothing of the kind;")
        dark = good.replace("sum = endSample(", "taken.path.radiance *= 0.25; sum = endSample(")
        self.assertEqual(len({good, bad, dark}), 3)

        viewer = self.open(CORNELL, "--spp", "2", "--shaders", folder)
        viewer.wait_for_samples()
        before = viewer.wait_for_still()
        line = 1 + bad[:bad.index("nothing of the kind")].count("\n")
        kernel.write_text(bad)
        viewer.wait_for_line(rf"shader error: .*kernels/path\.glsl:{line}: .*")
        self.assertNotEqual(viewer.wait_for_still(), before)  # a panel shows the whole error
        viewer.drag((10, 60), (-20, 65))  # the old kernel is still in use
        options = viewer.settle()
        viewer.wait_for_samples()

        kernel.write_text(good)
        viewer.wait_for_line("shaders compiled anew")
        moved = self.render(CORNELL, "--spp", "2", *options)
        self.assert_shows(viewer, moved)

        kernel.write_text(dark)
        viewer.wait_for_line("shaders compiled anew")
        viewer.wait_for_samples()
        darker = viewer.wait_for_still()
        self.assertLess(sum(darker[2]), 0.9 * sum(moved[2]))
        viewer.key("t")  # the other traversal also uses the folder's shaders
        viewer.wait_for_line("shaders compiled anew")
        viewer.wait_for_title(r".* - path, 2 of 2 samples - rectilinear_table - metamarch")
        self.assert_shows(viewer, darker)
        self.quit(viewer)

    def test_a_folder_without_shaders(self):
        empty = self.tmp / "empty"
        empty.mkdir()
        viewer = self.open(CORNELL, "--spp", "2", "--shaders", empty)
        (empty / "file.glsl").write_text("")
        viewer.wait_for_line(r"shader error: .*")
        viewer.wait_for_samples()
        self.quit(viewer)


if __name__ == "__main__":
    main()

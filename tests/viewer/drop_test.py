# SPDX-License-Identifier: MIT
"""Files dropped on the window: scenes, environment maps, and other files."""
import subprocess

from panel_test import animated
from viewer import CORNELL, OBJECTS, ViewerTest, main, triangle


class DropTest(ViewerTest):
    def make_map(self, name):
        subprocess.run(["oiiotool", "--pattern", "constant:color=1,2,0.5", "16x8", "3", "-o", name], cwd=self.tmp,
                       check=True, capture_output=True)
        return self.tmp / name

    def test_a_scene_and_a_map(self):
        viewer = self.open(CORNELL, "--spp", "2")
        viewer.drop(OBJECTS)
        viewer.wait_for_title(r"objects\.glb - path, 2 of 2 samples - meta_table - metamarch")
        self.assert_shows(viewer, self.render(OBJECTS, "--spp", "2"))
        light = self.make_map("light with a space.hdr")
        viewer.drop(light)
        self.assert_shows(viewer, self.render(OBJECTS, "--spp", "2", "--env", light))
        viewer.drop(CORNELL)  # in the light of the map
        viewer.wait_for_title(r"cornell\.glb - path, 2 of 2 samples - meta_table - metamarch")
        self.assert_shows(viewer, self.render(CORNELL, "--spp", "2", "--env", light))
        self.quit(viewer)

    def test_what_cannot_be_read_changes_nothing(self):
        viewer = self.open(CORNELL, "--spp", "2")
        viewer.wait_for_samples()
        before = viewer.wait_for_still()
        for name in ("prose.glb", "prose.txt", "prose.hdr", "prose.exr", "absent.glb"):
            with self.subTest(name=name):
                file = self.tmp / name
                if name != "absent.glb":
                    file.write_text("It was a dark and stormy night.\n")
                viewer.drop(file)
                viewer.wait_for_line(rf".*{name}.*")
                viewer.wait_for_title(r"cornell\.glb - path, 2 of 2 samples - meta_table - metamarch")
                self.assert_shows(viewer, before)
        viewer.drop(OBJECTS)  # the refused files have no effect
        viewer.wait_for_title(r"objects\.glb - path, 2 of 2 samples - meta_table - metamarch")
        self.quit(viewer)

    def test_a_scene_with_less_to_choose_from(self):
        first = self.tmp / "animated.gltf"
        animated(first)
        viewer = self.open(first, "--spp", "2", "--time", "1", "--animation", "walk", "--variant", "red")
        plain = self.tmp / "plain.gltf"
        triangle(plain)
        viewer.drop(plain)
        viewer.wait_for_line(r"warning: .*plain\.gltf: no light; .*")
        viewer.wait_for_title(r"plain\.gltf - path, 2 of 2 samples - meta_table - metamarch")
        self.assert_shows(viewer, self.render(plain, "--spp", "2"))
        viewer.key("n")
        viewer.wait_for_line("the scene has no cameras")
        self.quit(viewer)


if __name__ == "__main__":
    main()

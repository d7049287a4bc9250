# SPDX-License-Identifier: MIT
"""Every glTF of the shared scenes, path-traced under a map on the device and on the CPU: software drivers draw the CPU's
picture to the bit, llvmpipe with vectors of 128, 256 and 512 bits. tools/test --long runs it.
"""
from program import ProgramTest, main, shared_scene

WIDTHS = (128, 256, 512)  # bits
INPUT_REFUSED = 3


class SharedScenesTest(ProgramTest):
    def draw(self, scene, name, backend, **environment):
        """Returns False for a scene that the program refuses."""
        result = self.run_program("render", scene, "-o", name, "--size", "48x36", "--spp", "2", "--max-bounces", "4", "--quiet",
                                  "--env", shared_scene("hdr/royal_esplanade_1k.hdr"), "--backend", backend, **environment)
        self.assertIn(result.returncode, (0, INPUT_REFUSED), result.stderr)
        return result.returncode == 0

    def test_device_draws_what_the_cpu_draws(self):
        folder = shared_scene("gltf")
        scenes = [file for file in sorted([*folder.rglob("*.gltf"), *folder.rglob("*.glb")]) if "malformed" not in file.parts]
        drawn = 0
        for scene in scenes:
            if not self.draw(scene, "cpu.exr", "cpu"):
                continue
            drawn += 1
            for width in WIDTHS:
                with self.subTest(scene=scene.relative_to(folder), width=width):
                    # Mesa's cache does not know the width.
                    cache = self.tmp / f"cache-{width}"
                    (self.tmp / "device.exr").unlink(missing_ok=True)
                    drew = self.draw(scene, "device.exr", "gpu", LP_NATIVE_VECTOR_WIDTH=str(width), XDG_CACHE_HOME=str(cache),
                                     MESA_SHADER_CACHE_DIR=str(cache))
                    self.assertTrue(drew)
                    self.succeed("compare", "device.exr", "cpu.exr", "--max-abs", "0")
        self.assertGreater(drawn, len(scenes) / 2)
        print(f"{drawn} of {len(scenes)} scenes are drawn, the others refused")


if __name__ == "__main__":
    main()

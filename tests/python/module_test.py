# SPDX-License-Identifier: MIT
"""Tests the Python module against the program, which writes the same bytes, and against closed forms."""
import inspect
import json
import math
import os
import platform
import re
import signal
import struct
import subprocess
import sys
import threading
import time
import unittest
import warnings
from pathlib import Path

import program

os.environ["XDG_CACHE_HOME"] = str(program.CACHE)  # the drivers' caches, before one is opened

import metamarch  # noqa: E402
import numpy as np  # noqa: E402
from metamarch import _option_types, _options  # noqa: E402

CORNELL = program.SCENES / "cornell.glb"
# A square of 2 x 2 around the origin, seen from +z.
CORNERS = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]
SQUARE = [(0, 1, 2), (0, 2, 3)]
MISS = 4294967295


def square_before_camera(**options):
    """Renders a square that fills the picture, of four pixels, without other light."""
    scene = metamarch.from_arrays(CORNERS, SQUARE, **options)
    return metamarch.render(scene, size=(2, 2), spp=1, backend="cpu", background=(0, 0, 0), eye=(0, 0, 1),
                            target=(0, 0, 0), orthographic=2)


class Module(program.ProgramTest):
    @classmethod
    def setUpClass(cls):
        cls.cornell = metamarch.load(CORNELL)

    def small(self, **options):
        return metamarch.render(self.cornell, **{"size": (12, 8), "spp": 1, "backend": "cpu", **options})

    def bytes_of(self, film, name="module.exr", **options):
        path = self.tmp / name
        film.save(path, **options)
        return path.read_bytes()

    def program_bytes(self, name, *words):
        self.succeed("render", CORNELL, "-o", name, "--quiet", *words)
        return (self.tmp / name).read_bytes()

    def assert_refused(self, kind, pattern, call, *arguments, **options):
        with self.assertRaisesRegex(kind, pattern) as raised:
            call(*arguments, **options)
        self.assertNotIn("\n", str(raised.exception))

    # The same bytes.

    def test_same_bytes_on_both_backends(self):
        for backend in ("gpu", "cpu"):
            film = metamarch.render(self.cornell, size=(12, 8), spp=17, max_bounces=2, backend=backend)
            words = ("--size", "12x8", "--spp", "17", "--max-bounces", "2", "--backend", backend)
            self.assertEqual(self.bytes_of(film), self.program_bytes("program.exr", *words), backend)

    def test_same_bytes_of_options(self):
        film = self.small(aov=["P", "id.mesh", "cryptomatte"], eye=np.float32([0, 1, 3]), target=[0, 1, 0], vfov=40.5,
                          crop=(2, 1, 9, 7), clamp=2.5, filter="tent", seed=np.int64(3))
        words = ("--size", "12x8", "--spp", "1", "--backend", "cpu", "--aov", "P,id.mesh,cryptomatte", "--eye", "0,1,3",
                 "--target", "0,1,0", "--vfov", "40.5", "--crop", "2,1,9,7", "--clamp", "2.5", "--filter", "tent", "--seed",
                 "3", "--half")
        self.assertEqual(self.bytes_of(film, half=True), self.program_bytes("program.exr", *words))

    def test_same_png_and_rgba8(self):
        film = self.small()
        words = ("--size", "12x8", "--spp", "1", "--backend", "cpu", "--exposure", "1.5")
        self.assertEqual(self.bytes_of(film, "module.png", exposure=1.5), self.program_bytes("program.png", *words))
        picture = self.read_picture("program.png")
        rgba = film.rgba8(exposure=1.5)
        for i, channel in enumerate("RGB"):
            np.testing.assert_array_equal(rgba[:, :, i], np.rint(np.array(picture[channel]) * 255))
        self.assertTrue((rgba[:, :, 3] == 255).all())

    def test_transparent_rgba8_has_alpha(self):
        film = self.small(transparent=True, eye=(0, 1, 9), target=(0, 1, 0))
        alpha = film.rgba8()[:, :, 3]
        np.testing.assert_array_equal(alpha, np.rint(np.clip(film["A"], 0, 1) * 255))
        self.assertLess(alpha.min(), 255)

    def test_scene_from_bytes_is_that_of_standard_input(self):
        film = metamarch.render(metamarch.load(CORNELL.read_bytes()), size=(4, 4), spp=1, backend="cpu")
        words = ("render", "-", "-o", "program.exr", "--size", "4x4", "--spp", "1", "--backend", "cpu", "--quiet")
        subprocess.run([program.metamarch(), *words], cwd=self.tmp, input=CORNELL.read_bytes(), check=True)
        self.assertEqual(self.bytes_of(film), (self.tmp / "program.exr").read_bytes())

    def test_same_bytes_of_a_shadow_catcher(self):
        plain = self.bytes_of(self.small())
        for backend, ground in (("cpu", "auto"), ("gpu", "y=-0.25"), ("cpu", "1")):
            film = self.small(shadow_catcher=ground, transparent=True, aov="shadow", backend=backend)
            words = ("--size", "12x8", "--spp", "1", "--backend", backend, "--shadow-catcher", ground, "--transparent", "--aov", "shadow")
            self.assertEqual(self.bytes_of(film), self.program_bytes("program.exr", *words), ground)
        self.assertEqual(self.bytes_of(self.small()), plain)
        film = self.small(shadow_catcher="auto", catcher_reflection=0.1, backend="cpu")
        words = ("--size", "12x8", "--spp", "1", "--backend", "cpu", "--shadow-catcher", "auto", "--catcher-reflection", "0.1")
        self.assertEqual(self.bytes_of(film), self.program_bytes("program.exr", *words))
        self.assert_refused(metamarch.InvalidArgument, "^there is no material floor;.* [(]shadow_catcher[)]", self.small,
                            shadow_catcher="floor")

    def test_same_bytes_of_motion(self):
        file = self.tmp / "moving.gltf"
        program.write_moving(file)
        text = file.read_bytes() + b" " * (-file.stat().st_size % 4)
        glb = struct.pack("<4s3I4s", b"glTF", 2, 20 + len(text), len(text), b"JSON") + text
        options = {"size": (12, 8), "aov": "motion", "integrator": "primary", "backend": "cpu"}
        words = ("--size", "12x8", "--aov", "motion", "--integrator", "primary", "--backend", "cpu", "--time", "0.1")
        scene = metamarch.load(file, time=0.1)
        for more, frames in (({}, ()), ({"frame_rate": 12}, ("--frame-rate", "12"))):
            film = metamarch.render(scene, **options, **more)
            self.succeed("render", file, "-o", "program.exr", "--quiet", *words, *frames)
            self.assertEqual(self.bytes_of(film), (self.tmp / "program.exr").read_bytes())
            of_bytes = metamarch.render(metamarch.load(glb, time=0.1), **options, **more)
            np.testing.assert_array_equal(of_bytes["motion"], film["motion"])
            self.assertGreater(film["motion.X"].max(), 0)
        self.assert_refused(metamarch.InvalidArgument, "time", metamarch.render, metamarch.load(file), **options)

    def test_same_bytes_whatever_the_rounding(self):
        # NumPy converts in the rounding of the process, so the rays are floats before. The second process rounds upward
        # from the beginning.
        code = ("import ctypes, sys, numpy, metamarch\n"
                "origins, directions = numpy.float32([(0, 0.7, 3)]), numpy.float32([(0.1, 0.1, -1)])\n"
                "libm = ctypes.CDLL('libm.so.6')\n"
                "libm.fesetround(int(sys.argv[2]))\n"
                "scene = metamarch.load(sys.argv[1])\n"
                "hits = metamarch.Tracer(scene).trace(origins, directions)\n"
                "film = metamarch.render(scene, size=(12, 8), spp=2, backend='cpu')\n"
                "film.save(sys.argv[3])\n"
                "assert metamarch.compare(sys.argv[3], film)\n"
                "print([part.tobytes() for part in hits], film.rgba8().tobytes(), libm.fegetround() == int(sys.argv[2]))\n")
        upward = {"x86_64": 0x800, "aarch64": 0x400000}[platform.machine()]  # FE_UPWARD of fenv.h
        printed = []
        for rounding, name in ((0, "nearest.exr"), (upward, "upward.exr")):
            done = subprocess.run([sys.executable, "-c", code, CORNELL, str(rounding), name], cwd=self.tmp,
                                  capture_output=True, text=True, check=False)
            self.assertEqual(done.stderr, "")
            printed.append((done.stdout, (self.tmp / name).read_bytes()))
        self.assertTrue(printed[0][0].endswith("True\n"))
        self.assertEqual(printed[0], printed[1])

    def test_without_a_driver_the_processor_renders(self):
        code = ("import sys, metamarch; film = metamarch.render(metamarch.load(sys.argv[1]), size=(4, 4), spp=1);"
                "film.save('module.exr'); print(film.device)")
        environment = {**os.environ, "VK_DRIVER_FILES": "/nonexistent", "VK_ICD_FILENAMES": "/nonexistent"}
        done = subprocess.run([sys.executable, "-c", code, CORNELL], cwd=self.tmp, env=environment, capture_output=True,
                              text=True, check=False)
        self.assertEqual((done.stdout, done.stderr), ("cpu\n", ""))
        words = ("--size", "4x4", "--spp", "1", "--backend", "cpu")
        self.assertEqual((self.tmp / "module.exr").read_bytes(), self.program_bytes("program.exr", *words))

    def test_software_drivers_render_only_where_they_are_wanted(self):
        chosen = re.search(r"^\*.*?^ +type +(\w+)", self.succeed("devices"), re.DOTALL | re.MULTILINE)
        isSoftware = chosen[1] == "cpu"
        film = metamarch.render(self.cornell, size=(4, 4), spp=1)
        self.assertEqual(film.device == "cpu", isSoftware)
        self.assertNotEqual(metamarch.render(self.cornell, size=(4, 4), spp=1, traversal="kd_ropes").device, "cpu")
        self.assertNotEqual(self.small(backend="gpu").device, "cpu")

    # Films.

    def test_arrays_are_those_of_the_file(self):
        film = self.small(aov="all")
        self.bytes_of(film)
        picture = self.read_picture("module.exr")
        self.assertEqual(set(film.channels), set(picture))
        for channel, rows in picture.items():
            array = film[channel]
            self.assertEqual((array.shape, array.dtype.kind), ((8, 12), "u" if isinstance(rows[0][0], int) else "f"))
            np.testing.assert_array_equal(array, np.array(rows, array.dtype), channel)

    def test_arrays_are_not_copies(self):
        film = self.small()
        rgb = film.rgb
        self.assertEqual((rgb.shape, film["N"].shape, film["id"].shape), ((8, 12, 3), (8, 12, 3), (8, 12, 1)))
        self.assertTrue(np.shares_memory(rgb, film["G"]))
        before = rgb.copy()
        del film
        np.testing.assert_array_equal(rgb, before)  # the array keeps the film
        with self.assertRaises(ValueError):
            rgb[0, 0, 0] = 1
        with self.assertRaisesRegex(KeyError, "nothing: the film has R, G, B, A"):
            self.small()["nothing"]

    def test_numpy_booleans(self):
        for value in (True, False):
            one, other = (self.small(transparent=flag, eye=(0, 1, 9), target=(0, 1, 0)).rgba8() for flag in (value, np.bool_(value)))
            np.testing.assert_array_equal(one, other)
            self.assertEqual(other[:, :, 3].min() < 255, value)
        for value in (True, np.True_):
            self.assert_refused(metamarch.InvalidArgument, "^spp=(np.)?True_?: give a value$", self.small, spp=value)

    def test_group_has_the_channels_with_one_more_word(self):
        code = ("import sys, metamarch\n"
                "film = metamarch.render(metamarch.load(sys.argv[1]), size=(4, 3), spp=1, backend='cpu', denoise=True,\n"
                "                        aov=['direct', 'indirect'])\n"
                "print([film[name].shape for name in ('noisy', 'noisy.direct', 'direct')], 'noisy.indirect.R' in film.channels)")
        environment = {**os.environ, "LD_LIBRARY_PATH": os.environ["METAMARCH_FAKE_DENOISER"]}
        done = subprocess.run([sys.executable, "-c", code, CORNELL], cwd=self.tmp, env=environment, capture_output=True,
                              text=True, check=False)
        self.assertEqual((done.stdout, done.stderr), ("[(3, 4, 3), (3, 4, 3), (3, 4, 3)] True\n", ""))

    def test_matrices_project_what_the_pixels_see(self):
        film = self.small(aov=["P", "Z", "id.triangle"], integrator="primary")
        hit = film["id.triangle"] != MISS
        points = np.concatenate([film["P"][hit], np.ones((hit.sum(), 1))], axis=1)
        depth = (points @ film.world_to_camera.T)[:, 2]
        np.testing.assert_allclose(depth, film["Z"][hit], rtol=1e-5)
        ndc = points @ film.world_to_ndc.T
        rows, columns = np.nonzero(hit)
        np.testing.assert_allclose(ndc[:, 0] / ndc[:, 3], (columns + 0.5) / 12, atol=1e-5)
        np.testing.assert_allclose(ndc[:, 1] / ndc[:, 3], (rows + 0.5) / 8, atol=1e-5)

    def test_progressive_ends_with_the_picture(self):
        films = list(metamarch.progressive(self.cornell, size=(12, 8), spp=40, backend="cpu"))
        self.assertEqual([film.samples for film in films], [16, 32, 40])
        self.assertEqual([film.is_complete for film in films], [False, False, True])
        self.assertEqual(self.bytes_of(films[0]), self.bytes_of(self.small(spp=16), "whole.exr"))
        self.assertEqual(self.bytes_of(films[2]), self.bytes_of(self.small(spp=40), "whole.exr"))

    def test_progressive_on_the_device(self):
        films = list(metamarch.progressive(self.cornell, size=(12, 8), spp=20, backend="gpu"))
        self.assertEqual([film.samples for film in films], [16, 20])
        self.assertEqual(self.bytes_of(films[1]), self.bytes_of(self.small(spp=20, backend="gpu"), "whole.exr"))

    def test_control_c_ends_a_render(self):
        timer = threading.Timer(0.1, os.kill, (os.getpid(), signal.SIGINT))  # runs if render() lets other threads run
        timer.start()
        start = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            self.small(size=(64, 64), spp=1 << 24)
        self.assertLess(time.monotonic() - start, 60)
        self.assertEqual(self.small().samples, 1)

    def test_threads_share_a_scene(self):
        films = {}

        def draw(name, backend):
            films[name] = self.small(backend=backend)

        threads = [threading.Thread(target=draw, args=(i, "gpu" if i < 2 else "cpu")) for i in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for i in range(1, 4):
            self.assertTrue(metamarch.compare(films[i], films[0]), i)

    def forked(self, work):
        """Returns what `work` returns in a forked process, or the error that it raises there, as text."""
        reader, writer = os.pipe()
        child = os.fork()
        if child == 0:
            signal.alarm(60)  # ends a process that hangs
            try:
                os.write(writer, str(work()).encode())
            except Exception as error:
                os.write(writer, f"{type(error).__name__}: {error}".encode())
            finally:
                os._exit(0)
        os.close(writer)
        with os.fdopen(reader, "rb") as pipe:
            text = pipe.read().decode()
        os.waitpid(child, 0)
        return text

    def test_a_fork_keeps_its_films(self):
        film = self.small(backend="gpu")
        expected = self.bytes_of(film, "parent.exr"), self.bytes_of(film, "parent.png"), film.rgba8().tobytes()

        def work():
            files = self.bytes_of(film, "child.exr"), self.bytes_of(film, "child.png"), film.rgba8().tobytes()
            return files == expected and metamarch.compare(self.tmp / "child.exr", film).passed

        self.assertEqual(self.forked(work), "True")

    def test_a_fork_is_told_so(self):
        objects = {"scene": metamarch.load(CORNELL)}
        objects["tracer"] = metamarch.Tracer(objects["scene"], backend="gpu")
        busy = threading.Thread(target=metamarch.render, args=(objects["scene"],),
                                kwargs={"backend": "gpu", "spp": 1 << 20, "time_limit": 0.2})
        busy.start()  # holds the device and its locks, which the child cannot get
        calls = [lambda: self.small(), lambda: self.small(backend="gpu"), lambda: metamarch.load(CORNELL),
                 lambda: metamarch.Tracer(self.cornell, backend="gpu"),
                 lambda: objects["tracer"].trace([(0, 0, 0)], [(0, 0, 1)])]
        for call in calls:
            self.assertRegex(self.forked(call), '^InvalidArgument: .* forked off .* "spawn" of multiprocessing$')

        self.assertEqual(self.forked(objects.clear), "None")
        busy.join()

    def test_a_fork_ends(self):
        code = ("import os, signal, sys, metamarch\n"
                "scene = metamarch.load(sys.argv[1])\n"
                "metamarch.render(scene, size=(2, 2), spp=1, backend='gpu', integrator='primary')\n"
                "del scene\n"  # only the module keeps the device now
                "child = os.fork()\n"
                "if child == 0:\n"
                "    signal.alarm(60)\n"  # ends a process that hangs
                "else:\n"
                "    print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))\n")
        words = ["-W", "ignore::DeprecationWarning"]  # from 3.12 on Python warns of forks beside threads
        done = subprocess.run([sys.executable, *words, "-c", code, CORNELL], cwd=self.tmp, capture_output=True, text=True,
                              check=False)
        self.assertEqual((done.stdout, done.stderr), ("0\n", ""))

    def test_a_tracer_leaves_when_the_device_is_free(self):
        # Its command buffer is of the device's pool, which only one thread may use.
        for _ in range(5):
            tracer = metamarch.Tracer(self.cornell, backend="gpu")
            ends = []

            def draw():
                begin = time.monotonic()
                ends.append(begin + self.small(backend="gpu", spp=1 << 20, time_limit=0.4).seconds)

            thread = threading.Thread(target=draw)
            thread.start()
            time.sleep(0.1)  # the thread holds the device; on a busy machine perhaps not yet
            del tracer
            deleted = time.monotonic()
            thread.join()
            if deleted >= ends[0]:
                return
        self.fail("the tracer did not wait for the device")

    # Scenes.

    def test_scene_is_what_info_says(self):
        info = json.loads(self.succeed("info", CORNELL, "--json"))
        scene = self.cornell
        self.assertEqual([material.name for material in scene.materials],
                         [material["name"] for material in info["materials"]])
        self.assertEqual([camera.name for camera in scene.cameras], [camera["name"] for camera in info["cameras"]])
        self.assertEqual([light._asdict() for light in scene.lights], info["lights"])
        self.assertEqual(len(scene.triangles), info["triangles"])
        low, high = scene.bounds
        np.testing.assert_array_equal(low, scene.positions[scene.triangles].min((0, 1)))
        np.testing.assert_array_equal(high, scene.positions[scene.triangles].max((0, 1)))
        self.assertEqual(len(scene.triangle_mesh), len(scene.triangles))
        self.assertLess(scene.triangle_mesh.max(), len(scene.meshes))

    def test_camera_of_the_scene(self):
        camera = self.cornell.cameras[0]
        one = self.small(camera=camera)
        for same in (camera.name, 0, "0"):
            self.assertTrue(metamarch.compare(one, self.small(camera=same)))

    def test_emission_of_arrays(self):
        film = square_before_camera(material={
            "emissiveFactor": (0.25, 0.5, 1), "baseColorFactor": np.zeros(4),
            "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 4}}})
        np.testing.assert_array_equal(film.rgb, np.broadcast_to(np.float32([1, 2, 4]), (2, 2, 3)))

    def test_texture_of_arrays(self):
        texels = np.zeros((2, 2, 3), np.uint8)
        texels[0, 0] = (255, 0, 0)  # the upper left corner of the picture
        texels[1, 1] = (0, 255, 0)
        material = {"emissiveFactor": (1, 1, 1), "emissiveTexture": texels, "baseColorFactor": (0, 0, 0, 1)}
        film = square_before_camera(uvs=[(0, 1), (1, 1), (1, 0), (0, 0)], material=material)
        red = film["R"]
        self.assertEqual(np.unravel_index(red.argmax(), red.shape), (0, 0))
        self.assertEqual(np.unravel_index(film["G"].argmax(), red.shape), (1, 1))

    def test_meshes_keep_their_names(self):
        scene = metamarch.from_meshes([metamarch.Mesh(CORNERS, SQUARE, name="floor"), metamarch.Mesh(np.eye(3))])
        self.assertEqual([mesh.name for mesh in scene.meshes], ["floor", "mesh 1"])
        self.assertEqual(scene.triangle_mesh.tolist(), [0, 0, 1])

    def test_arrays_that_are_refused(self):
        refused = [
            (r"positions: give an array of N x 3", {"positions": [1, 2, 3]}),
            (r"positions: give an array of N x 3", {"positions": [("a", "b", "c")]}),
            (r"indices: 4 names none of 4 positions", {"indices": [(0, 1, 4)]}),
            (r"indices: -1 names none of 4 positions", {"indices": [(0, 1, -1)]}),
            (r"indices: give whole numbers", {"indices": [(0.0, 1.0, 2.0)]}),
            (r"normals: 1 rows for 4 positions", {"normals": [(0, 0, 1)]}),
            (r"material emissiveTexture: give an array of height x width x 3 or 4 of uint8",
             {"material": {"emissiveTexture": np.zeros((2, 2))}}),
            (r"a material holds what glTF cannot", {"material": {"roughnessFactor": math.nan}}),
            (r"give the material as a dictionary", {"material": "red"}),
            (r"^mesh 0: positions: position of vertex 3 is not finite$", {"positions": CORNERS[:3] + [(0, math.nan, 0)]}),
            (r"^mesh 0: positions: position of vertex 0 is not finite$", {"positions": [(math.inf, 0, 0)] + CORNERS[1:]}),
            (r"^mesh 0: positions: position of vertex 1 is not finite$",
             {"positions": [CORNERS[0], (1e300, 0, 0)] + CORNERS[2:]}),
            (r"^mesh 0: positions: position of vertex 2 is not finite$",
             {"positions": CORNERS[:2] + [(0, 0, -math.inf)], "indices": None}),
        ]
        for pattern, given in refused:
            self.assert_refused(metamarch.InvalidArgument, pattern, metamarch.from_arrays,
                                **{"positions": CORNERS, "indices": SQUARE, **given})
        self.assert_refused(metamarch.InputRefused, "arrays: .*roughnessFactor", metamarch.from_arrays, CORNERS, SQUARE,
                            material={"roughnessFactor": "rough"})

    def test_vertices_without_a_triangle_may_be_broken(self):
        with self.assertWarnsRegex(metamarch.SceneWarning, "positions of vertices that no triangle uses are not finite"):
            scene = metamarch.from_arrays(CORNERS + [(math.nan, 0, 0)], SQUARE)
        np.testing.assert_array_equal(scene.bounds, [(-1, -1, 0), (1, 1, 0)])

    def test_warnings_are_those_of_the_program(self):
        result = self.run_program("render", program.SCENES / "objects.glb", "-o", "a.exr", "--size", "2x2", "--spp", "1",
                                  "--backend", "cpu")
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            metamarch.render(metamarch.load(program.SCENES / "objects.glb"), size=(2, 2), spp=1, backend="cpu")
        printed = [line.removeprefix("metamarch: warning: ") for line in result.stderr.splitlines()]
        self.assertEqual([str(warning.message) for warning in caught], printed)

    # Rays.

    def test_hits_of_a_triangle(self):
        tracer = metamarch.Tracer(metamarch.from_arrays([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]))
        hits = tracer.trace([(0.25, 0.5, 2), (0.25, 0.5, 2), (2, 2, 2)], [(0, 0, -1), (0, 0, -4), (0, 0, -1)])
        np.testing.assert_array_equal(hits.t, np.float32([2, 0.5, np.inf]))
        np.testing.assert_array_equal(hits.triangle, [0, 0, -1])
        np.testing.assert_array_equal(hits.uv, np.float32([(0.25, 0.5), (0.25, 0.5), (0, 0)]))
        self.assertEqual(tracer.trace([(0, 0, 2)], [(0, 0, -1)], t_max=1.5).triangle[0], -1)
        self.assertEqual(len(tracer.trace(np.zeros((0, 3)), np.zeros((0, 3))).t), 0)

    def test_both_backends_hit_the_same(self):
        random = np.random.default_rng(1)
        origins = random.uniform(-1, 2, (5000, 3))
        directions = random.normal(size=(5000, 3))
        cpu = metamarch.Tracer(self.cornell).trace(origins, directions)
        gpu = metamarch.Tracer(self.cornell, backend="gpu").trace(origins, directions)
        for one, other in zip(cpu, gpu):
            np.testing.assert_array_equal(one, other)
        hit = cpu.triangle >= 0
        self.assertTrue(hit.any() and not hit.all())
        corners = self.cornell.positions[self.cornell.triangles[cpu.triangle[hit]]]
        u, v = cpu.uv[hit].T
        points = (1 - u - v)[:, None] * corners[:, 0] + u[:, None] * corners[:, 1] + v[:, None] * corners[:, 2]
        np.testing.assert_allclose(points, (origins + cpu.t[:, None] * directions)[hit], atol=1e-4)

    def test_rays_that_are_refused(self):
        tracer = metamarch.Tracer(self.cornell)
        for origins, directions, pattern in (([(0, 0, 0)], [(0, 0, 0)], "ray 0 has no finite origin or no direction"),
                                             ([(0, 0, math.nan)], [(0, 0, 1)], "ray 0 has no finite origin"),
                                             ([(0, 0, 0)], [(0, 0, 1)] * 2, "two arrays of N x 3"),
                                             ([0, 0, 0], [0, 0, 1], "two arrays of N x 3"),
                                             ("here", "there", "two arrays of N x 3")):
            self.assert_refused(metamarch.InvalidArgument, pattern, tracer.trace, origins, directions)

    # Comparisons.

    def test_compare(self):
        one = self.small()
        other = self.small(seed=1)
        self.assertTrue(metamarch.compare(one, self.small()))
        difference = metamarch.compare(one, other)
        self.assertFalse(difference)
        differences = np.abs(one["R"].astype(np.float64) - other["R"])
        self.assertEqual(difference.channels["R"].max_difference, differences.max())
        x, y = difference.channels["R"].worst
        self.assertEqual(differences[y, x], differences.max())
        self.assertTrue(metamarch.compare(one, other, max_abs=math.inf))
        self.bytes_of(one, "one.exr")
        self.assertTrue(metamarch.compare(self.tmp / "one.exr", one))
        self.assertTrue(metamarch.compare(one.rgb, one.rgb.astype(np.float64)))
        self.assertEqual(metamarch.compare(np.zeros((2, 2, 3)), np.zeros((2, 3, 3))).passed, False)
        self.assert_refused(metamarch.InvalidArgument, "give a film, a path, or an array", metamarch.compare, one, 3)

    # What is refused.

    def test_errors_have_kinds_and_one_line(self):
        refused = [
            (TypeError, r"^render\(\) has no option 'sp'; did you mean 'spp'\?$", self.small, {"sp": 1}),
            (TypeError, r"^render\(\) has no option 'output'", self.small, {"output": "a.exr"}),
            (metamarch.InvalidArgument, r"^spp 0: give ", self.small, {"spp": 0}),
            (metamarch.InvalidArgument, r"^spp 1\.5: give ", self.small, {"spp": 1.5}),
            (metamarch.InvalidArgument, r"^size 12: give ", self.small, {"size": 12}),
            (metamarch.InvalidArgument, r"^eye 0,0: give ", self.small, {"eye": (0, 0), "target": (0, 0, 0)}),
            (metamarch.InvalidArgument, r"^eye needs target$", self.small, {"eye": (0, 0, 0)}),
            (metamarch.InvalidArgument, r"^background and sky exclude each other$", self.small,
             {"sky": True, "background": (1, 1, 1)}),
            (metamarch.InvalidArgument, r"^sky='yes': give True or False$", self.small, {"sky": "yes"}),
            (metamarch.InvalidArgument, r"^integrator magic: give path, direct", self.small, {"integrator": "magic"}),
            (metamarch.InvalidArgument, r"^there is no camera none;", self.small, {"camera": "none"}),
            (metamarch.InvalidArgument, r"a device is for the gpu \(backend, device\)$", self.small, {"device": "0"}),
            (metamarch.InvalidArgument, r"crop reaches beyond the picture of 12 x 8 pixels \(crop\)$", self.small,
             {"crop": (0, 0, 13, 8)}),
            (metamarch.InvalidArgument, r"primary has no noise \(denoise\)$", self.small,
             {"denoise": True, "integrator": "primary"}),
            (metamarch.InputRefused, r"none\.hdr: ", self.small, {"env": Path("none.hdr")}),
            (metamarch.NoDevice, r"", self.small, {"backend": "gpu", "device": "no such device"}),
            (metamarch.InputRefused, r"^none\.glb: no such file$", metamarch.load, {"scene": "none.glb"}),
            (metamarch.InputRefused, r"^bytes: nothing to read$", metamarch.load, {"scene": b""}),
            (metamarch.InputRefused, r"^the upload: not glTF: ", metamarch.load, {"scene": b"{", "name": "the upload"}),
            (metamarch.InputRefused, r"^bytes: buffer 0: .*a\.bin.* is not a file beside the scene", metamarch.load,
             {"scene": b'{"asset": {"version": "2.0"}, "buffers": [{"uri": "a.bin", "byteLength": 4}]}'}),
            (TypeError, r"^load\(\) has no option 'spp'", metamarch.load, {"scene": CORNELL, "spp": 1}),
            (metamarch.InvalidArgument, r"^tree_depth 99: give ", metamarch.load, {"scene": CORNELL, "tree_depth": 99}),
            (TypeError, r"time_limit", metamarch.progressive, {"scene": self.cornell, "time_limit": 1}),
            (metamarch.OutputNotWritable, r"none/a\.exr", self.small().save, {"path": "none/a.exr"}),
            (metamarch.InvalidArgument, r"a\.gif: a picture is written as", self.small().save, {"path": "a.gif"}),
            (metamarch.InvalidArgument, r"a\.part: a picture is written as", self.small().save, {"path": "a.part"}),
            (metamarch.InvalidArgument, r"a\.png: only an EXR has these \(half, ", self.small().save,
             {"path": "a.png", "half": True}),
        ]
        for kind, pattern, call, options in refused:
            with self.subTest(pattern=pattern, options=options):
                self.assert_refused(kind, pattern, call, **options)
        self.assertTrue(issubclass(metamarch.InvalidArgument, (metamarch.Error, ValueError)))

    def test_a_picture_does_not_replace_its_scene(self):
        scene = self.tmp / "scene.png"
        copy = self.tmp / "scene.glb"
        copy.write_bytes(CORNELL.read_bytes())
        scene.symlink_to(copy)
        film = metamarch.render(metamarch.load(copy), size=(2, 2), spp=1, backend="cpu")
        self.assert_refused(metamarch.InvalidArgument, "name the same file", film.save, scene)
        self.assertEqual(copy.read_bytes(), CORNELL.read_bytes())

    # Documents.

    def test_option_types_are_those_declared(self):
        self.assertEqual(Path(_option_types.__file__).read_text(), option_types())

    def test_everything_public_is_documented(self):
        for name in metamarch.__all__:
            member = getattr(metamarch, name)
            self.assertTrue(inspect.getdoc(member), name)
            for part, value in vars(member).items() if name in ("Film", "Scene", "Tracer") else ():
                self.assertTrue(part.startswith("_") or inspect.getdoc(value), f"{name}.{part}")
        self.assertIn("max_bounces: ", metamarch.render.__doc__)


TYPES = {"WxH": "tuple[int, int] | str", "x,y,z": "Sequence[float]", "r,g,b": "Sequence[float]",
         "x0,y0,x1,y1": "Sequence[int]", "N": "int", "FILE": "str | os.PathLike[str]",
         "FILE.json": "str | os.PathLike[str]", "NAME|INDEX": "str | int", "INDEX|NAME": "str | int", "METHOD": "str",
         "NAME": "str", "y=HEIGHT|auto|MATERIAL": "str", "inf|DEPTH": "float", "U|Ux,Uy,Uz": "float | Sequence[float]"}
OTHER_TYPES = {"camera": '"Camera | str | int"', "tree_depth": "int"}


def option_types():
    """Returns what _option_types.py must hold."""
    text = ('# SPDX-License-Identifier: MIT\n"""The types of options, for editors and type checkers. tests/python compares '
            'this file with the declarations."""\nimport os\nfrom collections.abc import Sequence\nfrom typing import '
            'TYPE_CHECKING, Literal, TypedDict\n\nif TYPE_CHECKING:\n    from . import Camera\n')
    for name, options in (("Load", _options.LOAD), ("Render", _options.RENDER), ("Save", _options.SAVE)):
        text += f"\n\nclass {name}Options(TypedDict, total=False):\n"
        for option, facts in options.items():
            if facts["kind"] == "flag":
                kind = "bool"
            elif facts["kind"] == "list":
                kind = "str | Sequence[str]"
            elif option in OTHER_TYPES:
                kind = OTHER_TYPES[option]
            elif facts["choices"]:
                words = [choice if choice.isdigit() else json.dumps(choice) for choice in facts["choices"]]
                kind = f"Literal[{', '.join(words)}]"
                kind = "str" if len(kind) > 90 else kind
            else:
                kind = TYPES.get(facts["value_name"], "float")
            text += f"    {option}: {kind}\n"
    return text


if __name__ == "__main__":
    program.main()

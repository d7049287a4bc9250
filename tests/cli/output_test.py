# SPDX-License-Identifier: MIT
"""Where pictures and statistics go: folders that processes share, pipes, devices, standard streams, links, mount points."""
import hashlib
import json
import os
import stat
import struct
import subprocess
import threading

from arguments_test import png, triangle
from program import SCENES, ProgramTest, as_nobody, main, metamarch, unshare

CORNELL = SCENES / "cornell.glb"
SMALL = ("--size", "8x8", "--spp", "1", "--backend", "cpu", "--background", "1,1,1")


def digest(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


class OutputTest(ProgramTest):
    def render(self, name, *words):
        return self.succeed("render", CORNELL, "-o", name, *SMALL, *words)

    def shell(self, script, **environment):
        """The result of a script of bash, in which $RENDER stands for a small picture."""
        words = " ".join(f"'{word}'" for word in ("render", CORNELL, *SMALL))
        return subprocess.run(["bash", "-c", script], cwd=self.tmp, capture_output=True, timeout=60, check=False,
                              env={**os.environ, **self.environment, "RENDER": f"{metamarch()} {words}".replace("'", ""),
                                   **environment})

    def test_the_same_command_writes_the_same_bytes(self):
        for ending in ("exr", "png"):
            self.render(f"a.{ending}")
            self.render(f"b.{ending}")
            self.assertEqual(digest(self.tmp / f"a.{ending}"), digest(self.tmp / f"b.{ending}"))
        header = subprocess.run(["oiiotool", "--info", "-v", "a.exr"], cwd=self.tmp, capture_output=True, text=True, check=True).stdout
        self.assertNotRegex(header, r"DateTime|capDate|metamarch/seconds")

    def test_a_stamp_says_when(self):
        self.render("a.exr", "--stamp")
        header = subprocess.run(["oiiotool", "--info", "-v", "a.exr"], cwd=self.tmp, capture_output=True, text=True, check=True).stdout
        self.assertRegex(header, r'DateTime: "\d{4}:\d\d:\d\d \d\d:\d\d:\d\d"')
        self.assertRegex(header, r'metamarch/seconds: "\d+\.\d{3}"')

    def test_endings_are_read_in_capital_letters(self):
        for integrator in ("path", "primary"):
            for name in ("a.png", "A.PNG", "b.Png"):
                self.render(name, "--integrator", integrator)
            self.assertEqual(digest(self.tmp / "a.png"), digest(self.tmp / "A.PNG"))
            self.assertEqual(digest(self.tmp / "a.png"), digest(self.tmp / "b.Png"))

    def test_containers_that_share_a_folder(self):
        unshare("-p", "-f")
        words = [metamarch(), "render", CORNELL, *SMALL, "--quiet"]
        runs = [subprocess.Popen(["unshare", "-p", "-f", *words, "-o", f"{i}.exr"], cwd=self.tmp, stderr=subprocess.PIPE,
                                 env={**os.environ, **self.environment}) for i in range(6)]
        self.assertEqual([(run.communicate(timeout=60)[1], run.returncode) for run in runs], [(b"", 0)] * 6)
        self.assertEqual(sorted(path.name for path in self.tmp.iterdir()), [f"{i}.exr" for i in range(6)])

    def test_a_log_keeps_what_is_before_and_after(self):
        for name in ("/dev/stdout", "-", "/dev/fd/1"):
            script = f"(echo 'line 1'; $RENDER -o a.png --stats {name}; echo 'line after') > build.log"
            self.assertEqual(self.shell(script).stderr, b"")
            log = (self.tmp / "build.log").read_text()
            self.assertTrue(log.startswith("line 1\n") and log.endswith("line after\n"), log)
            self.assertEqual(json.loads(log.removeprefix("line 1\n").removesuffix("line after\n"))["size"], [8, 8])
            (self.tmp / "build.log").unlink()
        self.assertEqual([path.name for path in self.tmp.iterdir()], ["a.png"])

    def test_statistics_alone_are_on_standard_output(self):
        self.assertEqual(json.loads(self.render("a.png", "--stats", "-"))["size"], [8, 8])

    def test_a_picture_goes_into_a_pipe(self):
        self.render("a.exr")
        for script in ("$RENDER -o - | cat > b.exr", "$RENDER -o /dev/stdout > b.exr", "ln -s /dev/stdout l.exr; $RENDER -o l.exr > b.exr",
                       "$RENDER -o /dev/fd/3 3> b.exr"):
            result = self.shell(script)
            self.assertEqual((result.returncode, result.stderr), (0, b""), script)
            self.assertEqual((self.tmp / "b.exr").read_bytes(), (self.tmp / "a.exr").read_bytes(), script)

    def test_a_fifo_stays_one(self):
        self.render("a.png")
        os.mkfifo(self.tmp / "pipe.png")
        read = []
        reader = threading.Thread(target=lambda: read.append((self.tmp / "pipe.png").read_bytes()))
        reader.start()
        self.render("pipe.png")
        reader.join()
        self.assertEqual(read, [(self.tmp / "a.png").read_bytes()])
        self.assertTrue((self.tmp / "pipe.png").is_fifo())

    def test_a_device_stays_one(self):
        self.render("/dev/null", "--stats", "/dev/null")
        self.assertTrue(stat.S_ISCHR(os.stat("/dev/null").st_mode))
        self.assertRegex(self.refuse(5, "render", CORNELL, "-o", "a.png", *SMALL, "--stats", "/dev/stdin/x"), r"cannot write .*")

    def test_a_closed_stream_is_refused_at_once(self):
        result = self.shell("$RENDER -o a.png --stats - >&-")
        self.assertEqual((result.returncode, result.stderr),
                         (5, b"metamarch: cannot write -: this stream is closed, or not for writing\n"))
        self.assertFalse((self.tmp / "a.png").exists())

    def test_links_are_followed(self):
        (self.tmp / "l.png").symlink_to("new.png")
        self.render("l.png")
        self.assertTrue((self.tmp / "l.png").is_symlink())
        self.assertFalse((self.tmp / "new.png").is_symlink())

    def test_no_result_replaces_an_input(self):
        scene = self.tmp / "scene.glb"
        scene.write_bytes(CORNELL.read_bytes())
        (self.tmp / "link.json").symlink_to("scene.glb")
        os.link(scene, self.tmp / "hard.json")
        for name in ("scene.glb", "./scene.glb", "link.json", "hard.json"):
            with self.subTest(name=name):
                line = self.refuse(2, "render", "scene.glb", "-o", "a.png", *SMALL, "--stats", name)
                self.assertEqual(line, "--stats and SCENE name the same file")
                self.assertEqual(scene.read_bytes(), CORNELL.read_bytes())

    def test_no_result_replaces_what_the_scene_names(self):
        png(self.tmp / "wood.png", (9, 9, 9))
        (self.tmp / "a.bin").write_bytes(struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0))
        triangle(self.tmp / "scene.gltf", buffers=[{"byteLength": 36, "uri": "a.bin"}], images=[{"uri": "wood.png"}])
        (self.tmp / "scene.obj").write_text("mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n")
        (self.tmp / "a.mtl").write_text("newmtl m\nmap_Kd wood.png\n")
        for scene, name, words in (("scene.gltf", "wood.png", ("-o", "wood.png")), ("scene.gltf", "a.bin", ("-o", "b.png", "--stats", "a.bin")),
                                   ("scene.obj", "a.mtl", ("-o", "b.png", "--stats", "a.mtl")), ("scene.obj", "wood.png", ("-o", "wood.png"))):
            with self.subTest(scene=scene, name=name):
                before = (self.tmp / name).read_bytes()
                line = self.refuse(2, "render", scene, *SMALL, *words)
                self.assertRegex(line, rf"\A--(output|stats) and SCENE's {name} name the same file\Z")
                self.assertEqual((self.tmp / name).read_bytes(), before)
        self.assertEqual(self.refuse(2, "bench", "traversal", "scene.gltf", "--json", "a.bin"), "--json and SCENE's a.bin name the same file")

    def test_mode_and_owner_are_kept(self):
        for name in ("a.png", "s.json"):
            (self.tmp / name).touch()
            (self.tmp / name).chmod(0o604)
            if os.geteuid() == 0:
                os.chown(self.tmp / name, 65534, 65534)
        before = [(path.stat().st_mode, path.stat().st_uid, path.stat().st_gid) for path in sorted(self.tmp.iterdir())]
        self.render("a.png", "--stats", "s.json")
        self.assertEqual([(path.stat().st_mode, path.stat().st_uid, path.stat().st_gid) for path in sorted(self.tmp.iterdir())], before)
        self.assertGreater((self.tmp / "a.png").stat().st_size, 0)

    def test_a_mount_point_is_written_in_place(self):
        unshare("-m")
        script = ("touch host.png host.json in.png in.json; unshare -m sh -c 'mount --bind host.png in.png && "
                  "mount --bind host.json in.json && exec $RENDER -o in.png --stats in.json'")
        result = self.shell(script)
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        self.render("a.png")
        self.assertEqual(digest(self.tmp / "host.png"), digest(self.tmp / "a.png"))
        self.assertEqual(json.loads((self.tmp / "host.json").read_text())["size"], [8, 8])
        self.assertEqual(len(list(self.tmp.iterdir())), 5)

    def test_a_file_in_a_folder_that_is_closed(self):
        nobody = as_nobody(self)
        (self.tmp / "a.png").write_bytes(b"x" * 100000)
        (self.tmp / "a.png").chmod(0o666)
        self.tmp.chmod(0o555)
        run = lambda name: subprocess.run([metamarch(), "render", CORNELL, "-o", name, *SMALL], cwd=self.tmp, capture_output=True,
                                          text=True, check=False, **nobody)
        self.assertEqual(run("a.png").returncode, 0)
        self.assertEqual(run("b.png").returncode, 5)
        self.assertEqual(run("b.png").stderr, "metamarch: cannot write b.png: Permission denied\n")
        self.tmp.chmod(0o755)
        self.render("b.png")
        self.assertEqual(digest(self.tmp / "a.png"), digest(self.tmp / "b.png"))


if __name__ == "__main__":
    main()

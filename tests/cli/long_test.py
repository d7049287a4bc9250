# SPDX-License-Identifier: MIT
"""Renders that are watched, ended, killed, continued and divided: their pictures have the bytes of undivided ones."""
import json
import os
import random
import resource
import signal
import subprocess
import time

from arguments_test import triangle
from program import SCENES, ProgramTest, main, metamarch, unshare

CORNELL = SCENES / "cornell.glb"
TINY = ("--size", "13x9", "--backend", "cpu", "--quiet")
# Takes a while: 0.1 s a pass on a slow machine.
LONG = ("--size", "48x48", "--spp", "100000", "--backend", "cpu", "--quiet")


class LongTest(ProgramTest):
    def render(self, name, *words, scene=CORNELL):
        """Renders a tiny picture or part; returns its bytes."""
        self.succeed("render", scene, "-o", name, *TINY, *words)
        return (self.tmp / name).read_bytes()

    def begin(self, *words, **more):
        run = subprocess.Popen([metamarch(), "render", CORNELL, *words], cwd=self.tmp, stderr=subprocess.PIPE,
                               stdout=subprocess.PIPE, text=True, env={**os.environ, **self.environment}, **more)
        self.addCleanup(lambda: (run.kill(), run.communicate()) if run.poll() is None else None)
        return run

    def wait_for(self, condition, run):
        for _ in range(2000):
            if condition():
                return
            self.assertIsNone(run.poll(), "the render has ended")
            time.sleep(0.01)
        self.fail("it takes too long")


class Stopped(LongTest):
    def test_signals_write_the_picture_and_the_checkpoint(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            for words in ((), ("--checkpoint", "c")):
                run = self.begin("-o", "a.exr", *LONG, "--write-every", "0.01", *words)
                self.wait_for(lambda: (self.tmp / "a.exr").exists(), run)
                (self.tmp / "a.exr").unlink()
                begun = time.monotonic()
                run.send_signal(number)
                errors = run.communicate(timeout=20)[1]
                self.assertLess(time.monotonic() - begun, 10)
                self.assertEqual(run.returncode, -number)
                self.assertRegex(errors, rf"\Ametamarch: ended by signal {int(number)}: a\.exr has \d+( to \d+)? of 100000 samples a pixel; .*\n\Z")
                self.assertEqual("--resume c" in errors, bool(words))
                self.succeed("compare", "a.exr", "a.exr")
                self.assertEqual(sorted(path.name for path in self.tmp.iterdir()), ["a.exr", *(["c"] if words else [])])
                for path in self.tmp.iterdir():
                    path.unlink()

    def test_the_user_signal_writes_the_picture(self):
        run = self.begin("-o", "a.exr", *LONG, "--checkpoint", "c")
        self.wait_for(lambda: (self.tmp / "c").exists(), run)
        for _ in range(2):
            self.wait_for(lambda: run.send_signal(signal.SIGUSR1) or (self.tmp / "a.exr").exists(), run)
            (self.tmp / "a.exr").unlink(missing_ok=True)

    def killed(self, backend, spp, moments):
        """Kills a render at each moment, the seconds after its first picture, continues it, and at last lets it end."""
        words = ("--size", "40x30", "--spp", str(spp), "--backend", backend, "--quiet")
        self.succeed("render", CORNELL, "-o", "whole.exr", *words)
        resume = lambda: ("--resume", "c") if (self.tmp / "c").exists() else ()
        for moment in moments:
            run = self.begin("-o", "a.exr", *words, "--checkpoint", "c", "--write-every", "0.002", *resume())
            while run.poll() is None and moment >= 0 and not (self.tmp / "a.exr").exists():
                time.sleep(0.001)
            time.sleep(abs(moment))
            run.kill()
            self.assertEqual(run.communicate()[1], "")
            (self.tmp / "a.exr").unlink(missing_ok=True)
            for left in self.tmp.glob(".metamarch-*.tmp"):
                left.unlink()
        self.succeed("render", CORNELL, "-o", "a.exr", *words, *resume())
        self.assertEqual((self.tmp / "a.exr").read_bytes(), (self.tmp / "whole.exr").read_bytes())
        (self.tmp / "c").unlink(missing_ok=True)

    def test_killed_at_any_moment_and_continued(self):
        """The same bytes as in one go, header and all. Negative moments are seconds after the start."""
        chance = random.Random(1)
        self.killed("cpu", 400, [chance.choice((1, 1, -3)) * chance.uniform(0, 0.05) for _ in range(18)])
        self.killed("gpu", 200, [chance.uniform(0, 0.1) for _ in range(2)])

    def test_more_samples_of_a_finished_picture(self):
        for first in (5, 16, 23, 32):
            self.render(f"{first}.part", "--spp", str(first))
            self.assertEqual(self.render("a.exr", "--spp", "41", "--resume", f"{first}.part"), self.render("b.exr", "--spp", "41"))

    def test_a_complete_render_leaves_no_checkpoint(self):
        self.render("a.exr", "--spp", "20", "--checkpoint", "c")
        self.assertFalse((self.tmp / "c").exists())

    def test_time_limit(self):
        run = self.run_program("render", CORNELL, "-o", "a.exr", "--size", "32x32", "--spp", "1000000", "--backend", "cpu",
                               "--time-limit", "0.3", "--checkpoint", "c")
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        samples = int(run.stdout.split(" samples a pixel")[0].split()[-1])
        self.assertGreater(samples, 0)
        self.succeed("render", CORNELL, "-o", "b.exr", "--size", "32x32", "--spp", str(samples), "--backend", "cpu", "--quiet")
        self.assertEqual((self.tmp / "a.exr").read_bytes(), (self.tmp / "b.exr").read_bytes())
        self.succeed("render", CORNELL, "-o", "c.exr", "--size", "32x32", "--spp", str(samples + 3), "--backend", "cpu", "--resume", "c")

    def test_progress_as_json(self):
        run = self.begin("-o", "a.exr", "--size", "48x48", "--spp", "100000", "--backend", "cpu", "--progress", "json")
        lines = [json.loads(run.stderr.readline()) for _ in range(2)]
        run.kill()
        run.communicate()
        for line in lines:
            self.assertEqual(line["samplesPerPixel"], 100000)
        self.assertLess(lines[0]["part"], lines[1]["part"])
        self.assertGreater(lines[1]["secondsLeft"], 0)
        self.assertGreater(lines[1]["noise"], 0)


class Checkpoint(LongTest):
    def refuse_resume(self, *words, scene=CORNELL, file="a.part"):
        return self.refuse(3, "render", scene, "-o", "b.exr", "--size", "13x9", "--backend", "cpu", "--spp", "20", *words, "--resume", file)

    def test_another_picture_is_refused_by_name(self):
        self.render("a.part", "--spp", "20")
        for words, name in ((("--seed", "1"), "--seed"), (("--eye", "0,0,3", "--target", "0,0,0"), "camera"), (("--max-bounces", "2"), "--max-bounces"),
                            (("--size", "13x8"), "--size"), (("--exposure", "1"), "--exposure"), (("--sky",), "scene")):
            given = [word for word in ("--size", "13x9", "--backend", "cpu", "--spp", "20") if name != "--size" or word not in ("--size", "13x9")]
            line = self.refuse(3, "render", CORNELL, "-o", "b.exr", *given, *words, "--resume", "a.part")
            self.assertRegex(line, rf"\Aa\.part: is of another picture: {name} is ")
        triangle(self.tmp / "t.gltf")
        self.assertIn("scene is", self.refuse_resume(scene="t.gltf").splitlines()[-1])
        self.assertIn("device is `cpu`", self.refuse(3, "render", CORNELL, "-o", "b.exr", "--size", "13x9", "--spp", "20", "--resume", "a.part"))
        self.assertEqual(self.refuse(3, "render", CORNELL, "-o", "b.exr", *TINY, "--spp", "19", "--resume", "a.part"),
                         "a.part: has 20 samples a pixel already, more than the 19 wanted")
        self.assertIn("--crop", self.refuse_resume("--crop", "0,0,4,4"))

    def test_damaged_files(self):
        data = self.render("a.part", "--spp", "3")
        (self.tmp / "a.part").write_bytes(data[:-1])
        self.assertEqual(self.refuse_resume(), "a.part: is cut off or damaged")
        (self.tmp / "a.part").write_bytes(data + b"x")
        self.assertIn("damaged", self.refuse_resume())
        self.assertIn("no such file", self.refuse_resume(file="none.part"))

    def test_one_process_at_a_time(self):
        run = self.begin("-o", "a.exr", *LONG, "--checkpoint", "c", "--write-every", "0.01")
        self.wait_for(lambda: (self.tmp / "a.exr").exists(), run)
        for resume in ((), ("--resume", "c")):
            result = self.run_program("render", CORNELL, "-o", "b.exr", *LONG, "--checkpoint", "c", *resume)
            self.assertEqual((result.returncode, result.stderr), (5, "metamarch: cannot write c: another process writes it\n"))
        run.kill()
        run.communicate()
        (self.tmp / "a.exr").unlink()
        line = self.refuse(2, "render", CORNELL, "-o", "b.exr", *LONG, "--checkpoint", "c")
        self.assertEqual(line, "--checkpoint c: the file is there already; go on from it with `--resume c`, or remove it")

    def test_a_full_disk(self):
        """The checkpoint that is there stays, the render goes on, and says so."""
        unshare("-m")
        folder = self.tmp / "small"
        folder.mkdir()
        script = (f"mount -t tmpfs -o size=400k none small && {metamarch()} render {CORNELL} -o a.exr --size 40x30 --spp 60 --backend cpu --quiet"
                  " --checkpoint small/c --write-every 0.001; code=$?; ls -A small; exit $code")
        self.render("w.exr")
        result = subprocess.run(["unshare", "-m", "bash", "-c", script], cwd=self.tmp, capture_output=True, text=True, check=False,
                                env={**os.environ, **self.environment})
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertRegex(result.stderr, r"\A(metamarch: warning: cannot write small/c: No space left on device; the render goes on\n)+\Z")
        self.succeed("render", CORNELL, "-o", "b.exr", "--size", "40x30", "--spp", "60", "--backend", "cpu", "--quiet")
        self.assertEqual((self.tmp / "a.exr").read_bytes(), (self.tmp / "b.exr").read_bytes())

    def test_a_picture_that_cannot_be_written_is_in_the_checkpoint(self):
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (40000, 40000))
        words = ("--size", "13x9", "--spp", "20", "--backend", "cpu", "--quiet")
        # 13 x 9 pixels take 26 KB in the checkpoint, and less than a kilobyte more in two spans.
        run = self.begin("-o", "/dev/full", *words, "--checkpoint", "c", preexec_fn=limit)
        self.assertEqual(run.communicate()[1], "metamarch: cannot write /dev/full: No space left on device\n")
        self.assertEqual(run.returncode, 5)
        self.succeed("render", CORNELL, "-o", "a.exr", *words, "--resume", "c")
        self.assertEqual((self.tmp / "a.exr").read_bytes(), self.render("b.exr", "--spp", "20"))

    def test_refusals(self):
        for words, part in ((("--samples", "64"), "did you mean `--spp 64`?"), (("--samples", "4:4"), "A less than B"), (("--samples", "x:4"), "whole number"),
                            (("--samples", "0:4"), "name the output .part"), (("--samples", "0:4", "--spp", "4"), "exclude each other"),
                            (("--crop", "0,0,14,9"), "beyond the picture of 13 x 9"), (("--crop", "4,0,4,9"), "x0 < x1"), (("--crop", "1,2,3"), "x0 < x1"),
                            (("--time-limit", "0"), "seconds"), (("--write-every", "-1"), "seconds"), (("--progress", "bar"), "line or json"),
                            (("--integrator", "primary", "--checkpoint", "c"), "takes one sample"),
                            (("--checkpoint", "a.exr"), "name the same file"), (("--resume", "a.exr"), "no such file")):
            with self.subTest(words=words):
                result = self.run_program("render", CORNELL, "-o", "a.exr", "--size", "13x9", "--backend", "cpu", *words)
                self.assertIn(result.returncode, (2, 3))
                self.assertRegex(result.stderr, r"\Ametamarch: [^\n]+\n\Z")
                self.assertIn(part, result.stderr)
        self.assertIn("several pictures", self.refuse(2, "render", CORNELL, "-o", "-", "--write-every", "1"))
        self.assertEqual(list(self.tmp.iterdir()), [])


class Parts(LongTest):
    def test_any_partition(self):
        """Merged in random order, some by way of a part of parts. Picture.anyPartitionAddsUp tries more of them."""
        chance = random.Random(7)
        for trial, channels in enumerate(((), ("--aov", "all"))):
            whole = self.render("whole.exr", "--spp", "40", *channels)
            cuts = sorted({0, 40, *chance.sample((8, 16, 19, 32, 33), chance.randrange(3))})
            x, y = chance.randrange(1, 13), chance.randrange(1, 9)
            areas = chance.choice((((0, 0, 13, 9),), ((0, 0, x, 9), (x, 0, 13, 9)), ((0, 0, 13, y), (0, y, x, 9), (x, y, 13, 9))))
            names = []
            for area in areas:
                for first, end in zip(cuts, cuts[1:]):
                    names.append(f"{trial}-{len(names)}.part")
                    self.render(names[-1], "--samples", f"{first}:{end}", "--crop", ",".join(map(str, area)), *channels)
            chance.shuffle(names)
            if len(names) > 2:
                self.succeed("merge", *names[:2], "-o", "some.part", "--quiet")
                names[:2] = ["some.part"]
            with self.subTest(cuts=cuts, areas=areas):
                self.succeed("merge", *names, "-o", "merged.exr", "--quiet")
                self.assertEqual((self.tmp / "merged.exr").read_bytes(), whole)

    def test_parts_of_the_device(self):
        words = ("--size", "20x11", "--quiet")
        self.succeed("render", CORNELL, "-o", "whole.png", *words, "--spp", "36", "--exposure", "1", "--seed", "9")
        for i, (samples, area) in enumerate((("0:20", "0,0,20,11"), ("20:36", "0,0,9,11"), ("20:36", "9,0,20,11"))):
            self.succeed("render", CORNELL, "-o", f"{i}.part", *words, "--samples", samples, "--crop", area, "--exposure", "1", "--seed", "9")
        self.succeed("merge", "2.part", "0.part", "1.part", "-o", "merged.png", "--quiet")
        self.assertEqual((self.tmp / "merged.png").read_bytes(), (self.tmp / "whole.png").read_bytes())

    def test_missing_overlapping_and_foreign_parts(self):
        for name, words in (("a", ("--samples", "0:16")), ("b", ("--samples", "16:32")), ("c", ("--samples", "20:32")), ("d", ("--samples", "32:40")),
                            ("left", ("--samples", "0:16", "--crop", "0,0,5,9")), ("s", ("--samples", "16:32", "--seed", "4"))):
            self.render(name + ".part", *words)
        merge = lambda *names: self.refuse(3, "merge", *(name + ".part" for name in names), "-o", "x.exr")
        self.assertEqual(merge("a", "c"), "no part has sample 16 of pixel 0,0")
        self.assertEqual(merge("d", "a"), "no part has sample 16 of pixel 0,0")
        self.assertEqual(merge("b"), "no part has sample 0 of pixel 0,0")
        self.assertEqual(merge("left", "b"), "no part has sample 0 of pixel 5,0")
        self.assertEqual(merge("left"), "no part has sample 0 of pixel 5,0")
        self.assertEqual(merge("a", "c", "b"), "b.part and c.part both have sample 20 of pixel 0,0")
        self.assertEqual(merge("a", "b", "a"), "a.part and a.part both have sample 0 of pixel 0,0")
        self.assertEqual(merge("a", "s"), "s.part: is of another picture: --seed is `4` in it and nothing in a.part")
        (self.tmp / "e.part").write_bytes(b"")
        self.assertEqual(merge("a", "e"), "e.part: the file is empty")
        self.assertEqual(self.refuse(2, "merge", "a.part", "-o", "a.part"), "--output and a.part name the same file")
        # A small file may claim any size; no memory is taken for it.
        self.succeed("render", CORNELL, "-o", "huge.part", "--size", "16384x8192", "--crop", "0,0,1,1", "--spp", "1", "--backend",
                     "cpu", "--quiet")
        self.assertEqual(merge("huge"), "no part has sample 0 of pixel 1,0")

    def test_a_crop_is_a_picture_too(self):
        self.render("whole.exr", "--spp", "4")
        self.render("crop.exr", "--spp", "4", "--crop", "3,2,10,7")
        info = subprocess.run(["oiiotool", "--info", "-v", "crop.exr"], cwd=self.tmp, capture_output=True, text=True, check=True).stdout
        self.assertIn("pixel data origin: x=3, y=2", info)
        self.assertIn("full/display size: 13 x 9", info)
        for name in ("whole", "crop"):
            subprocess.run(["oiiotool", f"{name}.exr", "--cut", "7x5+3+2", "-o", f"{name}-cut.exr"], cwd=self.tmp, check=True)
        self.succeed("compare", "whole-cut.exr", "crop-cut.exr", "--max-abs", "0")
        self.render("p.exr", "--integrator", "primary", "--crop", "3,2,10,7")
        self.render("c.png", "--spp", "1", "--crop", "3,2,10,7")


if __name__ == "__main__":
    main()

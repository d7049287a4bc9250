# SPDX-License-Identifier: MIT
"""The program as part of a system: streams that are closed, signals, limits, files that may not be read, threads."""
import os
import re
import resource
import signal
import subprocess
import time
from pathlib import Path

from arguments_test import triangle
from program import SCENES, ProgramTest, as_nobody, main, metamarch, unshare

CORNELL = SCENES / "cornell.glb"
SMALL = ("--size", "8x8", "--spp", "1", "--backend", "cpu")
SMALL_ON_ANY = ("--size", "8x8", "--spp", "1", "--backend")
ENDLESS = ("--size", "256x256", "--spp", "100000", "--backend", "cpu", "--background", "1,1,1")


def handles(process, number):
    """Returns True if the process has a handler for the signal."""
    caught = re.search(r"SigCgt:\s+(\w+)", Path(f"/proc/{process}/status").read_text())[1]
    return int(caught, 16) >> (number - 1) & 1 == 1


class ProcessTest(ProgramTest):
    def shell(self, script):
        return subprocess.run(["bash", "-c", f"P={metamarch()}; C={CORNELL}; {script}"], cwd=self.tmp, capture_output=True, timeout=60,
                              check=False, env={**os.environ, **self.environment})

    def test_a_picture_needs_no_stream(self):
        """degenerate.glb has no light, which is a warning."""
        scene, small = SCENES / "degenerate.glb", " ".join(SMALL)
        for streams in ("2>&-", "2>/dev/full", ">&-", ">/dev/full", ">&- 2>&-", ">/dev/full 2>/dev/full", "<&- >&- 2>&-", "| true"):
            with self.subTest(streams=streams):
                self.assertEqual(self.shell(f"$P render {scene} -o a.exr {small} {streams}").returncode, 0)
                self.succeed("compare", "a.exr", "a.exr")
                (self.tmp / "a.exr").unlink()

    def test_exit_codes_need_no_stream(self):
        for streams in ("2>&-", "2>/dev/full", ">&- 2>&-"):
            for words, code in (("render no.glb -o a.exr", 3), ("render $C", 2), ("", 2), ("info $C --scale 0", 2),
                                ("render $C -o no/a.exr", 5)):
                with self.subTest(streams=streams, words=words):
                    self.assertEqual(self.shell(f"$P {words} {streams}").returncode, code)

    def test_a_report_needs_its_stream(self):
        for words in ("info $C", "bench --list", "--help", "--version", "compare a.exr a.exr"):
            self.shell(f"$P render $C -o a.exr {' '.join(SMALL)}")
            with self.subTest(words=words):
                self.assertEqual(self.shell(f"$P {words} >&-").returncode, 5)
                self.assertEqual(self.shell(f"$P {words} > /dev/full").returncode, 5)
                self.assertEqual(self.shell(f"set -o pipefail; $P {words} | true").returncode, 0)

    def begin_endless(self, *before):
        run = subprocess.Popen([*before, metamarch(), "render", CORNELL, "-o", "a.exr", *ENDLESS], cwd=self.tmp,
                               stderr=subprocess.PIPE, env={**os.environ, **self.environment})
        self.addCleanup(run.kill)
        return run

    def wait_for(self, run, condition):
        """Returns the first result of `condition` that is true."""
        end = time.monotonic() + 60
        while time.monotonic() < end:
            self.assertIsNone(run.poll())
            if found := condition():
                return found
            time.sleep(0.01)
        raise TimeoutError(run.args)

    def test_signals_end_it(self):
        """A render writes its picture first: see Stopped in long_test.py."""
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            run = self.begin_endless()
            self.wait_for(run, lambda: handles(run.pid, number))
            run.send_signal(number)
            line = run.communicate(timeout=20)[1]
            self.assertRegex(line, rb"\A(metamarch: ended by signal [^\n]+\n)?\Z")
            self.assertEqual(run.returncode, -number)
            self.assertEqual([path.name for path in self.tmp.iterdir()], ["a.exr"] if line else [])
            (self.tmp / "a.exr").unlink(missing_ok=True)

    def test_signals_end_it_as_process_1(self):
        unshare("-p", "-f")
        for number in (signal.SIGTERM, signal.SIGINT):
            run = self.begin_endless("unshare", "-p", "-f")
            child = ["pgrep", "-P", str(run.pid)]
            inner = self.wait_for(run, lambda: subprocess.run(child, capture_output=True, text=True, check=False).stdout)
            # The kernel drops signals to a process 1 that has no handler yet: a busy machine takes a while to start it.
            for _ in range(200):
                try:
                    os.kill(int(inner), number)
                    run.wait(timeout=0.1)
                    break
                except subprocess.TimeoutExpired:
                    pass
                except ProcessLookupError:
                    break
            line = run.communicate(timeout=20)[1]
            self.assertRegex(line, rb"\A(metamarch: ended by signal [^\n]+\n)?\Z")
            self.assertEqual(run.returncode, 128 + number)
            self.assertEqual([path.name for path in self.tmp.iterdir()], ["a.exr"] if line else [])
            (self.tmp / "a.exr").unlink(missing_ok=True)

    def test_a_file_that_may_not_grow(self):
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))
        result = subprocess.run([metamarch(), "render", CORNELL, "-o", "a.exr", "--size", "64x64", "--spp", "1", "--backend", "cpu"], cwd=self.tmp,
                                capture_output=True, text=True, check=False, preexec_fn=limit)
        self.assertEqual((result.returncode, result.stderr), (5, "metamarch: cannot write a.exr: File too large\n"))
        self.assertEqual(list(self.tmp.iterdir()), [])

    def test_reasons_why_a_file_is_not_read(self):
        nobody = as_nobody(self)
        triangle(self.tmp / "secret.gltf")
        (self.tmp / "secret.gltf").chmod(0)
        (self.tmp / "closed").mkdir(mode=0o700)
        triangle(self.tmp / "closed" / "a.gltf")
        os.chmod(self.tmp / "closed", 0)
        self.tmp.chmod(0o755)
        run = lambda *words: subprocess.run([metamarch(), *words], cwd=self.tmp, capture_output=True, text=True, check=False, **nobody)
        for words, line in ((("info", "secret.gltf"), "secret.gltf: cannot be read: Permission denied"),
                            (("info", "closed/a.gltf"), "closed/a.gltf: Permission denied"),
                            (("info", CORNELL, "--partition", "secret.gltf"), "secret.gltf: cannot be read: Permission denied")):
            result = run(*words)
            self.assertEqual((result.returncode, result.stderr), (3, f"metamarch: {line}\n"))
        os.chmod(self.tmp / "closed", 0o755)

    def test_threads_that_the_system_refuses(self):
        nobody = as_nobody(self)
        self.tmp.chmod(0o777)
        for backend in ("cpu", "gpu"):
            for threads in (8, 12):  # with fewer, libraries end the program before its first line
                limit = lambda threads=threads: resource.setrlimit(resource.RLIMIT_NPROC, (threads, threads))
                result = subprocess.run([metamarch(), "render", CORNELL, "-o", f"{backend}.exr", *SMALL_ON_ANY, backend],
                                        cwd=self.tmp, capture_output=True, text=True, check=False, preexec_fn=limit, **nobody)
                with self.subTest(backend=backend, threads=threads):
                    if backend == "gpu" and (end := re.search("libc\\+\\+abi: .*", result.stderr)):  # not the program's library
                        self.skipTest(f"the driver ends the process: {end[0]}")
                    self.assertIn(result.returncode, (0, 4, 6), result.stderr)
                    if result.returncode != 0:
                        self.assertRegex(result.stderr, r"\Ametamarch: [^\n]+\n\Z")
                        self.assertEqual(backend, "gpu")

    def test_threads_are_tried_only_near_a_limit(self):
        """Counts the threads and processes by the number of the next process. The trial of 100 threads makes 504."""
        unshare("-m", "-p", "-f")
        hard, container = resource.getrlimit(resource.RLIMIT_NPROC)[1], Path("/sys/fs/cgroup/pids.max")
        if 0 <= hard < 20000 or (container.exists() and container.read_text() != "max\n"):
            self.skipTest("this machine has a limit itself")
        self.shell("$P render $C -o a.exr " + " ".join(SMALL))
        for folder in ("cgroup", "cgroup/pids"):  # versions 2 and 1
            (self.tmp / folder).mkdir()
            (self.tmp / folder / "pids.max").write_text("10000\n")
        for prepare, is_tried in (("ulimit -u 20000", False), ("ulimit -u 10000", True),
                                 ("ulimit -u 20000 && mount --bind cgroup /sys/fs/cgroup", True)):
            script = f"{prepare} && $P compare a.exr a.exr --threads 100 > log && sh -c 'echo $$'"
            result = subprocess.run(["unshare", "-m", "-p", "-f", "bash", "-c", f"P={metamarch()}; {script}"], cwd=self.tmp,
                                    capture_output=True, text=True, check=False, env={**os.environ, **self.environment})
            with self.subTest(prepare=prepare):
                self.assertEqual((result.returncode, result.stderr), (0, ""))
                self.assertEqual(int(result.stdout) > 504, is_tried)

    def test_too_few_addresses_are_not_a_missing_driver(self):
        for mebibytes in (900, 1100):  # with fewer, libraries end the program before its first line
            limit = lambda size=mebibytes << 20: resource.setrlimit(resource.RLIMIT_AS, (size, size))
            result = subprocess.run([metamarch(), "render", CORNELL, "-o", "a.exr", "--size", "8x8", "--spp", "1", "--quiet"],
                                    cwd=self.tmp, capture_output=True, text=True, check=False, preexec_fn=limit)
            with self.subTest(mebibytes=mebibytes):
                self.assertIn(result.returncode, (0, 6), result.stderr)
                self.assertNotIn("install", result.stderr)
                if result.returncode == 6:
                    self.assertRegex(result.stderr, r"\Ametamarch: [^\n]+\n\Z")

    def test_threads_change_no_bit(self):
        for name, words in {"one": ("--threads", "1"), "all": ()}.items():
            self.succeed("render", CORNELL, "-o", f"{name}.exr", "--size", "32x32", "--spp", "4", *words)
        self.assertEqual((self.tmp / "one.exr").read_bytes(), (self.tmp / "all.exr").read_bytes())
        self.assertIn("--threads 0: give a whole number from 1", self.refuse(2, "info", CORNELL, "--threads", "0"))

    def test_verbose_names_device_and_stages(self):
        result = self.run_program("render", CORNELL, "-o", "a.exr", "--size", "8x8", "--spp", "1", "--verbose")
        self.assertEqual(result.returncode, 0)
        lines = result.stderr.splitlines()
        for line in lines:
            self.assertRegex(line, r"\Ametamarch: +\d+\.\d{3} s  \S.*\Z")
        for what in ("device .*llvmpipe" if "llvmpipe" in result.stdout else "device ", "scene of 32 triangles", "tree and table",
                     "light and materials", "scene on the device", "picture, of which", "a.exr written"):
            self.assertTrue(any(re.search(what, line) for line in lines), (what, lines))
        self.refuse(2, "render", CORNELL, "-o", "a.exr", "--verbose", "--quiet")


if __name__ == "__main__":
    main()

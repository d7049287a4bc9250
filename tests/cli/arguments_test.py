# SPDX-License-Identifier: MIT
"""Every way to call the program wrongly, and some right ones: exit code, stdout, the one line on stderr.

To test another call, add a line to CASES; to test a file, write it in make_files(). `{scenes}` is the project's folder of
scenes; all else is relative to a temporary folder.
"""
import base64
import json
import os
import queue
import re
import struct
import subprocess
import zlib
from concurrent.futures import ThreadPoolExecutor

from program import SCENES, ProgramTest, main, metamarch

# Number of calls at a time; there are more than 200. CTest knows the number.
PROCESSES = 2
NO_OUTPUT = r""
ANYTHING = r".*"


def png(path, color):
    """Writes a 2x1 picture of one RGB colour without an image library."""
    def chunk(name, body):
        return struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body))

    rows = b"\0" + bytes(color) * 2
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 2, 1, 8, 2, 0, 0, 0))
                     + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def triangle(path, **members):
    """Writes a glTF of one triangle, with material 0 if `members` have materials. `members` replace other members."""
    primitive = {"attributes": {"POSITION": 0}, **({"material": 0} if "materials" in members else {})}
    buffer = base64.b64encode(struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)).decode()
    path.write_text(json.dumps({
        "asset": {"version": "2.0"}, "nodes": [{"mesh": 0}], "meshes": [{"primitives": [primitive]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": "data:;base64," + buffer}], **members}))


def make_files(tmp):
    png(tmp / "black.png", (0, 0, 0))
    png(tmp / "grey.png", (0, 51, 0))  # 51 / 255 = 0.2
    (tmp / "text.exr").write_text("this is no picture\n")
    (tmp / "empty.exr").write_bytes(b"")
    (tmp / "folder.exr").mkdir()
    cornell = (SCENES / "cornell.glb").read_bytes()
    (tmp / "cornell.glb").write_bytes(cornell)
    (tmp / "unknown.gtlf").write_bytes(cornell)
    (tmp / "halves.json").write_text('{"resolution": [2, 1, 1], "boxes": [[0,0,0,1,1,1], [1,0,0,2,1,1]]}')
    (tmp / "overlap.json").write_text('{"resolution": [2, 1, 1], "boxes": [[0,0,0,2,1,1], [1,0,0,2,1,1]]}')
    (tmp / "gap.json").write_text('{"resolution": [2, 1, 1], "boxes": [[0,0,0,1,1,1]]}')
    (tmp / "huge.json").write_text('{"resolution": [1000, 1000, 1000], "boxes": []}')
    for length in (4, 12, 20, 700, len(cornell) - 1):
        (tmp / f"first_{length}.glb").write_bytes(cornell[:length])
    triangle(tmp / "variants.gltf", extensions={"KHR_materials_variants": {"variants": [{"name": "red"}, {"name": "green"}]}})
    triangle(tmp / "painted.gltf", images=[{"uri": "gone.png"}], textures=[{"source": 0}],
             materials=[{"emissiveTexture": {"index": 0}}])
    triangle(tmp / "cycle.gltf", scene=0, scenes=[{"nodes": [0]}],
             nodes=[{"mesh": 0, "children": [1]}, {"children": [0]}])
    position = {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}
    triangle(tmp / "indices.gltf", meshes=[{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
             accessors=[position, {"bufferView": 0, "componentType": 5121, "count": 36, "type": "SCALAR"}])
    # The first position is not a normal.
    triangle(tmp / "normals.gltf", meshes=[{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 0}}]}])
    for ending in ("glb", "gltf", "obj", "ply", "off", "stl"):
        (tmp / f"empty.{ending}").write_bytes(b"")
        (tmp / f"prose.{ending}").write_text("It was a dark and stormy night;\nthe rain fell in torrents.\n")


# (arguments, exit code, stdout, the line on stderr without "metamarch: "); the last two are regular expressions for the
# whole of it, and on stdout `.` also matches the end of a line.
CASES = [
    # the program itself
    ("", 2, ANYTHING, r"no sub-command given; see `metamarch SUBCOMMAND --help`"),
    ("--version", 0, r"metamarch \d+\.\d+\.\d+ \([0-9a-z-]+\)\nVulkan headers +1\.\d+\.\d+\n.*", NO_OUTPUT),
    ("--help", 0, r".*Exit codes:\n.*Example:\n  build/metamarch .*\n", NO_OUTPUT),
    ("compar", 2, NO_OUTPUT, r"unknown sub-command `compar`; did you mean `compare`\? .*"),
    ("qqqqqq", 2, NO_OUTPUT, r"unknown sub-command `qqqqqq` \(see `metamarch --help`: .*"),
    ("--versoin", 2, NO_OUTPUT, r"unknown option `--versoin`; did you mean `--version`\? .*"),
    # compare: bounds
    ("compare black.png black.png", 0, r"channel .*within bounds: 0 of 2 pixels fail.*", NO_OUTPUT),
    ("compare black.png grey.png", 1, r".*\nout of bounds: 2 of 2 pixels fail.*",
     r"black.png and grey.png differ: 2 of 2 pixels .*"),
    ("compare black.png grey.png --max-abs 0.19", 1, ANYTHING, r".* differ: .*"),
    ("compare black.png grey.png --max-abs 0.21", 0, ANYTHING, NO_OUTPUT),
    ("compare black.png grey.png --max-fail-percent 99", 1, ANYTHING, r".* differ: .*"),
    ("compare black.png grey.png --max-fail-percent 100", 0, ANYTHING, NO_OUTPUT),
    # compare: bad arguments
    ("compare", 2, NO_OUTPUT, r"compare: A is required \(see `metamarch compare --help`\)"),
    ("compare black.png", 2, NO_OUTPUT, r"compare: B is required .*"),
    ("compare a b c", 2, NO_OUTPUT, r"compare: unknown argument `c` .*"),
    ("compare a b --maxabs 1", 2, NO_OUTPUT, r"compare: unknown argument `--maxabs`; did you mean `--max-abs`\? .*"),
    ("compare a b --max-abs -1", 2, NO_OUTPUT, r"--max-abs -1: give a bound of 0 or more"),
    ("compare a b --max-abs nan", 2, NO_OUTPUT, r"--max-abs nan: give a bound of 0 or more"),
    ("compare a b --max-abs much", 2, NO_OUTPUT, r"--max-abs much: give a bound of 0 or more"),
    ("compare a b --max-fail-percent -0.1", 2, NO_OUTPUT, r"--max-fail-percent -0.1: give a bound of 0 or more"),
    ("compare a b --threads 0", 2, NO_OUTPUT, r"--threads 0: give a whole number from 1 to 1024"),
    ("compare black.png black.png --threads 1", 0, r"channel .*within bounds: 0 of 2 pixels fail.*", NO_OUTPUT),
    ("compare a b --out difference.gif", 2, NO_OUTPUT, r"difference.gif: a picture is written as .exr, .png, .jpg, .webp or .tif"),
    # compare: unreadable pictures, unwritable output
    ("compare missing.exr black.png", 3, NO_OUTPUT, r"cannot read missing.exr: No such file or directory"),
    ("compare black.png text.exr", 3, NO_OUTPUT, r"cannot read text.exr: .*"),
    ("compare black.png empty.exr", 3, NO_OUTPUT, r"cannot read empty.exr: .*"),
    ("compare black.png .", 3, NO_OUTPUT, r"cannot read .: it is a folder"),
    ("compare black.png grey.png --out no/a.exr", 5, NO_OUTPUT, r"cannot write no/a.exr: there is no such folder"),
    ("compare black.png grey.png --out folder.exr", 5, NO_OUTPUT, r"cannot write folder.exr: it is a folder"),
    ("render cornell.glb -o a.exr --size 8x8 --size 9x9", 2, NO_OUTPUT, r"render: --size is given more than once \(see .*"),
    # devices
    ("devices", 0, r"\* \d+  .* usable +yes.*", NO_OUTPUT),
    ("devices --json", 0, r'\[\n.*"usable": true.*\]\n', NO_OUTPUT),
    ("devices --jsn", 2, NO_OUTPUT, r"devices: unknown argument `--jsn`; did you mean `--json`\? .*"),
    ("devices 0", 2, NO_OUTPUT, r"devices: unknown argument `0` .*"),
    # scenes that cannot be read; render and info read them in the same way
    ("render missing.glb -o a.exr", 3, NO_OUTPUT, r"missing.glb: no such file"),
    ("render . -o a.exr", 3, NO_OUTPUT, r".: not a regular file"),
    ("render unknown.gtlf -o a.exr", 3, NO_OUTPUT, r"unknown.gtlf: the ending '.gtlf' is none of .gltf .glb .*"),
    ("render first_4.glb -o a.exr", 3, NO_OUTPUT, r"first_4.glb: .*"),
    ("render first_12.glb -o a.exr", 3, NO_OUTPUT, r"first_12.glb: .*"),
    ("render first_20.glb -o a.exr", 3, NO_OUTPUT, r"first_20.glb: .*"),
    ("render first_700.glb -o a.exr", 3, NO_OUTPUT, r"first_700.glb: GLB length \d+ is more than the file's 700 bytes"),
    ("info first_6619.glb", 3, NO_OUTPUT, r"first_6619.glb: GLB length 6620 is more than the file's 6619 bytes"),
    *((f"info empty.{ending}", 3, NO_OUTPUT, rf"empty.{ending}: the file is empty")
      for ending in ("glb", "gltf", "obj", "ply", "off", "stl")),
    *((f"info prose.{ending}", 3, NO_OUTPUT, rf"prose.{ending}: .*")
      for ending in ("glb", "gltf", "obj", "ply", "off", "stl")),
    # malformed scenes are refused, or repaired with a warning
    ("render cycle.gltf -o a.exr", 3, NO_OUTPUT, r"cycle.gltf: node 0 is reached twice: .*"),
    ("render indices.gltf -o a.exr", 3, NO_OUTPUT, r"indices.gltf: mesh 0 primitive 0: index 128 is out of range, .*"),
    ("render normals.gltf -o a.exr --size 8x6 --quiet --background 1,1,1", 0, NO_OUTPUT,
     r"warning: normals.gltf: .* 1 normals are zero or not finite; .*"),
    ("render prose.obj -o a.exr --stats s.json", 3, NO_OUTPUT, r"prose.obj: there is no triangle in it"),
    # render: the output
    ("render cornell.glb", 2, NO_OUTPUT, r"render: --output is required .*"),
    ("render cornell.glb -o a.gif", 2, NO_OUTPUT, r"a.gif: a picture is written as .exr, .png, .jpg, .webp or .tif"),
    ("render cornell.glb -o a", 2, NO_OUTPUT, r"a: a picture is written as .exr, .png, .jpg, .webp or .tif"),
    ("render cornell.glb -o cornell.glb", 2, NO_OUTPUT, r"cornell.glb: a picture is written as .exr, .png, .jpg, .webp or .tif"),
    ("render cornell.glb -o no/a.exr", 5, NO_OUTPUT, r"cannot write no/a.exr: there is no such folder"),
    ("render cornell.glb -o folder.exr", 5, NO_OUTPUT, r"cannot write folder.exr: it is a folder"),
    ("render cornell.glb -o a.exr --stats no/s.json", 5, NO_OUTPUT, r"cannot write no/s.json: there is no such folder"),
    ("render cornell.glb -o a.exr --stats folder.exr", 5, NO_OUTPUT, r"cannot write folder.exr: it is a folder"),
    ("render cornell.glb -o a.exr --stats ./a.exr", 2, NO_OUTPUT, r"--stats and --output name the same file"),
    # no result replaces what the program reads
    ("render cornell.glb -o a.exr --stats ./cornell.glb", 2, NO_OUTPUT, r"--stats and SCENE name the same file"),
    ("render cornell.glb -o black.png --env black.png", 2, NO_OUTPUT, r"--output and --env name the same file"),
    ("render cornell.glb -o a.exr --stats halves.json --partition halves.json", 2, NO_OUTPUT,
     r"--stats and --partition name the same file"),
    ("compare black.png grey.png --out black.png", 2, NO_OUTPUT, r"--out and A name the same file"),
    ("compare black.png grey.png --out ./grey.png", 2, NO_OUTPUT, r"--out and B name the same file"),
    ("bench traversal cornell.glb --json cornell.glb", 2, NO_OUTPUT, r"--json and SCENE name the same file"),
    ("bench traversal cornell.glb --rays text.exr --markdown text.exr", 2, NO_OUTPUT, r"--markdown and --rays name the same file"),
    ("bench traversal cornell.glb --json a.md --markdown a.md", 2, NO_OUTPUT, r"--markdown and --json name the same file"),
    # render: the picture's size
    *((f"render cornell.glb -o a.exr --size {size}", 2, NO_OUTPUT,
       rf"--size {size}: give WIDTHxHEIGHT in pixels, both at least 1")
      for size in ("0x0", "0x5", "10", "-5x5", "5x5x5", "axb", "1e3x5", "4294967296x1")),
    ("render cornell.glb -o a.exr --size 99999x99999", 6, NO_OUTPUT, r"--size 99999x99999: 9999800001 pixels are over .*"),
    # tree and table
    *((f"info cornell.glb --unit {unit}", 2, NO_OUTPUT, rf"--unit {unit}: .*")
      for unit in ("-1", "0", "1,0,1", "nan", "inf", "1e300", "1,2", "1,2,3,4", "1,,2", "wide")),
    ("info cornell.glb --unit 1e-9", 6, NO_OUTPUT, r"the unit length asks for .* choose a unit of at least .*"),
    *((f"info cornell.glb --cells {cells}", 2, NO_OUTPUT, rf"--cells {cells}: give the number of cells, at least 1")
      for cells in ("0", "-5", "0.5", "nan", "many")),
    *((f"info cornell.glb --cells {cells}", 6, NO_OUTPUT, r"a lattice of \d+ cells has more .* choose fewer than 1070599168 \(--cells\)")
      for cells in ("1000000000000", "1e12", "1e300", "inf")),
    ("info cornell.glb --tree-depth 999", 2, NO_OUTPUT, r"--tree-depth 999: give a whole number from 0 to \d+"),
    *((f"info cornell.glb --tree-depth {depth}", 2, NO_OUTPUT, rf"--tree-depth {depth}: give a whole number from 0 to \d+")
      for depth in ("-1", "1.5", "deep")),
    ("info cornell.glb --unit 1 --cells 5", 2, NO_OUTPUT, r"--unit and --cells exclude each other"),
    ("info cornell.glb --no-exit-boxes --preset paper", 0, r"vertices .*", NO_OUTPUT),
    # a partition of the user's own
    ("info cornell.glb --partition halves.json", 0, r".*\nlattice +2 x 1 x 1 .*\ntable +2 cells, 2 leaves\n.*", NO_OUTPUT),
    ("info cornell.glb --partition missing.json", 3, NO_OUTPUT, r"missing.json: no such file"),
    ("info cornell.glb --partition cornell.glb", 3, NO_OUTPUT, r"cornell.glb: is no JSON, at byte 1"),
    ("info cornell.glb --partition gap.json", 3, NO_OUTPUT, r"gap.json: no box holds cell 1 0 0"),
    ("info cornell.glb --partition overlap.json", 3, NO_OUTPUT, r"overlap.json: box 1 overlaps box 0 at cell 1 0 0"),
    ("info cornell.glb --partition huge.json", 6, NO_OUTPUT, r"huge.json: a meta table of .* takes 3815 MiB, more than .*"),
    ("info cornell.glb --partition halves.json --cells 9", 2, NO_OUTPUT, r"--cells and --partition exclude each other"),
    ("info cornell.glb --partition halves.json --merge", 2, NO_OUTPUT, r"--merge and --partition exclude each other"),
    # method 2
    ("info cornell.glb --table gcd --tree-depth 4", 0, r".*\nplanes +moved by at most .*", NO_OUTPUT),
    ("info cornell.glb --table gcd --quantum 0.0001", 6, NO_OUTPUT,
     r"the tree's planes ask for \d+ x \d+ x \d+ cells \(\d+ MiB\), .* at most 1023 on an axis; choose a larger quantum .* \(--quantum, --tree-depth\)"),
    ("info cornell.glb --table gcd --quantum 1e-9", 2, NO_OUTPUT, r"a quantum of 1e-09 is finer than .* give at least 2.13\d*e-06 .* \(--quantum\)"),
    *((f"info cornell.glb --table gcd --quantum {quantum}", 2, NO_OUTPUT, rf"--quantum {quantum}: give a length .*")
      for quantum in ("0", "-1", "nan", "inf")),
    ("info cornell.glb --quantum 0.1", 2, NO_OUTPUT, r"--quantum needs --table"),
    ("info cornell.glb --table gcd --unit 0.1", 2, NO_OUTPUT, r"this table takes its cells from the tree's planes: .* \(--table, --unit, .*\)"),
    ("info cornell.glb --table gcd --cells 9", 2, NO_OUTPUT, r"this table takes its cells from the tree's planes: .*"),
    ("info cornell.glb --table gcd --partition halves.json", 2, NO_OUTPUT, r"this table takes its cells from .*"),
    # uneven cells
    ("info cornell.glb --table rectilinear", 0, r".*\nrectilinear +\d+ x \d+ x \d+ planes of a tree of depth \d+, .*", NO_OUTPUT),
    ("info cornell.glb --table rectilinear --tree-depth 4 --no-exit-boxes", 0, r".* planes of a tree of depth 4, .*", NO_OUTPUT),
    ("info {scenes}/objects.glb --table rectilinear --tree-depth 40", 6, NO_OUTPUT,
     r"a rectilinear table of tree depth 40 has \d+ x \d+ x \d+ cells \(\d+ MiB\), .*; the deepest that fits is \d+ "
     r"\(--tree-depth\)"),
    *((f"info cornell.glb --table rectilinear {words}", 2, NO_OUTPUT,
       r"this table takes its cells from the tree's planes: a unit length, a number of cells and a partition exclude it "
       r"\(--table, --unit, --cells, --partition\)")
      for words in ("--unit 0.1", "--cells 9", "--partition halves.json")),
    ("info cornell.glb --table rectilinear --merge", 2, NO_OUTPUT, r"merging joins .*: a rectilinear table excludes it \(--merge, --table\)"),
    ("info cornell.glb --table rectilinear --quantum 0.1", 2, NO_OUTPUT, r"a quantum is for the gcd table alone \(--quantum, --table\)"),
    *((f"render cornell.glb -o a.exr --table rectilinear --traversal {traversal}", 2, NO_OUTPUT,
       rf"the rectilinear table is marched by rectilinear_table alone, not by {traversal} \(--table, --traversal\)")
      for traversal in ("meta_table", "kd_stack", "brute_force")),
    ("bench traversal cornell.glb --table rectilinear --traversals rectilinear_table,kd_ropes", 2, NO_OUTPUT,
     r"the rectilinear table is marched by rectilinear_table alone, not by kd_ropes \(--table, --traversal\)"),
    ("info cornell.glb --table fast", 2, NO_OUTPUT, r"--table fast: give unit, gcd or rectilinear"),
    ("info cornell.glb --preset fast", 2, NO_OUTPUT, r"--preset fast: give paper"),
    *((f"info cornell.glb --scale {scale}", 2, NO_OUTPUT, r"--scale .*: give a finite number other than 0")
      for scale in ("0", "nan", "inf", "1e300", "1e-300")),
    ("info cornell.glb --scale 1e30", 3, NO_OUTPUT, r"the scene's longest side is 5.59e\+29, .* scale it \(--scale\)"),
    ("info cornell.glb --scale -1", 0, r"vertices +64\n.*", NO_OUTPUT),
    ("info cornell.glb --scale 1e-30", 0, ANYTHING, r"warning: all 32 triangles are degenerate, nothing is visible; .*"),
    # choices of the scene's parts
    ("info cornell.glb --scene 0", 0, r"vertices +64\n.*", NO_OUTPUT),
    ("info cornell.glb --scene side", 2, NO_OUTPUT, r"there is no scene side; the file has 0 '.*' \(--scene\)"),
    ("info cornell.glb --variant red", 2, NO_OUTPUT, r"there is no variant red; the file has none \(--variant\)"),
    ("info variants.gltf --variant blue", 2, NO_OUTPUT, r"there is no variant blue; the file has 0 'red', 1 'green' \(--variant\)"),
    ("info variants.gltf --variant green", 0, r"vertices +3\n.*", NO_OUTPUT),
    ("info painted.gltf", 3, NO_OUTPUT, r"painted.gltf: texture 'gone.png' is missing \(--allow-missing-textures\)"),
    ("info painted.gltf --allow-missing-textures", 0, r"vertices +3\n.*",
     r"warning: painted.gltf: texture 'gone.png' is missing; its uses are left out"),
    ("info cornell.glb --time 1", 0, r"vertices +64\n.*", r"warning: cornell.glb: there is no animation, .*"),
    ("info cornell.glb --time nan", 2, NO_OUTPUT, r"--time nan: give finite seconds"),
    ("info cornell.glb --time 1 --animation walk", 2, NO_OUTPUT,
     r"there is no animation walk; the file has none \(--animation\)"),
    ("info cornell.glb --animation walk", 2, NO_OUTPUT, r"--animation needs --time"),
    # render: device and method
    ("render cornell.glb -o a.exr --device 99", 4, NO_OUTPUT, r"device 99: there is no such device; devices: 0: .* \(--device\)"),
    ("render cornell.glb -o a.exr --device nonsense", 4, NO_OUTPUT, r"device 'nonsense': fits no usable device; .* \(--device\)"),
    ("render cornell.glb -o a.exr --backend cpu --device 0", 2, NO_OUTPUT, r"a device is for the gpu \(--backend, --device\)"),
    ("render cornell.glb -o a.exr --backend cpu --traversal bvh_stack", 2, NO_OUTPUT,
     r"on the cpu there are kd_stack and meta_table; bvh_stack is for the gpu \(--backend, --traversal\)"),
    ("render cornell.glb -o a.exr --backend cpu --traversal kd_ropes --integrator primary", 2, NO_OUTPUT,
     r"on the cpu there are kd_stack and meta_table; kd_ropes is for the gpu \(--backend, --traversal\)"),
    ("render cornell.glb -o a.exr --size 8x8 --spp 1 --backend cpu", 0, r"a.exr: 8 x 8, 32 triangles, meta_table on cpu .*", NO_OUTPUT),
    ("render cornell.glb -o a.exr --size 8x8 --spp 1 --backend cpu --traversal kd_stack", 0,
     r"a.exr: 8 x 8, 32 triangles, kd_stack on cpu .*", NO_OUTPUT),
    ("render cornell.glb -o a.exr --traversal fast", 2, NO_OUTPUT, r"--traversal fast: give meta_table, .* or ray_query"),
    ("render cornell.glb -o a.exr --integrator fast", 2, NO_OUTPUT, r"--integrator fast: give path, direct, ao or primary"),
    *((f"render cornell.glb -o a.exr --{option} {value}", 2, NO_OUTPUT, rf"--{option} {value}: .*")
      for option, value in (("spp", "0"), ("spp", "99999999"), ("max-bounces", "99999"), ("clamp", "-1"), ("clamp", "nan"),
                            ("env-rotation", "inf"), ("env-intensity", "-1"), ("env-max", "0"), ("env-max", "inf"), ("env-intensity", "nan"), ("background", "1,2"),
                            ("background", "1,-1,1"), ("background", "white"), ("sun", "0,0,0"), ("sun", "up"))),
    *((f"render cornell.glb -o a.exr --{option} {value}", 2, NO_OUTPUT, rf"--{option} {value}: .*")
      for option, value in (("aperture", "-1"), ("aperture", "inf"), ("focus-distance", "0"), ("focus-distance", "nan"),
                            ("exposure", "nan"), ("exposure", "1000"))),
    ("render cornell.glb -o a.exr --focus-distance 2", 2, NO_OUTPUT, r"--focus-distance needs --aperture"),
    ("render cornell.glb -o a.exr --panorama --aperture 1", 2, NO_OUTPUT, r"--aperture and --panorama exclude each other"),
    ("render cornell.glb -o a.exr --panorama --vfov 40", 2, NO_OUTPUT, r"--vfov and --panorama exclude each other"),
    ("render cornell.glb -o a.exr --filter tent --integrator primary", 2, NO_OUTPUT, r"the rays of `primary` go .* \(--integrator, --aperture, --filter, --panorama\)"),
    ("render cornell.glb -o a.exr --filter gauss", 2, NO_OUTPUT, r"--filter gauss: give box, tent or blackman-harris"),
    ("render cornell.glb -o a.exr --tone-map film", 2, NO_OUTPUT, r"--tone-map film: give none, neutral, aces or agx"),
    ("render cornell.glb -o a.exr --spp g", 2, NO_OUTPUT, r"--spp g: give a whole number from 1 to \d+"),
    ("render cornell.glb -o a.exr --spp many", 2, NO_OUTPUT, r"--spp many: give a whole number from 1 to \d+"),
    ("render cornell.glb -o a.exr --brdf phong", 2, NO_OUTPUT, r"--brdf phong: give compensated or gltf"),
    ("render cornell.glb -o a.exr --sky --background 1,1,1", 2, NO_OUTPUT, r"--background and --sky exclude each other"),
    ("render cornell.glb -o a.exr --env-max 9", 2, NO_OUTPUT, r"--env-max needs --env"),
    ("render cornell.glb -o a.exr --env missing.hdr", 3, NO_OUTPUT, r"cannot read missing.hdr: No such file or directory"),
    ("render cornell.glb -o a.exr --env text.exr", 3, NO_OUTPUT, r"cannot read text.exr: .*"),
    ("render cornell.glb -o a.exr --backend fast", 2, NO_OUTPUT, r"--backend fast: give gpu or cpu"),
    # render: the camera
    ("render cornell.glb -o a.exr --camera side", 2, NO_OUTPUT, r"there is no camera side; the scene has 0 'front' \(--camera\)"),
    ("render cornell.glb -o a.exr --camera 1", 2, NO_OUTPUT, r"there is no camera 1; .*"),
    ("render {scenes}/degenerate.glb -o a.exr --camera 0", 2, NO_OUTPUT, r"camera 0: the scene has no camera; .*"),
    ("render cornell.glb -o a.exr --eye 1,2,3", 2, NO_OUTPUT, r"--eye needs --target"),
    ("render cornell.glb -o a.exr --target 1,2,3", 2, NO_OUTPUT, r"--target needs --eye"),
    ("render cornell.glb -o a.exr --up 0,1,0", 2, NO_OUTPUT, r"--up needs --eye"),
    ("render cornell.glb -o a.exr --eye 0,2,0 --target 0,0,0 --camera 0", 2, NO_OUTPUT, r"--camera and --eye exclude .*"),
    *((f"render cornell.glb -o a.exr --eye {eye} --target 0,0,0", 2, NO_OUTPUT,
       rf"--eye {eye}: give three numbers, x,y,z") for eye in ("1,2", "1,2,3,4", "0,nan,0", "0,1e39,0", "here")),
    ("render cornell.glb -o a.exr --eye 1,2,3 --target 1,2,3", 2, NO_OUTPUT, r"eye and target are the same point \(--eye, --target\)"),
    ("render cornell.glb -o a.exr --eye 0,2,0 --target 0,0,0", 2, NO_OUTPUT, r"up is zero or along the view; .* \(--up\)"),
    ("render cornell.glb -o a.exr --eye 0,0,2 --target 0,0,0 --up 0,0,0", 2, NO_OUTPUT, r"up is zero or along .*"),
    *((f"render cornell.glb -o a.exr --vfov {degrees}", 2, NO_OUTPUT,
       rf"--vfov {degrees}: give degrees between 0 and 180") for degrees in ("0", "180", "-10", "nan", "inf")),
    ("render cornell.glb -o a.exr --vfov wide", 2, NO_OUTPUT, r"--vfov wide: give degrees between 0 and 180"),
    # render: words
    ("render cornell.glb -o a.exr --sise 5x5", 2, NO_OUTPUT, r"render: unknown argument `--sise`; did you mean `--size`\? .*"),
    ("render cornell.glb b.glb -o a.exr", 2, NO_OUTPUT, r"render: unknown argument `b.glb` .*"),
    ("render cornell.glb -o a.exr --size", 2, NO_OUTPUT, r"render: --size: 1 required WxH missing .*"),
    ("render cornell.glb -o a.exr --size 8x8 --backend cpu --integrator primary", 0, r"a.exr: 8 x 8, 32 triangles, meta_table on cpu .*", NO_OUTPUT),
]


class ArgumentsTest(ProgramTest):
    def setUp(self):
        super().setUp()
        make_files(self.tmp)

    def test_cases(self):
        folders = queue.SimpleQueue()  # one for each process
        for i in range(PROCESSES):
            folder = self.tmp / str(i)
            folder.mkdir()
            make_files(folder)
            folders.put(folder)

        def run(case):
            folder = folders.get()
            before = sorted(folder.iterdir())
            result = self.run_program(*case[0].format(scenes=SCENES).split(), cwd=folder)
            after = sorted(folder.iterdir())
            folders.put(folder)
            return result, before, after

        with ThreadPoolExecutor(PROCESSES) as pool:
            for (arguments, code, stdout, stderr), (result, before, after) in zip(CASES, pool.map(run, CASES)):
                with self.subTest(arguments=arguments):
                    self.assertEqual(result.returncode, code, result.stderr)
                    self.assertTrue(re.fullmatch(stdout, result.stdout, re.DOTALL), result.stdout)
                    line = rf"metamarch: (?:{stderr})\n" if stderr else ""
                    self.assertTrue(re.fullmatch(line, result.stderr), result.stderr)
                    if code != 0:
                        self.assertEqual(after, before)

    def test_no_driver(self):
        for words in (["devices"], ["render", "cornell.glb", "-o", "a.exr"]):
            line = self.refuse(4, *words, VK_DRIVER_FILES="/nonexistent", VK_ICD_FILENAMES="/nonexistent")
            self.assertRegex(line, r"no Vulkan driver: install .*")

    def test_a_full_disk_shows_on_stdout(self):
        with open("/dev/full", "wb") as full:
            for words in (["info", "cornell.glb"], ["devices", "--json"], ["--version"]):
                result = subprocess.run([metamarch(), *words], cwd=self.tmp, stdout=full, stderr=subprocess.PIPE, text=True,
                                        check=False, env={**os.environ, **self.environment})
                self.assertEqual((result.returncode, result.stderr),
                                 (5, "metamarch: cannot write to standard output\n"), words)


if __name__ == "__main__":
    main()

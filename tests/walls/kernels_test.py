# SPDX-License-Identifier: MIT
"""A kernel for a set of instructions defines one name for the linker: its own.

A function of another name, such as an inline function of the standard library, could take the place of the same function
that was compiled for every processor, and would then end the program on an older one.

    kernels_test.py OBJECT...
"""

import pathlib
import subprocess
import sys

# What a compiler may call where the processor has no instruction for it.
CALLED = {"memcpy", "memmove", "memset", "floorf", "sqrtf", "_GLOBAL_OFFSET_TABLE_"}


def main(objects):
    faults = 0
    for file in objects:
        text = subprocess.run(["nm", "-P", "--extern-only", "--demangle=none", file], check=True, capture_output=True,
                              text=True).stdout
        own = [name for name, kind, *_ in map(str.split, text.splitlines()) if kind == "T"]
        others = [name for name, kind, *_ in map(str.split, text.splitlines())
                  if kind != "T" and not (kind == "U" and name in CALLED)]
        if len(own) != 1 or pathlib.Path(file).stem not in own[0] or others:
            print(f"{file}: defines {own}, and has {others} besides")
            faults += 1
    if not objects:
        sys.exit("there is no object")
    sys.exit(1 if faults else 0)


main(sys.argv[1:])

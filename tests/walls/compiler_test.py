# SPDX-License-Identifier: MIT
"""With the compile flags of a library, the compiler finds no header of a library that it does not link."""

import json
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

from libraries import read_libraries, visible


def compile_flags(commands, library):
    """Returns the compiler and its flags for a source of the library, without the file and the output."""
    together = f"/metamarch_{library.name}.dir/Unity/"  # where CMake compiles several sources as one
    entry = next(entry for entry in commands if Path(entry["file"]) in library.sources or together in entry["file"])
    words = shlex.split(entry["command"])
    first = next(i for i, word in enumerate(words) if Path(word).name != "ccache")
    return words[first : words.index("-o")], entry["directory"]


def compile_text(flags, directory, text):
    with tempfile.NamedTemporaryFile("w", suffix=".cpp") as file:
        file.write(text)
        file.flush()
        return subprocess.run([*flags, "-fsyntax-only", file.name], cwd=directory, capture_output=True, text=True)


def main():
    libraries = read_libraries(sys.argv[1])
    commands = json.loads(Path(sys.argv[2]).read_text())
    count = 0
    for library in libraries.values():
        if not library.sources:
            continue  # a library without sources has no compile flags
        flags, directory = compile_flags(commands, library)
        empty = compile_text(flags, directory, "")
        assert empty.returncode == 0, f"{library.name}: {empty.stderr}"
        targets = visible(libraries, library)
        for other in libraries.values():
            if other is library or f"metamarch_{other.name}" in targets:
                continue
            header = f"metamarch/{other.name}/{other.headers[0].relative_to(other.folder)}"
            result = compile_text(flags, directory, f'#include "{header}"\n')
            assert result.returncode != 0, f"{library.name} finds {header}"
            assert f"{header}: No such file" in result.stderr, f"{library.name}: {result.stderr}"
            count += 1
    print(f"{count} forbidden includes do not compile")
    assert count > 0, "every library sees every other"


main()

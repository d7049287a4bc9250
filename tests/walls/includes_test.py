# SPDX-License-Identifier: MIT
"""Every #include of a library names a header of its own, of a library that it links, or of the standard library."""

import re
import sys
from pathlib import Path

from libraries import read_libraries, visible

# (prefix of header names, target that provides them, libraries that may use them; None: every library that links it)
OTHERS = [
    ("CLI/", "CLI11::CLI11", ["cli"]),
    ("GLFW/", "glfw", ["viewer"]),
    ("OpenImageIO/", "OpenImageIO::OpenImageIO", ["image", "scene"]),
    ("backends/imgui_", "PkgConfig::imgui", ["viewer"]),
    ("draco/", "draco::draco", ["scene"]),
    ("embree3/", "embree", ["bench"]),
    ("fmt/", "fmt::fmt", None),
    ("glm/", "glm::glm", None),
    ("glslang/", "glslang::glslang", ["viewer"]),
    ("imgui.h", "PkgConfig::imgui", ["viewer"]),
    ("meshoptimizer.h", "meshoptimizer::meshoptimizer", ["scene"]),
    ("nlohmann/", "nlohmann_json::nlohmann_json", None),
    ("spirv/", "SPIRV-Headers::SPIRV-Headers", ["vulkan"]),
    ("tbb/", "TBB::tbb", None),
    ("tiny_gltf.h", "TinyGLTF::TinyGLTF", ["scene"]),
    ("vulkan/", "Vulkan::Vulkan", ["vulkan", "render", "bench", "viewer", "cli"]),
    ("webp/", "PkgConfig::WEBP", ["scene"]),
]
POSIX = ["dlfcn.h", "fcntl.h", "poll.h", "unistd.h", "sys/"]
# Vectors of the processor, in one file.
INTRINSICS = "immintrin.h", "shaders/processor/lanes.h"
# This file prints the versions of the libraries that the program is built with.
VERSIONS = "host/cli/version.cpp"

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)


def complaint(libraries, library, targets, file, bracket, header):
    """Returns the fault of an include, or None."""
    if header == INTRINSICS[0]:
        return None if str(file).endswith(INTRINSICS[1]) else f"only {INTRINSICS[1]} may include it"
    own = re.match(r"metamarch/([^/]+)/(.+)", header)
    if own:
        name, path = own.groups()
        if name != library.name and f"metamarch_{name}" not in targets:
            return f"{library.name} does not link {name}"
        if name != library.name and path.split("/")[0] in libraries[name].internal:
            return f"the header is internal to {name}"
        if library.name == "shared":
            return "GLSL reads the headers of shared too, by bare names"
        return None
    if bracket == '"':
        if library.name == "shared":
            return None if (library.folder / header).is_file() else "no header of shared has this name"
        # The build writes these headers, each for one file.
        is_written = (header == "git_commit.h" and str(file).endswith(VERSIONS)
                      or library.name == "shaders" and header == Path(file).stem + ".h")
        return None if is_written else "not a path from metamarch/"
    if re.fullmatch(r"[a-z0-9_]+", header) or header.startswith(tuple(POSIX)):
        return None
    for beginning, target, users in OTHERS:
        if header.startswith(beginning):
            if str(file).endswith(VERSIONS):
                return None
            if users is not None and library.name not in users:
                return f"only {', '.join(users)} may include it"
            return None if target in targets else f"{library.name} does not link {target}"
    return "tests/walls/includes_test.py does not know whose header it is"


def main():
    libraries = read_libraries(sys.argv[1])
    complaints = []
    count = 0
    for library in libraries.values():
        targets = visible(libraries, library)
        for file in library.headers + library.sources:
            if file.suffix == ".o":
                continue  # of a kernel, whose source includes lanes.h alone
            for bracket, header in INCLUDE.findall(Path(file).read_text()):
                count += 1
                found = complaint(libraries, library, targets, file, bracket, header)
                if found:
                    complaints.append(f"{file}: {header}: {found}")
    print("\n".join(complaints))
    print(f"{count} includes of {len(libraries)} libraries, {len(complaints)} behind a wall")
    assert count > 1000, "too few includes were found"
    sys.exit(1 if complaints else 0)


main()

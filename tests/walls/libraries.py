# SPDX-License-Identifier: MIT
"""Reads the libraries as CMake knows them from the file that tests/walls/CMakeLists.txt writes."""

import json
import re
from pathlib import Path


def split(links):
    """Returns the names in a CMake list, without generator expressions around them."""
    return [re.sub(r"^\$<(?:LINK_ONLY|BUILD_INTERFACE):(.*)>$", r"\1", link) for link in links.split(";") if link]


class Library:
    def __init__(self, entry):
        self.name = entry["name"]
        self.folder = Path(entry["METAMARCH_FOLDER"])
        self.internal = split(entry["METAMARCH_INTERNAL"])
        self.sources = [self.folder / source for source in split(entry["SOURCES"])]
        self.headers = sorted(self.folder.rglob("*.h"))
        # `public` are the targets that it passes on to libraries that link it, `links` those that it links itself.
        interface = entry["INTERFACE_LINK_LIBRARIES"]
        self.public = split(";".join(link for link in interface.split(";") if "LINK_ONLY" not in link))
        self.links = split(entry["LINK_LIBRARIES"]) or self.public


def read_libraries(file):
    """Returns {name: Library}."""
    return {entry["name"]: Library(entry) for entry in json.loads(Path(file).read_text())}


def visible(libraries, library):
    """Returns the targets whose headers `library` may include: those that it links, and those that these pass on."""
    seen = set()
    waiting = list(library.links)
    while waiting:
        link = waiting.pop()
        if link not in seen:
            seen.add(link)
            known = libraries.get(link.removeprefix("metamarch_")) if link.startswith("metamarch_") else None
            waiting += known.public if known else []
    return seen

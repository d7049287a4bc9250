#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes a synthetic data set: views all around a scene, each with its picture, mask, depth, normals and camera.

    views.py SCENE FOLDER [--views 100] [--size 256x256] [--spp 64]

FOLDER/000.png is the first picture; FOLDER/000.npz holds
  mask             (h, w), float32: part of the pixel that something covers
  mesh             (h, w), uint32: index of the mesh, 4294967295 for none
  depth            (h, w), float32: distance along the view axis in metres, 0 for none
  normal           (h, w, 3), float32: geometric normal in world space
  world_to_camera  (4, 4), float32: x right, y up, z ahead
"""
import argparse
import math
from pathlib import Path

import metamarch
import numpy as np


def directions(count):
    """Returns directions spread evenly over the upper half of a sphere, on a spiral whose turns are golden angles."""
    for i in range(count):
        y = (i + 0.5) / count
        angle = i * math.pi * (3 - math.sqrt(5))
        across = math.sqrt(1 - y * y)
        yield np.array((across * math.cos(angle), y, across * math.sin(angle)))


def make_views(file, folder, count, size, spp):
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    scene = metamarch.load(file)
    low, high = scene.bounds
    target = (low + high) / 2
    distance = 1.2 * np.linalg.norm(high - low)
    for number, direction in enumerate(directions(count)):
        film = metamarch.render(scene, eye=target + distance * direction, target=target, size=size, spp=spp,
                                aov=("N", "Z", "id.mesh"), miss_depth=0, transparent=True)
        film.save(folder / f"{number:03}.png")
        np.savez_compressed(folder / f"{number:03}.npz", mask=film["A"], mesh=film["id.mesh"], depth=film["Z"],
                            normal=film["N"], world_to_camera=film.world_to_camera)


def main(words=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scene")
    parser.add_argument("folder")
    parser.add_argument("--views", type=int, default=100)
    parser.add_argument("--size", default="256x256")
    parser.add_argument("--spp", type=int, default=64)
    given = parser.parse_args(words)
    make_views(given.scene, given.folder, given.views, given.size, given.spp)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Turns a camera around a scene and writes a GIF. Takes Pillow.

    turntable.py SCENE OUT.gif [--pictures 24] [--size 320x240] [--spp 32]
"""
import argparse
import math

import metamarch
import numpy as np
from PIL import Image


def pictures(scene, count, size, spp):
    low, high = scene.bounds
    target = (low + high) / 2
    distance = 1.2 * np.linalg.norm(high - low)
    for i in range(count):
        angle = 2 * math.pi * i / count
        eye = target + distance * np.array((math.sin(angle), 0.4, math.cos(angle)))
        yield metamarch.render(scene, eye=eye, target=target, size=size, spp=spp).rgba8()


def main(words=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scene")
    parser.add_argument("output")
    parser.add_argument("--pictures", type=int, default=24)
    parser.add_argument("--size", default="320x240")
    parser.add_argument("--spp", type=int, default=32)
    given = parser.parse_args(words)
    scene = metamarch.load(given.scene)
    first, *others = [Image.fromarray(pixels).convert("RGB")
                      for pixels in pictures(scene, given.pictures, given.size, given.spp)]
    first.save(given.output, save_all=True, append_images=others, duration=80, loop=0)


if __name__ == "__main__":
    main()

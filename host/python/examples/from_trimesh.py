#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Renders a mesh of trimesh, and casts rays at it. Takes trimesh.

    from_trimesh.py OUT.png
"""
import sys

import metamarch
import numpy as np
import trimesh


def scene_of(mesh):
    """Returns the scene of a trimesh.Trimesh, with smooth normals."""
    return metamarch.from_arrays(mesh.vertices, mesh.faces, normals=mesh.vertex_normals,
                                 material={"baseColorFactor": (0.7, 0.5, 0.3, 1), "metallicFactor": 0,
                                           "roughnessFactor": 0.5})


def depths(scene, count):
    """Returns how far rays go down from above, on a grid of count x count; inf where they miss."""
    low, high = scene.bounds
    x, z = np.meshgrid(np.linspace(low[0], high[0], count), np.linspace(low[2], high[2], count))
    origins = np.stack([x.ravel(), np.full(x.size, high[1] + 1), z.ravel()], axis=1)
    hits = metamarch.Tracer(scene).trace(origins, np.broadcast_to((0, -1, 0), origins.shape))
    return hits.t.reshape(count, count)


def main(words=None):
    (output,) = sys.argv[1:] if words is None else words
    scene = scene_of(trimesh.creation.icosphere(subdivisions=3))
    metamarch.render(scene, size=(320, 240), spp=16).save(output)
    print(f"the highest point is {1 - (depths(scene, 65).min() - 1):.3f} m above the centre's plane")


if __name__ == "__main__":
    main()

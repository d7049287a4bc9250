#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares the importers with trimesh, an independent reader: triangles and bounds of each scene in a folder.

    importers_test.py METAMARCH [FOLDER]

tools/test --long runs this with trimesh from PyPI. Bounds are those of the triangles' corners in world space, so they
also compare the transforms. Vertices are not compared: readers join them by different rules.
"""
import json
import pathlib
import subprocess
import sys

import numpy
import trimesh

ENDINGS = {".gltf", ".glb", ".obj", ".ply", ".off", ".stl"}
# What trimesh 5 does not read as the specification asks, with the reason.
SKIPPED = {
    "Duck-Draco": "Draco",
    "CesiumMan": "skins",
    "RiggedSimple": "skins",
    "SimpleSkin": "skins",
    "SimpleMorph": "morph targets",
    "MorphPrimitivesTest": "morph targets",
    "SimpleSparseAccessor": "sparse accessors",
    "SimpleInstancing": "EXT_mesh_gpu_instancing",
    "malformed": "files that no reader agrees on",
    "primitive_modes": "strips, fans, points and lines",
    "MeshPrimitiveModes": "strips and fans",
}


def by_metamarch(program, path):
    report = json.loads(subprocess.run([program, "info", "--json", path], check=True, capture_output=True, text=True).stdout)
    bounds = report["bounds"]
    return report["triangles"], numpy.array([bounds["min"], bounds["max"]])


def by_trimesh(path):
    loaded = trimesh.load(path, process=False, force="scene")
    triangles = 0
    corners = []
    for node in loaded.graph.nodes_geometry:
        transform, name = loaded.graph[node]
        mesh = loaded.geometry[name]
        if isinstance(mesh, trimesh.Trimesh) and len(mesh.faces) > 0:
            triangles += len(mesh.faces)
            used = mesh.vertices[numpy.unique(mesh.faces)]
            corners.append(trimesh.transform_points(used, transform))
    corners = numpy.concatenate(corners)
    return triangles, numpy.array([corners.min(axis=0), corners.max(axis=0)])


def main():
    program = sys.argv[1]
    folder = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else "../shared/scenes")
    compared = wrong = 0
    for path in sorted(folder.rglob("*")):
        if path.suffix.lower() not in ENDINGS or any(word in str(path) for word in SKIPPED):
            continue
        ours, theirs = by_metamarch(program, path), by_trimesh(path)
        compared += 1
        # Both compute in single precision at places.
        near = 1e-5 * numpy.abs(theirs[1]).max()
        if ours[0] != theirs[0] or numpy.abs(ours[1] - theirs[1]).max() > near:
            wrong += 1
            print(f"{path}: {ours[0]} triangles in {ours[1].tolist()}; trimesh: {theirs[0]} in {theirs[1].tolist()}")
    print(f"{compared} scenes compared, {wrong} differ")
    return 1 if wrong or not compared else 0


if __name__ == "__main__":
    sys.exit(main())

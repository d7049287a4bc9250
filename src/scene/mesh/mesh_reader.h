// SPDX-License-Identifier: MIT
// The readers of mesh files. The reader that checks a file is the one that delivers its mesh.
#pragma once
#include "metamarch/file/input_file.h"
#include "metamarch/scene/material.h"
#include "metamarch/scene/mesh/polygon_mesh.h"
#include "metamarch/scene/texture/texture_loader.h"

#include <string_view>
#include <vector>

namespace metamarch {

struct MeshFile {
    PolygonMesh polygons; // faceMaterial holds indices into materials
    // Materials, textures and sources as loadTextures takes them.
    std::vector<Material> materials;
    std::vector<Texture> textures;
    std::vector<TextureSource> textureSources;
    // Whether the file repeats a position for each corner that uses it: equal ones become one vertex.
    bool repeatsPositions = false;
};

// Each reads the whole content of `file`. Each throws Error(inputRefused) unless every element that the file
// announces is there, every number can be parsed and every index is in range. No allocation is larger than
// a multiple of the file's size. What is skipped is in the file's warnings.

// PLY by G. Turk, "The PLY Polygon File Format" (1994), in all three encodings, and what others added:
// triangle strips and range grids (Stanford), texture coordinates of corners and `comment TextureFile`
// (MeshLab).
MeshFile readPly(InputFile& file, std::string_view bytes);

// OFF by the manual of Geomview, text and binary.
MeshFile readOff(InputFile& file, std::string_view bytes);

// STL by 3D Systems, "StereoLithography Interface Specification" (1989), text and binary, and the two ways in
// which programs put a colour into the attribute of a binary facet.
MeshFile readStl(InputFile& file, std::string_view bytes);

// OBJ by Wavefront ("B1. Object files", appendix of the manual of Advanced Visualizer, 1995): its polygons,
// and the libraries of materials that it names, from its folder. Also colours of vertices, which others
// added.
MeshFile readObj(InputFile& file, std::string_view bytes);

// Ends the face whose corners were appended last. Throws Error(outOfMemory) if there are more corners than an
// index can count.
inline void endFace(const InputFile& file, PolygonMesh& mesh) {
    if (mesh.cornerPosition.size() >= kNoIndex) {
        file.refuseSize("there are more than " + std::to_string(kNoIndex) + " corners of faces");
    }
    mesh.faceEnd.push_back(static_cast<std::uint32_t>(mesh.cornerPosition.size()));
}

} // namespace metamarch

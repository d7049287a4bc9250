// SPDX-License-Identifier: MIT
// Imports OBJ, PLY, OFF and STL into a Scene.
#pragma once
#include "metamarch/file/input_file.h"
#include "metamarch/scene/import.h"
#include "metamarch/scene/scene.h"

#include <string>

namespace metamarch {

// `ending` is one of ".obj" ".ply" ".off" ".stl"; `options` are those of loadScene. Polygons are divided into
// triangles (triangulate.h); a face of three corners is kept even without area. Corners with equal attributes
// share a vertex. Throws like loadScene. A file without triangles is refused, because any text is a valid
// empty OBJ.
Scene importMesh(InputFile& file, const std::string& ending, const ImportOptions& options);

} // namespace metamarch

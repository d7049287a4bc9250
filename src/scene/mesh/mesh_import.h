// SPDX-License-Identifier: MIT
// Imports OBJ, PLY, OFF and STL into a Scene, with Assimp.
#pragma once
#include "metamarch/file/input_file.h"
#include "metamarch/scene/import.h"
#include "metamarch/scene/scene.h"

#include <string>

namespace metamarch {

// `ending` is one of ".obj" ".ply" ".off" ".stl"; `options` are those of loadScene. Polygons are
// triangulated; degenerate faces are kept. Where Assimp splits shared vertices into one per corner (OBJ,
// STL), vertices with equal attributes are joined again. Throws like loadScene. A file without triangles is
// refused, because any text is a valid empty OBJ.
Scene importMesh(InputFile& file, const std::string& ending, const ImportOptions& options);

} // namespace metamarch

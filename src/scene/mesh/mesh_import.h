// OBJ, PLY, OFF and STL to Scene, through Assimp.
#pragma once
#include "metamarch/file/input_file.h"
#include "metamarch/scene/import.h"
#include "metamarch/scene/scene.h"

#include <string>

namespace metamarch {

// `ending` is one of ".obj" ".ply" ".off" ".stl"; `options` as in loadScene. Polygons are triangulated,
// degenerate faces kept. Vertices that the format shares but Assimp gives once per corner (OBJ, STL) are
// joined again where all they have is equal. Throws as loadScene; a file without a triangle is refused, since
// any text passes for an empty OBJ.
Scene importMesh(InputFile& file, const std::string& ending, const ImportOptions& options);

} // namespace metamarch

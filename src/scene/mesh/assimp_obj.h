// SPDX-License-Identifier: MIT
// Reads OBJ with its MTL by Assimp.
#pragma once
#include "metamarch/scene/mesh/mesh_reader.h"

namespace metamarch {

MeshFile readObjWithAssimp(InputFile& file);

} // namespace metamarch

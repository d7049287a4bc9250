// glTF primitives to triangles.
#pragma once
#include "scene/instance_writer.h"
#include "scene/scene_file.h"

#include <tiny_gltf.h>

namespace metamarch {

// Writes every primitive of the mesh that has triangles: lists, strips and fans, indexed or not. Points and
// lines get a warning, as do morph targets of non-zero weight, whose shape is not applied.
void writeMesh(const tinygltf::Model& model, SceneFile& file, int mesh, InstanceWriter& writer);

// How error lines name the mesh. Throws Error(sceneRefused), starting with `label`, when there is no such
// mesh.
std::string meshLabel(const tinygltf::Model& model, const SceneFile& file, const std::string& label,
                      int mesh);

} // namespace metamarch

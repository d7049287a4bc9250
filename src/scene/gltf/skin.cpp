// SPDX-License-Identifier: MIT
#include "metamarch/scene/gltf/skin.h"

#include "metamarch/scene/gltf/accessor.h"
#include "metamarch/scene/normal_matrix.h"

#include <numeric>
#include <span>

namespace metamarch {
namespace {

// Returns the weighted mean of the joints' matrices. Weights sum to 1 except for rounding; if all are zero,
// the first joint alone counts.
glm::dmat4 meanMatrix(std::span<const JointInfluence> influences, const std::vector<glm::dmat4>& matrices) {
    glm::dmat4 sum(0.0);
    double weights = 0.0;
    for (const JointInfluence& influence : influences) {
        sum += static_cast<double>(influence.weight) * matrices[influence.joint];
        weights += static_cast<double>(influence.weight);
    }
    return weights > 0.0 ? sum / weights : matrices[influences.front().joint];
}

// Refuses joints that the skin does not have where they count.
void checkJoints(const InputFile& file, GltfPart& part, std::size_t joints) {
    if (part.influences.empty()) {
        file.refuse(part.label + ": has a skin, but no JOINTS_0");
    }
    for (JointInfluence& influence : part.influences) {
        if (influence.joint >= joints && influence.weight == 0.0f) {
            influence.joint = 0;
        }
        if (influence.joint >= joints) {
            file.refuse(part.label + ": joint " + std::to_string(influence.joint) +
                        " does not exist, the skin has " + std::to_string(joints));
        }
    }
}

} // namespace

GltfSkins::GltfSkins(const GltfDocument& document, const InputFile& file,
                     const std::vector<PlacedNode>& nodes)
    : document_(document), file_(file),
      skins_(GltfElement(file, "", &document.json).objects("skins", "skin")),
      toWorld_(document.model.nodes.size(), nullptr) {
    for (const PlacedNode& placed : nodes) {
        toWorld_[static_cast<std::size_t>(placed.node)] = &placed.toWorld;
    }
}

std::vector<glm::dmat4> GltfSkins::matrices(int skin, const std::string& label) const {
    const auto index = static_cast<std::size_t>(skin);
    if (index >= skins_.size()) {
        file_.refuse(label + ": skin " + std::to_string(skin) + " does not exist, there are " +
                     std::to_string(skins_.size()));
    }
    const GltfElement& source = skins_[index];
    const std::vector<int> joints = source.integers("joints");
    if (joints.empty()) {
        source.refuse("has no joints");
    }
    std::optional<GltfAccessor> inverseBind;
    if (const std::optional<int> accessor = source.integer("inverseBindMatrices")) {
        inverseBind.emplace(document_.model, file_, source.label() + ": inverseBindMatrices", *accessor,
                            TINYGLTF_TYPE_MAT4);
        if (inverseBind->count() < joints.size()) {
            source.refuse(std::to_string(joints.size()) + " joints, but " +
                          std::to_string(inverseBind->count()) + " inverse bind matrices");
        }
    }
    std::vector<glm::dmat4> matrices;
    for (std::size_t i = 0; i < joints.size(); ++i) {
        const auto node = static_cast<std::size_t>(joints[i]);
        if (node >= toWorld_.size() || toWorld_[node] == nullptr) {
            source.refuse("joint " + std::to_string(i) + ": node " + std::to_string(joints[i]) +
                          " is not in the scene");
        }
        matrices.push_back(*toWorld_[node] * (inverseBind ? inverseBind->mat4(i) : glm::dmat4(1.0)));
    }
    return matrices;
}

void applySkin(const InputFile& file, const std::vector<glm::dmat4>& matrices, GltfPart& part) {
    checkJoints(file, part, matrices.size());
    MeshGeometry& geometry = part.geometry;
    const std::size_t count = geometry.positions.size();
    const std::size_t perVertex = part.influences.size() / count;
    std::vector<bool> mirrored(count);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dmat4 toWorld =
            meanMatrix(std::span(part.influences).subspan(i * perVertex, perVertex), matrices);
        mirrored[i] = isMirroring(toWorld);
        geometry.positions[i] = glm::vec3(toWorld * glm::dvec4(geometry.positions[i], 1.0));
        if (!geometry.normals.empty()) {
            geometry.normals[i] = glm::vec3(normalMatrix(toWorld) * glm::dvec3(geometry.normals[i]));
        }
        if (!geometry.tangents.empty()) {
            geometry.tangents[i] = glm::vec4(glm::dmat3(toWorld) * glm::dvec3(geometry.tangents[i]),
                                             mirrored[i] ? -geometry.tangents[i].w : geometry.tangents[i].w);
        }
    }
    for (glm::uvec3& triangle : geometry.triangles) {
        if (mirrored[triangle.x]) {
            std::swap(triangle.y, triangle.z);
        }
    }
}

} // namespace metamarch

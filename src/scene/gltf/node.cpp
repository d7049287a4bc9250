// SPDX-License-Identifier: MIT
#include "metamarch/scene/gltf/node.h"

#include "metamarch/scene/choice.h"
#include "metamarch/scene/gltf/element.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <numeric>
#include <ranges>

namespace metamarch {
namespace {

std::string nodeLabel(const tinygltf::Model& model, int node) {
    const auto index = static_cast<std::size_t>(node);
    return elementName("node", model.nodes[index].name, index);
}

glm::dmat4 localMatrix(const tinygltf::Model& model, const InputFile& file, int index) {
    const tinygltf::Node& node = model.nodes[static_cast<std::size_t>(index)];
    const auto has = [&](const char* name, const std::vector<double>& numbers, std::size_t wanted) {
        if (!numbers.empty() && numbers.size() != wanted) {
            file.refuse(nodeLabel(model, index) + ": " + name + " has " + std::to_string(numbers.size()) +
                        " numbers, not " + std::to_string(wanted));
        }
        return !numbers.empty();
    };
    if (has("matrix", node.matrix, 16)) {
        return glm::make_mat4(node.matrix.data());
    }
    return composed(has("translation", node.translation, 3) ? glm::make_vec3(node.translation.data())
                                                            : glm::dvec3(0.0),
                    has("rotation", node.rotation, 4) ? glm::make_vec4(node.rotation.data())
                                                      : glm::dvec4(0.0, 0.0, 0.0, 1.0),
                    has("scale", node.scale, 3) ? glm::make_vec3(node.scale.data()) : glm::dvec3(1.0));
}

std::vector<int> parentlessNodes(const tinygltf::Model& model, const InputFile& file) {
    std::vector<bool> hasParent(model.nodes.size(), false);
    for (const tinygltf::Node& node : model.nodes) {
        for (const int child : node.children) {
            if (child >= 0 && static_cast<std::size_t>(child) < model.nodes.size()) {
                hasParent[static_cast<std::size_t>(child)] = true;
            }
        }
    }
    std::vector<int> roots;
    for (std::size_t node = 0; node < model.nodes.size(); ++node) {
        if (!hasParent[node]) {
            roots.push_back(static_cast<int>(node));
        }
    }
    if (roots.empty() && !model.nodes.empty()) {
        file.refuse("no node is without a parent: the nodes form a cycle");
    }
    return roots;
}

std::vector<int> rootNodes(const tinygltf::Model& model, const InputFile& file, const std::string& chosen) {
    if (!chosen.empty()) {
        std::vector<std::string> names;
        names.reserve(model.scenes.size());
        for (const tinygltf::Scene& scene : model.scenes) {
            names.push_back(scene.name);
        }
        return model.scenes[chooseIndex("scene", names, chosen)].nodes;
    }
    if (model.scenes.empty()) {
        return parentlessNodes(model, file);
    }
    const int scene = model.defaultScene < 0 ? 0 : model.defaultScene;
    if (static_cast<std::size_t>(scene) >= model.scenes.size()) {
        file.refuse("scene " + std::to_string(scene) + " does not exist, there are " +
                    std::to_string(model.scenes.size()));
    }
    return model.scenes[static_cast<std::size_t>(scene)].nodes;
}

} // namespace

std::vector<PlacedNode> placeNodes(const GltfDocument& document, const InputFile& file,
                                   const std::string& scene, const glm::dmat4& root) {
    const tinygltf::Model& model = document.model;
    const std::vector<GltfElement> elements = GltfElement(file, "", &document.json).objects("nodes", "node");
    std::vector<PlacedNode> placed;
    std::vector<bool> reached(model.nodes.size(), false);
    std::vector<PlacedNode> pending; // toWorld and visible are the parent's until the node is taken
    const auto push = [&](const std::vector<int>& nodes, const PlacedNode& parent, const std::string& of) {
        for (const int node : nodes | std::views::reverse) {
            if (node < 0 || static_cast<std::size_t>(node) >= model.nodes.size()) {
                file.refuse(of + ": node " + std::to_string(node) + " does not exist, there are " +
                            std::to_string(model.nodes.size()));
            }
            pending.push_back({node, parent.root < 0 ? node : parent.root, parent.toWorld, parent.visible});
        }
    };

    // Iterative, so that deep hierarchies use no call stack. The loop ends because no node is taken twice.
    push(rootNodes(model, file, scene), {-1, -1, root}, "scene");
    while (!pending.empty()) {
        const PlacedNode next = pending.back();
        pending.pop_back();
        const auto index = static_cast<std::size_t>(next.node);
        if (reached[index]) {
            file.refuse(nodeLabel(model, next.node) +
                        " is reached twice: the nodes form a cycle, or it has two parents");
        }
        reached[index] = true;
        const auto visibility = elements[index].extension("KHR_node_visibility");
        placed.push_back({next.node, next.root, next.toWorld * localMatrix(model, file, next.node),
                          next.visible && (!visibility || visibility->flag("visible", true))});
        push(model.nodes[index].children, placed.back(), nodeLabel(model, next.node));
    }
    return placed;
}

glm::dmat4 composed(const glm::dvec3& translation, const glm::dvec4& rotationXyzw, const glm::dvec3& scale) {
    const glm::dquat rotation(rotationXyzw.w, rotationXyzw.x, rotationXyzw.y, rotationXyzw.z);
    return glm::translate(glm::dmat4(1.0), translation) * glm::mat4_cast(glm::normalize(rotation)) *
           glm::scale(glm::dmat4(1.0), scale);
}

} // namespace metamarch

#include "scene/gltf_import.h"

#include "scene/gltf_accessor.h"
#include "scene/gltf_camera.h"
#include "scene/gltf_document.h"
#include "scene/gltf_material.h"
#include "scene/gltf_node.h"
#include "scene/gltf_primitive.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>

namespace metamarch {
namespace {

class GltfImporter {
  public:
    GltfImporter(const tinygltf::Model& model, SceneFile& file, double scale)
        : model_(model), file_(file), scale_(scale) {}

    Scene import() {
        for (const tinygltf::Material& material : model_.materials)
            scene_.materials.push_back(readMaterial(material));
        const glm::dmat4 root = glm::scale(glm::dmat4(1.0), glm::dvec3(scale_));
        for (const PlacedNode& placed : placeNodes(model_, file_, root)) {
            const auto index = static_cast<std::size_t>(placed.node);
            const tinygltf::Node& node = model_.nodes[index];
            const std::string label = elementName("node", node.name, index);
            if (node.camera >= 0)
                addCamera(node, label, placed.toWorld);
            if (node.mesh >= 0)
                addMesh(node, label, placed.toWorld);
        }
        return std::move(scene_);
    }

  private:
    void addCamera(const tinygltf::Node& node, const std::string& label, const glm::dmat4& toWorld) {
        const auto index = static_cast<std::size_t>(node.camera);
        if (index >= model_.cameras.size())
            file_.refuse(label + ": camera " + std::to_string(index) + " does not exist, there are " +
                         std::to_string(model_.cameras.size()));
        const tinygltf::Camera& source = model_.cameras[index];
        std::optional<SceneCamera> camera = readCamera(source, toWorld, scale_);
        if (!camera) {
            file_.warn(elementName("camera", source.name, index) + " at " + label +
                       " shows nothing and is left out");
            return;
        }
        camera->name = !source.name.empty() ? source.name : node.name;
        scene_.cameras.push_back(std::move(*camera));
    }

    void addMesh(const tinygltf::Node& node, const std::string& label, const glm::dmat4& toWorld) {
        const std::string mesh = meshLabel(model_, file_, label, node.mesh);
        if (node.skin >= 0)
            file_.warn(mesh + ": the skin is ignored, it stands in its bind pose");
        if (std::any_of(node.weights.begin(), node.weights.end(),
                        [](double weight) { return weight != 0.0; }))
            file_.warn(mesh + ": morph targets are ignored");
        for (const glm::dmat4& instance : instanceMatrices(node, label)) {
            InstanceWriter writer(scene_, file_, model_.meshes[static_cast<std::size_t>(node.mesh)].name,
                                  mesh, toWorld * instance);
            writeMesh(model_, file_, node.mesh, writer);
        }
    }

    // EXT_mesh_gpu_instancing; the identity alone without it.
    std::vector<glm::dmat4> instanceMatrices(const tinygltf::Node& node, const std::string& label) const {
        constexpr const char* kExtension = "EXT_mesh_gpu_instancing";
        const auto extension = node.extensions.find(kExtension);
        if (extension == node.extensions.end())
            return {glm::dmat4(1.0)};
        const tinygltf::Value none;
        const tinygltf::Value& attributes =
            extension->second.Has("attributes") ? extension->second.Get("attributes") : none;
        const auto accessor = [&](const char* name, int type) -> std::optional<GltfAccessor> {
            if (!attributes.Has(name))
                return std::nullopt;
            const tinygltf::Value& index = attributes.Get(name);
            return GltfAccessor(model_, file_, label + ": " + kExtension + ' ' + name,
                                index.IsInt() ? index.GetNumberAsInt() : -1, type);
        };
        const std::optional<GltfAccessor> translation = accessor("TRANSLATION", TINYGLTF_TYPE_VEC3);
        const std::optional<GltfAccessor> rotation = accessor("ROTATION", TINYGLTF_TYPE_VEC4);
        const std::optional<GltfAccessor> scale = accessor("SCALE", TINYGLTF_TYPE_VEC3);

        std::optional<std::uint64_t> count;
        for (const std::optional<GltfAccessor>* attribute : {&translation, &rotation, &scale}) {
            if (*attribute && count.value_or((*attribute)->count()) != (*attribute)->count())
                file_.refuse(label + ": " + kExtension + ": attributes of different counts");
            if (*attribute)
                count = (*attribute)->count();
        }
        std::vector<glm::dmat4> matrices;
        for (std::uint64_t i = 0; i < count.value_or(0); ++i)
            matrices.push_back(composed(translation ? translation->vec3(i) : glm::dvec3(0.0),
                                        rotation ? rotation->vec4(i) : glm::dvec4(0.0, 0.0, 0.0, 1.0),
                                        scale ? scale->vec3(i) : glm::dvec3(1.0)));
        return matrices;
    }

    const tinygltf::Model& model_;
    SceneFile& file_;
    double scale_;
    Scene scene_;
};

} // namespace

Scene importGltf(SceneFile& file, double scale) {
    const tinygltf::Model model = readGltf(file);
    return GltfImporter(model, file, scale).import();
}

} // namespace metamarch

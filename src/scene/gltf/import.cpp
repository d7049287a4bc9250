// SPDX-License-Identifier: MIT
#include "metamarch/scene/gltf/import.h"

#include "metamarch/scene/choice.h"
#include "metamarch/scene/gltf/animation.h"
#include "metamarch/scene/gltf/camera.h"
#include "metamarch/scene/gltf/document.h"
#include "metamarch/scene/gltf/instancing.h"
#include "metamarch/scene/gltf/light.h"
#include "metamarch/scene/gltf/material.h"
#include "metamarch/scene/gltf/mesh.h"
#include "metamarch/scene/gltf/node.h"
#include "metamarch/scene/gltf/skin.h"
#include "metamarch/scene/gltf/texture.h"
#include "metamarch/scene/instance_writer.h"
#include "metamarch/scene/texture/texture_loader.h"

#include <glm/gtc/matrix_transform.hpp>

#include <array>

namespace metamarch {
namespace {

class GltfImporter {
  public:
    GltfImporter(const GltfDocument& document, InputFile& file, const ImportOptions& options)
        : document_(document), file_(file), options_(options), root_(file, "", &document.json),
          nodes_(root_.objects("nodes", "node")) {
        if (const auto lights = root_.extension("KHR_lights_punctual")) {
            lights_ = lights->objects("lights", "light");
        }
        if (const auto variants = root_.extension("KHR_materials_variants")) {
            for (const GltfElement& variant : variants->objects("variants", "variant")) {
                scene_.variants.push_back(variant.text("name"));
            }
        }
        for (const tinygltf::Scene& scene : document.model.scenes) {
            scene_.scenes.push_back(scene.name);
        }
    }

    Scene import() {
        scene_.animations = readAnimations(document_, file_);
        GltfTextures textures(document_, file_);
        readMaterials(textures);
        scene_.textures = textures.textures();
        const glm::dmat4 root = glm::scale(glm::dmat4(1.0), glm::dvec3(scale()));
        const std::vector<PlacedNode> placed = placeNodes(document_, file_, options_.scene, root);
        const GltfMeshes meshes(document_, file_, texCoordSets_, variant());
        const GltfSkins skins(document_, file_, placed);
        for (const PlacedNode& place : placed) {
            addCamera(place);
            if (place.visible) {
                addLight(place);
                addMesh(place, meshes, skins);
            }
        }
        loadTextures(scene_, file_, textures.sources(), options_.allowMissingTextures);
        return std::move(scene_);
    }

  private:
    double scale() const { return static_cast<double>(options_.scale); }

    std::optional<int> variant() const {
        if (options_.variant.empty()) {
            return std::nullopt;
        }
        return static_cast<int>(chooseIndex("variant", scene_.variants, options_.variant));
    }

    const tinygltf::Node& node(const PlacedNode& place) const {
        return document_.model.nodes[static_cast<std::size_t>(place.node)];
    }

    const GltfElement& element(const PlacedNode& place) const {
        return nodes_[static_cast<std::size_t>(place.node)];
    }

    void readMaterials(GltfTextures& textures) {
        for (const GltfElement& source : root_.objects("materials", "material")) {
            GltfMaterial read = readMaterial(source, textures, scale());
            scene_.materials.push_back(std::move(read.material));
            texCoordSets_.push_back(read.texCoordSets);
        }
    }

    void addCamera(const PlacedNode& place) {
        if (node(place).camera < 0) {
            return;
        }
        const std::string& label = element(place).label();
        const auto index = static_cast<std::size_t>(node(place).camera);
        if (index >= document_.model.cameras.size()) {
            file_.refuse(label + ": camera " + std::to_string(index) + " does not exist, there are " +
                         std::to_string(document_.model.cameras.size()));
        }
        const tinygltf::Camera& source = document_.model.cameras[index];
        std::optional<SceneCamera> camera = readCamera(source, viewToWorld(place), scale());
        if (!camera) {
            file_.warn(elementName("camera", source.name, index) + " at " + label +
                       " shows nothing and is left out");
            return;
        }
        camera->name = !source.name.empty() ? source.name : node(place).name;
        scene_.cameras.push_back(std::move(*camera));
    }

    // Returns the transform of a camera's node without the mirroring by its own scale: glTF leaves scaling
    // out of the view (3.10.2).
    glm::dmat4 viewToWorld(const PlacedNode& place) const {
        glm::dmat4 toWorld = place.toWorld;
        const std::vector<double>& scale = node(place).scale;
        for (std::size_t axis = 0; axis < scale.size(); ++axis) {
            if (scale[axis] < 0.0) {
                toWorld[static_cast<int>(axis)] = -toWorld[static_cast<int>(axis)];
            }
        }
        return toWorld;
    }

    void addLight(const PlacedNode& place) {
        const auto extension = element(place).extension("KHR_lights_punctual");
        const std::optional<int> index =
            extension ? extension->index("light", "light", lights_.size()) : std::nullopt;
        if (!index) {
            return;
        }
        const GltfElement& source = lights_[static_cast<std::size_t>(*index)];
        std::optional<PunctualLight> light = readLight(source, place.toWorld, scale());
        if (!light) {
            file_.warn(source.label() + " at " + element(place).label() +
                       " has no place or direction and is left out");
            return;
        }
        if (light->name.empty()) {
            light->name = node(place).name;
        }
        scene_.lights.push_back(std::move(*light));
    }

    void addMesh(const PlacedNode& place, const GltfMeshes& meshes, const GltfSkins& skins) {
        const tinygltf::Node& source = node(place);
        if (source.mesh < 0) {
            return;
        }
        const std::string& label = element(place).label();
        std::vector<GltfPart> parts = meshes.read(source.mesh, source.weights, label);
        std::vector<glm::dmat4> toWorld = {glm::dmat4(1.0)};
        if (source.skin >= 0) {
            // A skinned mesh is placed by its joints, not by its node.
            const std::vector<glm::dmat4> joints = skins.matrices(source.skin, label);
            for (GltfPart& part : parts) {
                applySkin(file_, joints, part);
            }
        } else {
            toWorld = instanceMatrices(document_.model, file_, element(place));
            for (glm::dmat4& instance : toWorld) {
                instance = place.toWorld * instance;
            }
        }
        for (GltfPart& part : parts) {
            giveTangents(part);
        }
        for (GltfPart& part : parts) {
            if (part.material == kNoMaterial) {
                part.material = defaultMaterial();
            }
        }
        const tinygltf::Mesh& mesh = document_.model.meshes[static_cast<std::size_t>(source.mesh)];
        const MeshInstance instance{mesh.name, static_cast<std::uint32_t>(source.mesh), source.name,
                                    document_.model.nodes[static_cast<std::size_t>(place.root)].name};
        for (const glm::dmat4& matrix : toWorld) {
            InstanceWriter writer(scene_, file_, instance,
                                  elementName("mesh", mesh.name, static_cast<std::size_t>(source.mesh)),
                                  matrix);
            for (const GltfPart& part : parts) {
                writer.write(part.label, part.geometry, part.material);
            }
            writer.finish();
        }
    }

    // Returns the material of primitives without one (glTF 2.0, 3.7.2.1): all its values are the defaults.
    std::uint32_t defaultMaterial() {
        if (!defaultMaterial_) {
            defaultMaterial_ = static_cast<std::uint32_t>(scene_.materials.size());
            scene_.materials.emplace_back().name = "default";
        }
        return *defaultMaterial_;
    }

    // Adds tangents if the material needs them and the file has none.
    void giveTangents(GltfPart& part) const {
        if (part.material == kNoMaterial || !part.geometry.tangents.empty()) {
            return;
        }
        const Material& material = scene_.materials[part.material];
        const std::uint32_t set = texCoordOfTangents(material);
        if (needsTangents(material) && !part.geometry.texCoords[set].empty()) {
            addTangents(part.geometry, set);
        }
    }

    const GltfDocument& document_;
    InputFile& file_;
    const ImportOptions& options_;
    GltfElement root_;
    std::vector<GltfElement> nodes_;
    std::vector<GltfElement> lights_;
    std::vector<TexCoordSets> texCoordSets_;       // indexed by material
    std::optional<std::uint32_t> defaultMaterial_; // index into scene_.materials
    Scene scene_;
};

} // namespace

Scene importGltf(InputFile& file, const ImportOptions& options) {
    GltfDocument document = readGltf(file);
    if (options.time) {
        poseNodes(document, file, options.animation, *options.time);
    }
    return GltfImporter(document, file, options).import();
}

} // namespace metamarch

// SPDX-License-Identifier: MIT
#include "metamarch/scene/gltf/mesh.h"

#include "metamarch/scene/gltf/accessor.h"
#include "metamarch/scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace metamarch {
namespace {

// Returns the number of triangles that `count` vertices or indices make.
std::uint64_t triangleCount(int mode, std::uint64_t count) {
    if (mode == TINYGLTF_MODE_TRIANGLES) {
        return count / 3;
    }
    return count < 3 ? 0 : count - 2;
}

// Returns the positions of triangle `i`'s corners in the vertex or index list (glTF 2.0, 3.7.2.1).
glm::u64vec3 corners(int mode, std::uint64_t i) {
    switch (mode) {
    case TINYGLTF_MODE_TRIANGLE_STRIP:
        return i % 2 == 0 ? glm::u64vec3(i, i + 1, i + 2) : glm::u64vec3(i, i + 2, i + 1);
    case TINYGLTF_MODE_TRIANGLE_FAN:
        return {i + 1, i + 2, 0};
    default:
        return {3 * i, 3 * i + 1, 3 * i + 2};
    }
}

template <int N>
glm::vec<N, float> element(const GltfAccessor& accessor, std::uint64_t i) {
    if constexpr (N == 2) {
        return accessor.vec2(i);
    } else if constexpr (N == 3) {
        return accessor.vec3(i);
    } else {
        return accessor.vec4(i);
    }
}

using Attributes = std::map<std::string, int>;

class PartReader {
  public:
    PartReader(const tinygltf::Model& model, InputFile& file, const tinygltf::Primitive& primitive,
               const std::vector<double>& weights, const TexCoordSets& texCoordSets, GltfPart& part)
        : model_(model), file_(file), primitive_(primitive), weights_(weights), texCoordSets_(texCoordSets),
          part_(part) {}

    // Returns false, after a warning, if there is nothing to render.
    bool read() {
        if (primitive_.mode >= TINYGLTF_MODE_POINTS && primitive_.mode <= TINYGLTF_MODE_LINE_STRIP) {
            file_.warn(part_.label + ": points and lines are not rendered");
            return false;
        }
        if (primitive_.mode < TINYGLTF_MODE_TRIANGLES || primitive_.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
            file_.refuse(part_.label + ": mode " + std::to_string(primitive_.mode) +
                         " is not one of glTF 2.0");
        }
        if (!primitive_.attributes.contains("POSITION")) {
            file_.warn(part_.label + ": has no positions and is not rendered");
            return false;
        }
        readVertices();
        readTriangles();
        checkIndices(file_, part_.label, part_.geometry);
        readInfluences();
        return true;
    }

  private:
    void readVertices() {
        MeshGeometry& geometry = part_.geometry;
        geometry.positions = attribute<3>("POSITION");
        geometry.normals = attribute<3>("NORMAL");
        for (std::size_t set = 0; set < geometry.texCoords.size(); ++set) {
            if (texCoordSets_[set] != kNoTexCoordSet) {
                geometry.texCoords[set] = attribute<2>("TEXCOORD_" + std::to_string(texCoordSets_[set]));
            }
        }
        geometry.colors = readColors();
        if (!geometry.normals.empty()) {
            geometry.tangents = readTangents();
        }
    }

    // Returns a vertex attribute with morph targets applied; empty if the primitive does not have it.
    template <int N>
    std::vector<glm::vec<N, float>> attribute(const std::string& name) {
        std::vector<glm::vec<N, float>> values = read<N>(primitive_.attributes, name, part_.label);
        morph(name, values);
        return values;
    }

    template <int N>
    std::vector<glm::vec<N, float>> read(const Attributes& attributes, const std::string& name,
                                         const std::string& label) {
        const auto found = attributes.find(name);
        if (found == attributes.end()) {
            return {};
        }
        constexpr int kTypes[] = {TINYGLTF_TYPE_VEC2, TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC4};
        const GltfAccessor accessor(model_, file_, label + ": " + name, found->second, kTypes[N - 2]);
        if (count_ == 0) {
            count_ = accessor.count(); // POSITION comes first
        }
        if (accessor.count() != count_) {
            file_.refuse(label + ": " + name + " has " + std::to_string(accessor.count()) +
                         " elements, POSITION of the primitive has " + std::to_string(count_));
        }
        std::vector<glm::vec<N, float>> values;
        values.reserve(count_);
        for (std::uint64_t i = 0; i < count_; ++i) {
            values.push_back(element<N>(accessor, i));
        }
        return values;
    }

    // Targets with weight 0 are not read.
    template <int N>
    void morph(const std::string& name, std::vector<glm::vec<N, float>>& values) {
        for (std::size_t t = 0; t < std::min(weights_.size(), primitive_.targets.size()); ++t) {
            const auto weight = static_cast<float>(weights_[t]);
            if (weight == 0.0f || values.empty()) {
                continue;
            }
            const std::vector<glm::vec<N, float>> offsets =
                read<N>(primitive_.targets[t], name, part_.label + " target " + std::to_string(t));
            for (std::size_t i = 0; i < offsets.size(); ++i) {
                values[i] += weight * offsets[i];
            }
        }
    }

    std::vector<glm::vec4> readColors() {
        const auto found = primitive_.attributes.find("COLOR_0");
        const bool hasAlpha =
            found == primitive_.attributes.end() || found->second < 0 ||
            static_cast<std::size_t>(found->second) >= model_.accessors.size() ||
            model_.accessors[static_cast<std::size_t>(found->second)].type != TINYGLTF_TYPE_VEC3;
        if (hasAlpha) {
            return attribute<4>("COLOR_0");
        }
        std::vector<glm::vec4> colors;
        for (const glm::vec3& color : attribute<3>("COLOR_0")) {
            colors.emplace_back(color, 1.0f);
        }
        return colors;
    }

    // Morph targets change a tangent's direction and keep its sign.
    std::vector<glm::vec4> readTangents() {
        std::vector<glm::vec4> tangents = read<4>(primitive_.attributes, "TANGENT", part_.label);
        std::vector<glm::vec3> directions(tangents.begin(), tangents.end());
        morph("TANGENT", directions);
        for (std::size_t i = 0; i < tangents.size(); ++i) {
            tangents[i] = glm::vec4(directions[i], tangents[i].w);
        }
        return tangents;
    }

    void readTriangles() {
        const std::optional<GltfAccessor> indices = indexAccessor();
        const std::uint64_t count = indices ? indices->count() : part_.geometry.positions.size();
        const int mode = primitive_.mode;
        if (mode == TINYGLTF_MODE_TRIANGLES ? count % 3 != 0 : count < 3) {
            file_.warn(part_.label + ": " + std::to_string(count) +
                       " corners are no whole number of triangles");
        }
        const auto vertex = [&indices](std::uint64_t corner) {
            return indices ? indices->index(corner) : static_cast<std::uint32_t>(corner);
        };
        const std::uint64_t triangles = triangleCount(mode, count);
        part_.geometry.triangles.reserve(triangles);
        for (std::uint64_t i = 0; i < triangles; ++i) {
            const glm::u64vec3 corner = corners(mode, i);
            part_.geometry.triangles.emplace_back(vertex(corner.x), vertex(corner.y), vertex(corner.z));
        }
    }

    std::optional<GltfAccessor> indexAccessor() const {
        if (primitive_.indices < 0) {
            return std::nullopt;
        }
        GltfAccessor indices(model_, file_, part_.label + ": indices", primitive_.indices,
                             TINYGLTF_TYPE_SCALAR);
        if (!indices.hasUnsignedIntegers()) {
            file_.refuse(part_.label + ": indices are not unsigned integers");
        }
        return indices;
    }

    // Reads JOINTS_n and WEIGHTS_n for every n, vertex by vertex.
    void readInfluences() {
        std::size_t sets = 0;
        while (primitive_.attributes.contains("JOINTS_" + std::to_string(sets))) {
            ++sets;
        }
        part_.influences.resize(4 * sets * part_.geometry.positions.size());
        for (std::size_t set = 0; set < sets; ++set) {
            const std::string number = std::to_string(set);
            const std::vector<glm::vec4> joints =
                read<4>(primitive_.attributes, "JOINTS_" + number, part_.label);
            const std::vector<glm::vec4> weights =
                read<4>(primitive_.attributes, "WEIGHTS_" + number, part_.label);
            if (weights.size() != joints.size()) {
                file_.refuse(fmt::format("{}: JOINTS_{} without WEIGHTS_{}", part_.label, set, set));
            }
            for (std::size_t i = 0; i < joints.size(); ++i) {
                for (int k = 0; k < 4; ++k) {
                    part_.influences[4 * (sets * i + set) + static_cast<std::size_t>(k)] =
                        influence(i, joints[i][k], weights[i][k]);
                }
            }
        }
    }

    // A joint of weight 0 may be anything; 0 stands for one that no skin can have.
    JointInfluence influence(std::size_t vertex, float joint, float weight) const {
        constexpr float kMostJoints = 65536.0f; // range of an unsigned short
        // Writers that normalise or quantize weights leave such rounding errors below 0.
        constexpr float kLeastWeight = -1e-3f;
        const bool isJoint = joint >= 0.0f && joint < kMostJoints;
        if (!(weight >= kLeastWeight && std::isfinite(weight))) {
            file_.refuse(fmt::format("{}: a weight of vertex {} is {}, not a finite number of at least 0",
                                     part_.label, vertex, weight));
        }
        if (weight > 0.0f && !isJoint) {
            file_.refuse(fmt::format("{}: a joint of vertex {} is {}, not an integer from 0 to 65535",
                                     part_.label, vertex, joint));
        }
        return {isJoint ? static_cast<std::uint32_t>(joint) : 0u, std::max(weight, 0.0f)};
    }

    const tinygltf::Model& model_;
    InputFile& file_;
    const tinygltf::Primitive& primitive_;
    const std::vector<double>& weights_;
    const TexCoordSets& texCoordSets_;
    GltfPart& part_;
    std::uint64_t count_ = 0; // number of vertices
};

// Returns the material that KHR_materials_variants assigns to the primitive, or else its own.
std::uint32_t materialOf(const GltfElement& primitive, std::optional<int> variant, std::size_t materials) {
    std::optional<int> material = primitive.index("material", "material", materials);
    const auto extension = primitive.extension("KHR_materials_variants");
    if (variant && extension) {
        for (const GltfElement& mapping : extension->objects("mappings", "mapping")) {
            const std::vector<int> variants = mapping.integers("variants");
            if (std::ranges::find(variants, *variant) != variants.end()) {
                material = mapping.index("material", "material", materials);
            }
        }
    }
    return material ? static_cast<std::uint32_t>(*material) : kNoMaterial;
}

} // namespace

GltfMeshes::GltfMeshes(const GltfDocument& document, InputFile& file,
                       const std::vector<TexCoordSets>& texCoordSets, std::optional<int> variant)
    : document_(document), file_(file), texCoordSets_(texCoordSets), variant_(variant),
      meshes_(GltfElement(file, "", &document.json).objects("meshes", "mesh")) {}

std::vector<GltfPart> GltfMeshes::read(int mesh, const std::vector<double>& weights,
                                       const std::string& label) const {
    const auto index = static_cast<std::size_t>(mesh);
    if (mesh < 0 || index >= meshes_.size()) {
        file_.refuse(label + ": mesh " + std::to_string(mesh) + " does not exist, there are " +
                     std::to_string(meshes_.size()));
    }
    const tinygltf::Mesh& source = document_.model.meshes[index];
    const std::vector<double>& ofTargets = weights.empty() ? source.weights : weights;
    const std::vector<GltfElement> primitives = meshes_[index].objects("primitives", "primitive");
    std::vector<GltfPart> parts;
    for (std::size_t i = 0; i < source.primitives.size(); ++i) {
        GltfPart part;
        part.label = primitives[i].label();
        part.material = materialOf(primitives[i], variant_, texCoordSets_.size());
        const auto& sets = part.material == kNoMaterial ? kFirstTexCoordSets : texCoordSets_[part.material];
        if (PartReader(document_.model, file_, source.primitives[i], ofTargets, sets, part).read()) {
            parts.push_back(std::move(part));
        }
    }
    return parts;
}

} // namespace metamarch

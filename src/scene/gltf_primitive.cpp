#include "scene/gltf_primitive.h"

#include "scene/gltf_accessor.h"

#include <algorithm>
#include <optional>

namespace metamarch {
namespace {

// Triangles that `count` vertices or indices make.
std::uint64_t triangleCount(int mode, std::uint64_t count) {
    if (mode == TINYGLTF_MODE_TRIANGLES)
        return count / 3;
    return count < 3 ? 0 : count - 2;
}

// Positions in the vertex or index list of triangle `i`'s corners (glTF 2.0, 3.7.2.1).
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

class PrimitiveReader {
  public:
    PrimitiveReader(const tinygltf::Model& model, SceneFile& file, const tinygltf::Primitive& primitive,
                    std::string label)
        : model_(model), file_(file), primitive_(primitive), label_(std::move(label)) {}

    void write(InstanceWriter& writer) const {
        if (primitive_.mode >= TINYGLTF_MODE_POINTS && primitive_.mode <= TINYGLTF_MODE_LINE_STRIP) {
            file_.warn(label_ + ": points and lines are not rendered");
            return;
        }
        if (primitive_.mode < TINYGLTF_MODE_TRIANGLES || primitive_.mode > TINYGLTF_MODE_TRIANGLE_FAN)
            file_.refuse(label_ + ": mode " + std::to_string(primitive_.mode) + " is not one of glTF 2.0");
        const std::optional<GltfAccessor> position = attribute("POSITION", TINYGLTF_TYPE_VEC3);
        if (!position) {
            file_.warn(label_ + ": has no positions and is not rendered");
            return;
        }
        const std::optional<GltfAccessor> indices = indexAccessor();
        const std::uint64_t corners = indices ? indices->count() : position->count();
        if (primitive_.mode == TINYGLTF_MODE_TRIANGLES ? corners % 3 != 0 : corners < 3)
            file_.warn(label_ + ": " + std::to_string(corners) + " corners are no whole number of triangles");

        writer.beginPart(label_, position->count(), triangleCount(primitive_.mode, corners), material());
        writeVertices(*position, writer);
        writeTriangles(indices, corners, writer);
    }

  private:
    std::optional<GltfAccessor> attribute(const char* name, int type) const {
        const auto found = primitive_.attributes.find(name);
        if (found == primitive_.attributes.end())
            return std::nullopt;
        return GltfAccessor(model_, file_, label_ + ": " + name, found->second, type);
    }

    std::optional<GltfAccessor> indexAccessor() const {
        if (primitive_.indices < 0)
            return std::nullopt;
        GltfAccessor indices(model_, file_, label_ + ": indices", primitive_.indices, TINYGLTF_TYPE_SCALAR);
        if (!indices.hasUnsignedIntegers())
            file_.refuse(label_ + ": indices are not unsigned integers");
        return indices;
    }

    std::uint32_t material() const {
        if (primitive_.material < 0)
            return kNoMaterial;
        if (static_cast<std::size_t>(primitive_.material) >= model_.materials.size())
            file_.refuse(label_ + ": material " + std::to_string(primitive_.material) +
                         " does not exist, there are " + std::to_string(model_.materials.size()));
        return static_cast<std::uint32_t>(primitive_.material);
    }

    void writeVertices(const GltfAccessor& position, InstanceWriter& writer) const {
        const std::optional<GltfAccessor> normal = attribute("NORMAL", TINYGLTF_TYPE_VEC3);
        const std::optional<GltfAccessor> texCoord = attribute("TEXCOORD_0", TINYGLTF_TYPE_VEC2);
        for (const auto* other : {&normal, &texCoord}) {
            if (*other && (*other)->count() != position.count())
                file_.refuse(label_ + ": " + std::to_string(position.count()) + " positions, but " +
                             std::to_string((*other)->count()) +
                             (other == &normal ? " normals" : " texture coordinates"));
        }
        for (std::uint64_t i = 0; i < position.count(); ++i)
            writer.addVertex(position.vec3(i), normal ? std::optional(normal->vec3(i)) : std::nullopt,
                             texCoord ? std::optional(texCoord->vec2(i)) : std::nullopt);
    }

    void writeTriangles(const std::optional<GltfAccessor>& indices, std::uint64_t count,
                        InstanceWriter& writer) const {
        const auto vertex = [&indices](std::uint64_t corner) {
            return indices ? indices->index(corner) : static_cast<std::uint32_t>(corner);
        };
        const std::uint64_t triangles = triangleCount(primitive_.mode, count);
        for (std::uint64_t i = 0; i < triangles; ++i) {
            const glm::u64vec3 corner = corners(primitive_.mode, i);
            writer.addTriangle(vertex(corner.x), vertex(corner.y), vertex(corner.z));
        }
    }

    const tinygltf::Model& model_;
    SceneFile& file_;
    const tinygltf::Primitive& primitive_;
    std::string label_;
};

} // namespace

void writeMesh(const tinygltf::Model& model, SceneFile& file, int mesh, InstanceWriter& writer) {
    const tinygltf::Mesh& source = model.meshes[static_cast<std::size_t>(mesh)];
    const std::string label = meshLabel(model, file, "", mesh);
    if (std::any_of(source.weights.begin(), source.weights.end(),
                    [](double weight) { return weight != 0.0; }))
        file.warn(label + ": morph targets are ignored");
    for (std::size_t i = 0; i < source.primitives.size(); ++i)
        PrimitiveReader(model, file, source.primitives[i], label + " primitive " + std::to_string(i))
            .write(writer);
    writer.finish();
}

std::string meshLabel(const tinygltf::Model& model, const SceneFile& file, const std::string& label,
                      int mesh) {
    const auto index = static_cast<std::size_t>(mesh);
    if (mesh < 0 || index >= model.meshes.size())
        file.refuse(label + ": mesh " + std::to_string(mesh) + " does not exist, there are " +
                    std::to_string(model.meshes.size()));
    return elementName("mesh", model.meshes[index].name, index);
}

} // namespace metamarch

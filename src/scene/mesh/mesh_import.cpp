// SPDX-License-Identifier: MIT
#include "metamarch/scene/mesh/mesh_import.h"

#include "metamarch/scene/choice.h"
#include "metamarch/scene/instance_writer.h"
#include "metamarch/scene/mesh/mesh_reader.h"
#include "metamarch/scene/mesh/name_list.h"
#include "metamarch/scene/mesh/triangulate.h"
#include "metamarch/scene/mesh/vertex_color.h"
#include "metamarch/scene/mesh/vertex_join.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <map>
#include <string_view>

namespace metamarch {
namespace {

// Triangles of one part that have the same material and agree in whether they have normals.
struct Group {
    std::uint32_t material = kNoMaterial;
    bool hasNormals = false;
    std::vector<glm::uvec3> triangles; // indices of corners
};

struct Part {
    std::vector<Group> groups;                                     // in the order of their first faces
    std::map<std::pair<std::uint32_t, bool>, std::size_t> groupOf; // material and hasNormals
    std::uint64_t facesBelowThreeCorners = 0;
    std::uint64_t facesOutOfWork = 0; // PolygonTriangulator::ranOutOfWork()
};

template <class T>
std::vector<T> gathered(const std::vector<T>& values, const std::vector<std::uint32_t>& indices,
                        const T& missing) {
    std::vector<T> result;
    result.reserve(indices.size());
    for (const std::uint32_t index : indices) {
        result.push_back(index == kNoIndex ? missing : values[index]);
    }
    return result;
}

class MeshImporter {
  public:
    MeshImporter(MeshFile source, InputFile& file, const ImportOptions& options)
        : source_(std::move(source)), mesh_(source_.polygons), file_(file), options_(options),
          toWorld_(glm::scale(glm::dmat4(1.0), glm::dvec3(static_cast<double>(options.scale)))) {}

    Scene import() {
        scene_.materials = std::move(source_.materials);
        scene_.textures = std::move(source_.textures);
        paintFaces();
        divideFaces();
        warnOfFaces(&Part::facesBelowThreeCorners, "with fewer than three corners", "not rendered");
        warnOfFaces(&Part::facesOutOfWork, "with very many corners",
                    "not divided exactly: parts may be missing or stand out");
        if (hasOneIndexPerVertex()) {
            addWhole();
        } else {
            findEqualAttributes();
            for (std::uint32_t part = 0; part < parts_.size(); ++part) {
                addPart(part);
            }
        }
        if (scene_.triangles.empty()) {
            file_.refuse("there is no triangle in it");
        }
        loadTextures(scene_, file_, source_.textureSources, options_.allowMissingTextures);
        return std::move(scene_);
    }

  private:
    // Colours multiply the base colour, which is white where faces have no material.
    void paintFaces() {
        if (mesh_.colors.empty()) {
            return;
        }
        if (mesh_.faceMaterial.empty()) {
            mesh_.faceMaterial.assign(mesh_.faceEnd.size(), kNoIndex);
        }
        if (std::ranges::find(mesh_.faceMaterial, kNoIndex) == mesh_.faceMaterial.end()) {
            return;
        }
        std::ranges::replace(mesh_.faceMaterial, kNoIndex,
                             static_cast<std::uint32_t>(scene_.materials.size()));
        scene_.materials.push_back(vertexColorMaterial(mesh_.colors));
    }

    // Divides every face into triangles and puts these into their groups.
    void divideFaces() {
        parts_.resize(std::max<std::size_t>(mesh_.partNames.size(), 1));
        PolygonTriangulator triangulator;
        std::vector<glm::vec3> corners;
        std::uint32_t begin = 0;
        for (std::size_t face = 0; face < mesh_.faceEnd.size(); ++face) {
            const std::uint32_t end = mesh_.faceEnd[face];
            Part& part = parts_[mesh_.facePart.empty() ? 0 : mesh_.facePart[face]];
            if (end - begin < 3) {
                ++part.facesBelowThreeCorners;
            } else if (end - begin == 3) {
                groupOf(part, face, begin).triangles.emplace_back(begin, begin + 1, begin + 2);
            } else {
                corners.clear();
                for (std::uint32_t corner = begin; corner < end; ++corner) {
                    corners.push_back(mesh_.positions[mesh_.cornerPosition[corner]]);
                }
                Group& group = groupOf(part, face, begin);
                for (const glm::uvec3& triangle : triangulator.triangulate(corners)) {
                    group.triangles.push_back(begin + triangle);
                }
                part.facesOutOfWork += triangulator.ranOutOfWork() ? 1 : 0;
            }
            begin = end;
        }
    }

    Group& groupOf(Part& part, std::size_t face, std::uint32_t firstCorner) const {
        const std::uint32_t material = mesh_.faceMaterial.empty() ? kNoMaterial : mesh_.faceMaterial[face];
        const bool hasNormals = !mesh_.normals.empty() &&
                                (mesh_.cornerNormal.empty() || mesh_.cornerNormal[firstCorner] != kNoIndex);
        // Most faces belong to the group of the face before them.
        if (!part.groups.empty() && part.groups.back().material == material &&
            part.groups.back().hasNormals == hasNormals) {
            return part.groups.back();
        }
        const auto [found, isNew] = part.groupOf.try_emplace({material, hasNormals}, part.groups.size());
        if (isNew) {
            part.groups.push_back({material, hasNormals, {}});
        }
        return part.groups[found->second];
    }

    // Whether the vertices of the scene can be those of the file.
    bool hasOneIndexPerVertex() const {
        return parts_.size() == 1 && parts_[0].groups.size() == 1 && mesh_.cornerNormal.empty() &&
               mesh_.cornerTexCoord.empty() && mesh_.cornerColor.empty() && !source_.repeatsPositions;
    }

    void addWhole() {
        MeshGeometry geometry;
        geometry.triangles = std::move(parts_[0].groups[0].triangles);
        for (glm::uvec3& triangle : geometry.triangles) {
            triangle = {mesh_.cornerPosition[triangle.x], mesh_.cornerPosition[triangle.y],
                        mesh_.cornerPosition[triangle.z]};
        }
        geometry.positions = std::move(mesh_.positions);
        geometry.normals = std::move(mesh_.normals);
        geometry.texCoords[0] = std::move(mesh_.texCoords);
        geometry.colors = std::move(mesh_.colors);
        const std::string label = labelOf(0);
        InstanceWriter writer(scene_, file_, {nameOf(0)}, label, toWorld_);
        write(writer, label, std::move(geometry), parts_[0].groups[0].material);
        writer.finish();
    }

    // Makes one index of equal values, so that corners with equal attributes can share a vertex.
    void findEqualAttributes() {
        if (source_.repeatsPositions) {
            firstPosition_ = firstEqual(mesh_.positions);
        }
        firstNormal_ = firstEqual(mesh_.normals);
        firstTexCoord_ = firstEqual(mesh_.texCoords);
        firstColor_ = firstEqual(mesh_.colors);
    }

    CornerIndices attributesOf(std::uint32_t corner) const {
        const auto attribute = [&](const std::vector<std::uint32_t>& indices,
                                   const std::vector<std::uint32_t>& first) {
            const std::uint32_t index = indices.empty() ? mesh_.cornerPosition[corner] : indices[corner];
            return first.empty() || index == kNoIndex ? kNoIndex : first[index];
        };
        const std::uint32_t position = mesh_.cornerPosition[corner];
        return {firstPosition_.empty() ? position : firstPosition_[position],
                attribute(mesh_.cornerNormal, firstNormal_), attribute(mesh_.cornerTexCoord, firstTexCoord_),
                attribute(mesh_.cornerColor, firstColor_)};
    }

    void addPart(std::uint32_t index) {
        const std::string label = labelOf(index);
        if (parts_[index].groups.empty()) {
            return;
        }
        InstanceWriter writer(scene_, file_, {nameOf(index), index}, label, toWorld_);
        for (Group& group : parts_[index].groups) {
            write(writer, label, geometryOf(group), group.material);
        }
        writer.finish();
    }

    MeshGeometry geometryOf(Group& group) const {
        std::vector<CornerIndices> corners;
        corners.reserve(3 * group.triangles.size());
        for (const glm::uvec3& triangle : group.triangles) {
            for (int i = 0; i < 3; ++i) {
                corners.push_back(attributesOf(triangle[i]));
            }
        }
        const JoinedCorners joined = joinCorners(corners);
        MeshGeometry geometry;
        geometry.triangles = std::move(group.triangles);
        for (std::size_t i = 0; i < geometry.triangles.size(); ++i) {
            geometry.triangles[i] = {joined.vertex[3 * i], joined.vertex[3 * i + 1],
                                     joined.vertex[3 * i + 2]};
        }
        const auto attribute = [&](int which) {
            std::vector<std::uint32_t> indices;
            indices.reserve(joined.kept.size());
            for (const std::uint32_t corner : joined.kept) {
                indices.push_back(corners[corner][which]);
            }
            return indices;
        };
        geometry.positions = gathered(mesh_.positions, attribute(0), glm::vec3(0.0f));
        if (group.hasNormals) {
            geometry.normals = gathered(mesh_.normals, attribute(1), glm::vec3(0.0f));
        }
        if (!mesh_.texCoords.empty()) {
            geometry.texCoords[0] = gathered(mesh_.texCoords, attribute(2), glm::vec2(0.0f));
        }
        if (!mesh_.colors.empty()) {
            geometry.colors = gathered(mesh_.colors, attribute(3), glm::vec4(1.0f));
        }
        return geometry;
    }

    void write(InstanceWriter& writer, const std::string& label, MeshGeometry geometry,
               std::uint32_t material) {
        if (material != kNoMaterial && needsTangents(scene_.materials[material]) &&
            !geometry.texCoords[0].empty()) {
            addTangents(geometry, 0);
        }
        writer.write(label, geometry, material);
    }

    // One line for all parts: a file can have one for each of its faces.
    void warnOfFaces(std::uint64_t Part::*count, const std::string& which, const std::string& what) {
        NameList labels;
        std::uint64_t faces = 0;
        for (std::uint32_t part = 0; part < parts_.size(); ++part) {
            if (parts_[part].*count > 0) {
                labels.add(labelOf(part));
                faces += parts_[part].*count;
            }
        }
        if (faces > 0) {
            file_.warn(labels.text() + ": " + std::to_string(faces) + (faces == 1 ? " face " : " faces ") +
                       which + (faces == 1 ? " is " : " are ") + what);
        }
    }

    std::string nameOf(std::uint32_t part) const {
        return mesh_.partNames.empty() ? std::string() : mesh_.partNames[part];
    }
    std::string labelOf(std::uint32_t part) const { return elementName("mesh", nameOf(part), part); }

    MeshFile source_;
    PolygonMesh& mesh_; // of source_
    InputFile& file_;
    const ImportOptions& options_;
    glm::dmat4 toWorld_;
    std::vector<Part> parts_;
    // Indexed by value: the first value that equals it. Empty: there are no values, or all may stay apart.
    std::vector<std::uint32_t> firstPosition_;
    std::vector<std::uint32_t> firstNormal_;
    std::vector<std::uint32_t> firstTexCoord_;
    std::vector<std::uint32_t> firstColor_;
    Scene scene_;
};

MeshFile readMesh(InputFile& file, const std::string& ending) {
    const std::vector<unsigned char> bytes = file.read();
    const std::string_view content(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (ending == ".obj") {
        return readObj(file, content);
    }
    if (ending == ".ply") {
        return readPly(file, content);
    }
    return ending == ".off" ? readOff(file, content) : readStl(file, content);
}

} // namespace

Scene importMesh(InputFile& file, const std::string& ending, const ImportOptions& options) {
    // These formats have one scene without a name, no variants and no animations.
    const std::vector<std::string> scenes = {""};
    if (!options.scene.empty()) {
        chooseIndex("scene", scenes, options.scene);
    }
    if (!options.variant.empty()) {
        chooseIndex("variant", {}, options.variant);
    }
    if (!options.animation.empty()) {
        chooseIndex("animation", {}, options.animation);
    }
    if (options.time) {
        file.warn("there is no animation, it looks the same at any time");
    }
    Scene scene = MeshImporter(readMesh(file, ending), file, options).import();
    scene.scenes = scenes;
    return scene;
}

} // namespace metamarch

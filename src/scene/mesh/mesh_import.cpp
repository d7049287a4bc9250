// SPDX-License-Identifier: MIT
#include "metamarch/scene/mesh/mesh_import.h"

#include "metamarch/scene/choice.h"
#include "metamarch/scene/instance_writer.h"
#include "metamarch/scene/mesh/mesh_check.h"
#include "metamarch/scene/mesh/mtl_material.h"
#include "metamarch/scene/mesh/vertex_join.h"

#include <assimp/BaseImporter.h>
#include <assimp/DefaultIOSystem.h>
#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <span>
#include <string_view>

namespace metamarch {
namespace {

// An OBJ names its material library. This class lets Assimp read it only from the scene's folder.
class FolderIo : public Assimp::DefaultIOSystem {
  public:
    explicit FolderIo(InputFile& file) : file_(file) {}

    bool Exists(const char* name) const override {
        return file_.isBeside(name) && Assimp::DefaultIOSystem::Exists(name);
    }

    Assimp::IOStream* Open(const char* name, const char* mode) override {
        if (!file_.isBeside(name)) {
            file_.warn(std::string("'") + name + "' leaves the scene's folder and is not read");
            return nullptr;
        }
        Assimp::IOStream* stream = Assimp::DefaultIOSystem::Open(name, mode);
        if (stream == nullptr) {
            file_.warn(std::string("'") + name + "' cannot be opened");
        }
        return stream;
    }

  private:
    InputFile& file_;
};

// If the importer for the file's ending fails, Assimp tries all others. Only that one importer may see an
// untrusted file.
void keepOnlyImporter(Assimp::Importer& importer, const std::string& ending) {
    for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
        Assimp::BaseImporter* candidate = importer.GetImporter(i);
        std::set<std::string> endings;
        candidate->GetExtensionList(endings);
        if (endings.contains(ending.substr(1))) {
            continue;
        }
        importer.UnregisterLoader(candidate); // this makes us the owner
        delete candidate;
    }
}

class MeshImporter {
  public:
    MeshImporter(const aiScene& source, InputFile& file, const std::string& ending,
                 const ImportOptions& options)
        : source_(source), file_(file), ending_(ending), options_(options), textures_(file),
          toWorld_(glm::scale(glm::dmat4(1.0), glm::dvec3(static_cast<double>(options.scale)))) {}

    Scene import() {
        addMaterials();
        for (std::uint32_t i = 0; i < source_.mNumMeshes; ++i) {
            addMesh(*source_.mMeshes[i], i);
        }
        if (scene_.triangles.empty()) {
            file_.refuse("there is no triangle in it");
        }
        loadTextures(scene_, file_, textures_.sources(), options_.allowMissingTextures);
        return std::move(scene_);
    }

  private:
    // Only OBJ has materials. For other formats, and for an OBJ without materials, Assimp makes one up.
    void addMaterials() {
        materials_.assign(source_.mNumMaterials, kNoMaterial);
        for (std::uint32_t i = 0; i < source_.mNumMaterials; ++i) {
            const aiMaterial& material = *source_.mMaterials[i];
            if (ending_ != ".obj" || material.GetName() == aiString(AI_DEFAULT_MATERIAL_NAME)) {
                continue;
            }
            materials_[i] = static_cast<std::uint32_t>(scene_.materials.size());
            scene_.materials.push_back(textures_.read(material));
        }
        scene_.textures = textures_.textures();
    }

    void addMesh(const aiMesh& mesh, std::uint32_t index) {
        const std::string label = elementName("mesh", mesh.mName.C_Str(), index);
        const bool isStl = ending_ == ".stl";
        const JoinedVertices vertices =
            isStl || ending_ == ".obj" ? joinVertices(mesh, !isStl) : keepVertices(mesh);
        const std::span<const aiFace> faces(mesh.mFaces, mesh.mNumFaces);
        const auto triangles = static_cast<std::uint64_t>(
            std::ranges::count(faces, 3u, [](const aiFace& face) { return face.mNumIndices; }));
        if (triangles < faces.size()) {
            file_.warn(label + ": " + std::to_string(faces.size() - triangles) +
                       " points, lines or polygons that cannot be triangulated are not rendered");
        }
        if (triangles == 0) {
            return;
        }

        MeshGeometry geometry = readVertices(mesh, vertices.kept);
        geometry.triangles.reserve(triangles);
        for (const aiFace& face : faces) {
            if (face.mNumIndices == 3) {
                geometry.triangles.emplace_back(joinedIndex(vertices, face, 0),
                                                joinedIndex(vertices, face, 1),
                                                joinedIndex(vertices, face, 2));
            }
        }
        checkIndices(file_, label, geometry);
        const std::uint32_t material =
            mesh.mMaterialIndex < materials_.size() ? materials_[mesh.mMaterialIndex] : kNoMaterial;
        if (material != kNoMaterial && needsTangents(scene_.materials[material]) &&
            mesh.HasTextureCoords(0)) {
            addTangents(geometry, 0);
        }
        InstanceWriter writer(scene_, file_, mesh.mName.C_Str(), label, toWorld_);
        writer.write(label, geometry, material);
        writer.finish();
    }

    // STL has one normal per facet. It equals the triangle's normal and would prevent vertices from being
    // joined.
    MeshGeometry readVertices(const aiMesh& mesh, const std::vector<std::uint32_t>& kept) const {
        const bool hasNormals = mesh.HasNormals() && ending_ != ".stl";
        const bool hasTexCoords = mesh.HasTextureCoords(0);
        MeshGeometry geometry;
        for (const std::uint32_t vertex : kept) {
            const aiVector3D& position = mesh.mVertices[vertex];
            geometry.positions.emplace_back(position.x, position.y, position.z);
            if (hasNormals) {
                geometry.normals.emplace_back(mesh.mNormals[vertex].x, mesh.mNormals[vertex].y,
                                              mesh.mNormals[vertex].z);
            }
            if (hasTexCoords) {
                geometry.texCoords[0].emplace_back(mesh.mTextureCoords[0][vertex].x,
                                                   // OBJ's v points up.
                                                   1.0f - mesh.mTextureCoords[0][vertex].y);
            }
        }
        return geometry;
    }

    // Leaves an index that is out of range as it is, so that checkIndices reports it.
    static std::uint32_t joinedIndex(const JoinedVertices& vertices, const aiFace& face, int corner) {
        const std::uint32_t index = face.mIndices[corner];
        return index < vertices.group.size() ? vertices.group[index] : index;
    }

    const aiScene& source_;
    InputFile& file_;
    const std::string& ending_;
    const ImportOptions& options_;
    MtlTextures textures_;
    glm::dmat4 toWorld_;
    std::vector<std::uint32_t> materials_; // indexed by Assimp's material index
    Scene scene_;
};

// OBJ has no counts and no end marker to check.
std::optional<MeshCounts> checkMesh(const InputFile& file, const std::string& ending) {
    const std::vector<unsigned char> bytes = file.read();
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (ending == ".ply") {
        return checkPly(file, text);
    }
    if (ending == ".off") {
        return checkOff(file, text);
    }
    if (ending == ".stl") {
        checkStl(file, text);
    }
    return std::nullopt;
}

// A last safeguard in case our checker and Assimp read a file differently.
void compareCounts(const InputFile& file, const aiScene& source, const MeshCounts& checked) {
    MeshCounts found;
    for (std::uint32_t i = 0; i < source.mNumMeshes; ++i) {
        found.vertices += source.mMeshes[i]->mNumVertices;
        found.faces += source.mMeshes[i]->mNumFaces;
    }
    if (found.vertices != checked.vertices || (checked.faces != 0 && found.faces != checked.faces)) {
        file.refuse("of " + std::to_string(checked.vertices) + " vertices and " +
                    std::to_string(checked.faces) + " faces only " + std::to_string(found.vertices) +
                    " and " + std::to_string(found.faces) + " can be used");
    }
}

// Assimp's triangulation does not check indices, and aborts if a polygon without corners leaves it nothing to
// do.
void checkFaces(const InputFile& file, const aiScene& source) {
    for (std::uint32_t i = 0; i < source.mNumMeshes; ++i) {
        const aiMesh& mesh = *source.mMeshes[i];
        for (std::uint32_t j = 0; j < mesh.mNumFaces; ++j) {
            const std::span<const unsigned int> indices(mesh.mFaces[j].mIndices, mesh.mFaces[j].mNumIndices);
            const auto face = [&] {
                return elementName("mesh", mesh.mName.C_Str(), i) + ": face " + std::to_string(j);
            };
            if (indices.empty()) {
                file.refuse(face() + " has no corners");
            }
            for (const unsigned int index : indices) {
                if (index >= mesh.mNumVertices) {
                    file.refuse(face() + ": index " + std::to_string(index) + " is out of range, there are " +
                                std::to_string(mesh.mNumVertices) + " vertices");
                }
            }
        }
    }
}

} // namespace

Scene importMesh(InputFile& file, const std::string& ending, const ImportOptions& options) {
    // These formats have no variants and no animations, so any choice of one is an error.
    if (!options.variant.empty()) {
        chooseIndex("variant", {}, options.variant);
    }
    if (!options.animation.empty()) {
        chooseIndex("animation", {}, options.animation);
    }
    if (options.time) {
        file.warn("there is no animation, it looks the same at any time");
    }
    const std::optional<MeshCounts> checked = checkMesh(file, ending);
    Assimp::Importer importer;
    importer.SetIOHandler(new FolderIo(file)); // the importer deletes it
    keepOnlyImporter(importer, ending);
    const aiScene* source = importer.ReadFile(file.path().string(), 0);
    if (source != nullptr && checked) {
        compareCounts(file, *source, *checked); // compare before polygons become triangles
    }
    if (source != nullptr) {
        checkFaces(file, *source);
        source = importer.ApplyPostProcessing(aiProcess_Triangulate);
    }
    if (source == nullptr) {
        file.refuse(std::string("not ") + ending.substr(1) + ": " + importer.GetErrorString());
    }
    return MeshImporter(*source, file, ending, options).import();
}

} // namespace metamarch

// SPDX-License-Identifier: MIT
#include "metamarch/scene/mesh/assimp_obj.h"

#include "metamarch/scene/mesh/mtl_material.h"

#include <assimp/BaseImporter.h>
#include <assimp/DefaultIOSystem.h>
#include <assimp/Importer.hpp>
#include <assimp/scene.h>

#include <set>

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
void keepOnlyObjImporter(Assimp::Importer& importer) {
    for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
        Assimp::BaseImporter* candidate = importer.GetImporter(i);
        std::set<std::string> endings;
        candidate->GetExtensionList(endings);
        if (endings.contains("obj")) {
            continue;
        }
        importer.UnregisterLoader(candidate); // this makes us the owner
        delete candidate;
    }
}

// Assimp makes one up for an OBJ without materials.
bool isMadeUp(const aiMaterial& material) { return material.GetName() == aiString(AI_DEFAULT_MATERIAL_NAME); }

void addMesh(const InputFile& file, PolygonMesh& to, const aiMesh& mesh, std::uint32_t material) {
    const auto first = static_cast<std::uint32_t>(to.positions.size());
    for (std::uint32_t i = 0; i < mesh.mNumVertices; ++i) {
        to.positions.emplace_back(mesh.mVertices[i].x, mesh.mVertices[i].y, mesh.mVertices[i].z);
        if (mesh.HasNormals()) {
            to.normals.emplace_back(mesh.mNormals[i].x, mesh.mNormals[i].y, mesh.mNormals[i].z);
        }
        if (mesh.HasTextureCoords(0)) {
            // OBJ's v points up.
            to.texCoords.emplace_back(mesh.mTextureCoords[0][i].x, 1.0f - mesh.mTextureCoords[0][i].y);
        }
    }
    const std::string label =
        elementName("mesh", mesh.mName.C_Str(), static_cast<std::uint32_t>(to.partNames.size()));
    for (std::uint32_t i = 0; i < mesh.mNumFaces; ++i) {
        for (std::uint32_t j = 0; j < mesh.mFaces[i].mNumIndices; ++j) {
            const std::uint32_t index = mesh.mFaces[i].mIndices[j];
            if (index >= mesh.mNumVertices) {
                file.refuse(label + ": face " + std::to_string(i) + ": index " + std::to_string(index) +
                            " is out of range, there are " + std::to_string(mesh.mNumVertices) + " vertices");
            }
            to.cornerPosition.push_back(first + index);
            to.cornerNormal.push_back(mesh.HasNormals() ? static_cast<std::uint32_t>(to.normals.size()) -
                                                              mesh.mNumVertices + index
                                                        : kNoIndex);
            to.cornerTexCoord.push_back(mesh.HasTextureCoords(0)
                                            ? static_cast<std::uint32_t>(to.texCoords.size()) -
                                                  mesh.mNumVertices + index
                                            : kNoIndex);
        }
        endFace(file, to);
        to.faceMaterial.push_back(material);
        to.facePart.push_back(static_cast<std::uint32_t>(to.partNames.size()));
    }
    to.partNames.emplace_back(mesh.mName.C_Str());
}

} // namespace

MeshFile readObjWithAssimp(InputFile& file) {
    Assimp::Importer importer;
    importer.SetIOHandler(new FolderIo(file)); // the importer deletes it
    keepOnlyObjImporter(importer);
    const aiScene* source = importer.ReadFile(file.path().string(), 0);
    if (source == nullptr) {
        file.refuse(std::string("not obj: ") + importer.GetErrorString());
    }
    MeshFile result;
    result.repeatsPositions = true;
    MtlTextures textures(file);
    std::vector<std::uint32_t> materials(source->mNumMaterials, kNoIndex);
    for (std::uint32_t i = 0; i < source->mNumMaterials; ++i) {
        if (!isMadeUp(*source->mMaterials[i])) {
            materials[i] = static_cast<std::uint32_t>(result.materials.size());
            result.materials.push_back(textures.read(*source->mMaterials[i]));
        }
    }
    result.textures = textures.textures();
    result.textureSources = textures.sources();
    for (std::uint32_t i = 0; i < source->mNumMeshes; ++i) {
        const aiMesh& mesh = *source->mMeshes[i];
        addMesh(file, result.polygons, mesh,
                mesh.mMaterialIndex < materials.size() ? materials[mesh.mMaterialIndex] : kNoIndex);
    }
    return result;
}

} // namespace metamarch

#include "scene/mesh_import.h"

#include "scene/instance_writer.h"
#include "scene/mesh_check.h"
#include "scene/vertex_join.h"

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

// An OBJ names its material library; it is read only from the scene's folder.
class FolderIo : public Assimp::DefaultIOSystem {
  public:
    explicit FolderIo(SceneFile& file) : file_(file) {}

    bool Exists(const char* name) const override {
        return file_.isBeside(name) && Assimp::DefaultIOSystem::Exists(name);
    }

    Assimp::IOStream* Open(const char* name, const char* mode) override {
        if (!file_.isBeside(name)) {
            file_.warn(std::string("'") + name + "' leaves the scene's folder and is not read");
            return nullptr;
        }
        Assimp::IOStream* stream = Assimp::DefaultIOSystem::Open(name, mode);
        if (stream == nullptr)
            file_.warn(std::string("'") + name + "' cannot be opened");
        return stream;
    }

  private:
    SceneFile& file_;
};

// Assimp tries every importer it has when the one for the ending fails; only that one may see an untrusted
// file.
void keepOnlyImporter(Assimp::Importer& importer, const std::string& ending) {
    for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
        Assimp::BaseImporter* candidate = importer.GetImporter(i);
        std::set<std::string> endings;
        candidate->GetExtensionList(endings);
        if (endings.contains(ending.substr(1)))
            continue;
        importer.UnregisterLoader(candidate); // which leaves it to us
        delete candidate;
    }
}

float channel(float value) { return value > 0.0f ? std::min(value, 1.0f) : 0.0f; }

Material readMaterial(const aiMaterial& source) {
    Material material;
    material.name = source.GetName().C_Str();
    aiColor3D color;
    if (source.Get(AI_MATKEY_COLOR_DIFFUSE, color) == AI_SUCCESS)
        material.baseColor = glm::vec4(channel(color.r), channel(color.g), channel(color.b), 1.0f);
    if (source.Get(AI_MATKEY_COLOR_EMISSIVE, color) == AI_SUCCESS &&
        std::isfinite(color.r + color.g + color.b))
        material.emission = glm::max(glm::vec3(color.r, color.g, color.b), glm::vec3(0.0f));
    return material;
}

class MeshImporter {
  public:
    MeshImporter(const aiScene& source, SceneFile& file, const std::string& ending, double scale)
        : source_(source), file_(file), ending_(ending),
          toWorld_(glm::scale(glm::dmat4(1.0), glm::dvec3(scale))) {}

    Scene import() {
        addMaterials();
        for (std::uint32_t i = 0; i < source_.mNumMeshes; ++i)
            addMesh(*source_.mMeshes[i], i);
        if (scene_.triangles.empty())
            file_.refuse("there is no triangle in it");
        return std::move(scene_);
    }

  private:
    // Of these formats only OBJ has materials; the others get one from Assimp, and so does an OBJ without.
    void addMaterials() {
        materials_.assign(source_.mNumMaterials, kNoMaterial);
        for (std::uint32_t i = 0; i < source_.mNumMaterials; ++i) {
            const aiMaterial& material = *source_.mMaterials[i];
            if (ending_ != ".obj" || material.GetName() == aiString(AI_DEFAULT_MATERIAL_NAME))
                continue;
            materials_[i] = static_cast<std::uint32_t>(scene_.materials.size());
            scene_.materials.push_back(readMaterial(material));
        }
    }

    void addMesh(const aiMesh& mesh, std::uint32_t index) {
        const std::string label = elementName("mesh", mesh.mName.C_Str(), index);
        const bool isStl = ending_ == ".stl";
        const JoinedVertices vertices =
            isStl || ending_ == ".obj" ? joinVertices(mesh, !isStl) : keepVertices(mesh);
        const std::span<const aiFace> faces(mesh.mFaces, mesh.mNumFaces);
        const auto triangles = static_cast<std::uint64_t>(
            std::ranges::count(faces, 3u, [](const aiFace& face) { return face.mNumIndices; }));
        if (triangles < faces.size())
            file_.warn(label + ": " + std::to_string(faces.size() - triangles) +
                       " points, lines or polygons that cannot be triangulated are not rendered");
        if (triangles == 0)
            return;

        InstanceWriter writer(scene_, file_, mesh.mName.C_Str(), label, toWorld_);
        writer.beginPart(label, vertices.kept.size(), triangles,
                         mesh.mMaterialIndex < materials_.size() ? materials_[mesh.mMaterialIndex]
                                                                 : kNoMaterial);
        for (const std::uint32_t vertex : vertices.kept)
            addVertex(mesh, vertex, writer);
        for (const aiFace& face : faces) {
            if (face.mNumIndices == 3)
                writer.addTriangle(joinedIndex(vertices, face, 0), joinedIndex(vertices, face, 1),
                                   joinedIndex(vertices, face, 2));
        }
        writer.finish();
    }

    // STL has one normal per facet, which the triangle has anyway and which would keep its vertices apart.
    void addVertex(const aiMesh& mesh, std::uint32_t vertex, InstanceWriter& writer) const {
        std::optional<glm::dvec3> normal;
        std::optional<glm::dvec2> texCoord;
        if (mesh.HasNormals() && ending_ != ".stl")
            normal = glm::dvec3(mesh.mNormals[vertex].x, mesh.mNormals[vertex].y, mesh.mNormals[vertex].z);
        if (mesh.HasTextureCoords(0))
            texCoord = glm::dvec2(mesh.mTextureCoords[0][vertex].x, mesh.mTextureCoords[0][vertex].y);
        const aiVector3D& position = mesh.mVertices[vertex];
        writer.addVertex(glm::dvec3(position.x, position.y, position.z), normal, texCoord);
    }

    // An index out of range stays one, for the writer to name.
    static std::uint32_t joinedIndex(const JoinedVertices& vertices, const aiFace& face, int corner) {
        const std::uint32_t index = face.mIndices[corner];
        return index < vertices.group.size() ? vertices.group[index] : index;
    }

    const aiScene& source_;
    SceneFile& file_;
    const std::string& ending_;
    glm::dmat4 toWorld_;
    std::vector<std::uint32_t> materials_; // [Assimp's index]
    Scene scene_;
};

// OBJ is read as far as it goes: it has no counts and no end to check.
std::optional<MeshCounts> checkMesh(const SceneFile& file, const std::string& ending) {
    const std::vector<unsigned char> bytes = file.read();
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (ending == ".ply")
        return checkPly(file, text);
    if (ending == ".off")
        return checkOff(file, text);
    if (ending == ".stl")
        checkStl(file, text);
    return std::nullopt;
}

// A last defence against the two readers of a file not reading it alike.
void compareCounts(const SceneFile& file, const aiScene& source, const MeshCounts& checked) {
    MeshCounts found;
    for (std::uint32_t i = 0; i < source.mNumMeshes; ++i) {
        found.vertices += source.mMeshes[i]->mNumVertices;
        found.faces += source.mMeshes[i]->mNumFaces;
    }
    if (found.vertices != checked.vertices || (checked.faces != 0 && found.faces != checked.faces))
        file.refuse("of " + std::to_string(checked.vertices) + " vertices and " +
                    std::to_string(checked.faces) + " faces only " + std::to_string(found.vertices) +
                    " and " + std::to_string(found.faces) + " can be used");
}

// Triangulation reads whatever an index names, and aborts where a polygon without corners leaves it nothing
// to do.
void checkFaces(const SceneFile& file, const aiScene& source) {
    for (std::uint32_t i = 0; i < source.mNumMeshes; ++i) {
        const aiMesh& mesh = *source.mMeshes[i];
        for (std::uint32_t j = 0; j < mesh.mNumFaces; ++j) {
            const std::span<const unsigned int> indices(mesh.mFaces[j].mIndices, mesh.mFaces[j].mNumIndices);
            const auto face = [&] {
                return elementName("mesh", mesh.mName.C_Str(), i) + ": face " + std::to_string(j);
            };
            if (indices.empty())
                file.refuse(face() + " has no corners");
            for (const unsigned int index : indices) {
                if (index >= mesh.mNumVertices)
                    file.refuse(face() + ": index " + std::to_string(index) + " is out of range, there are " +
                                std::to_string(mesh.mNumVertices) + " vertices");
            }
        }
    }
}

} // namespace

Scene importMesh(SceneFile& file, const std::string& ending, double scale) {
    const std::optional<MeshCounts> checked = checkMesh(file, ending);
    Assimp::Importer importer;
    importer.SetIOHandler(new FolderIo(file)); // the importer deletes it
    keepOnlyImporter(importer, ending);
    const aiScene* source = importer.ReadFile(file.path().string(), 0);
    if (source != nullptr && checked)
        compareCounts(file, *source, *checked); // before polygons become triangles
    if (source != nullptr) {
        checkFaces(file, *source);
        source = importer.ApplyPostProcessing(aiProcess_Triangulate);
    }
    if (source == nullptr)
        file.refuse(std::string("not ") + ending.substr(1) + ": " + importer.GetErrorString());
    return MeshImporter(*source, file, ending, scale).import();
}

} // namespace metamarch

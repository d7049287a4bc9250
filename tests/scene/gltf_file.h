// SPDX-License-Identifier: MIT
// Small glTF files that a test writes and reads.
#pragma once
#include "fixtures/temporary_folder.h"
#include "metamarch/scene/import.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace metamarch {

// A glTF with one buffer, stored in scene.bin, and by default one node with one mesh. Tests modify `root`
// freely.
class GltfFile {
  public:
    nlohmann::json root = {
        {"asset", {{"version", "2.0"}}},
        {"scenes", {{{"nodes", {0}}}}},
        {"nodes", {{{"mesh", 0}}}},
        {"meshes", {{{"name", "body"}, {"primitives", {{{"attributes", nlohmann::json::object()}}}}}}},
        {"accessors", nlohmann::json::array()},
        {"bufferViews", nlohmann::json::array()}};

    nlohmann::json& primitive() { return root["meshes"][0]["primitives"][0]; }
    nlohmann::json& node() { return root["nodes"][0]; }

    // Appends the numbers to the buffer and returns the index of a buffer view of them.
    template <typename T>
    int addView(const std::vector<T>& numbers) {
        const std::size_t offset = bytes_.size();
        bytes_.resize(offset + numbers.size() * sizeof(T));
        if (!numbers.empty()) {
            std::memcpy(bytes_.data() + offset, numbers.data(), numbers.size() * sizeof(T));
        }
        root["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", numbers.size() * sizeof(T)}});
        bytes_.resize((bytes_.size() + 3) / 4 * 4);
        return static_cast<int>(root["bufferViews"].size()) - 1;
    }

    int addAccessor(const nlohmann::json& accessor) {
        root["accessors"].push_back(accessor);
        return static_cast<int>(root["accessors"].size()) - 1;
    }

    // `size` is the number of components of this type.
    int addFloats(const char* type, std::size_t size, const std::vector<float>& numbers) {
        return addAccessor({{"bufferView", addView(numbers)},
                            {"componentType", kFloat},
                            {"count", numbers.size() / size},
                            {"type", type}});
    }

    int addVec3(const std::vector<float>& numbers) { return addFloats("VEC3", 3, numbers); }

    int addIndices(const std::vector<std::uint16_t>& indices) {
        return addAccessor({{"bufferView", addView(indices)},
                            {"componentType", kUnsignedShort},
                            {"count", indices.size()},
                            {"type", "SCALAR"}});
    }

    void setPositions(const std::vector<float>& numbers) {
        primitive()["attributes"]["POSITION"] = addVec3(numbers);
    }

    std::filesystem::path write(const std::string& name = "scene.gltf");
    Scene load(const ImportOptions& options = {}) { return loadScene(write(), options); }
    // Returns the message of the inputRefused error that loading must throw, without the file's path.
    std::string refusal();

    std::size_t byteCount() const { return bytes_.size(); }

    TemporaryFolder folder;

    static constexpr int kByte = 5120;
    static constexpr int kUnsignedByte = 5121;
    static constexpr int kShort = 5122;
    static constexpr int kUnsignedShort = 5123;
    static constexpr int kUnsignedInt = 5125;
    static constexpr int kFloat = 5126;

  private:
    std::vector<unsigned char> bytes_;
};

// A GltfFile with one triangle, (0,0,0) (1,0,0) (0,1,0), which faces +z.
class TriangleFile : public GltfFile {
  public:
    TriangleFile() { setPositions({0, 0, 0, 1, 0, 0, 0, 1, 0}); }
};

void writeFile(const std::filesystem::path& path, const std::string& content);

// Returns the message of the inputRefused error that loading `path` must throw, without the leading path.
std::string refusalOf(const std::filesystem::path& path);

} // namespace metamarch

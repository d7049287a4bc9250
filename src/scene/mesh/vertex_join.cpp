// SPDX-License-Identifier: MIT
#include "metamarch/scene/mesh/vertex_join.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <unordered_map>

namespace metamarch {
namespace {

// Bits rather than floats: a NaN then equals itself and is reported later.
using Key = std::array<std::uint32_t, 8>;

struct KeyHash {
    std::size_t operator()(const Key& key) const {
        std::uint64_t hash = 0xcbf29ce484222325u; // FNV-1a, one word at a time
        for (const std::uint32_t word : key) {
            hash = (hash ^ word) * 0x100000001b3u;
        }
        return static_cast<std::size_t>(hash ^ (hash >> 32));
    }
};

Key keyOf(const aiMesh& mesh, std::uint32_t vertex, bool whole) {
    std::array<float, 8> numbers{};
    const aiVector3D position = mesh.mVertices[vertex];
    std::copy_n(&position.x, 3, numbers.begin());
    if (whole && mesh.HasNormals()) {
        std::copy_n(&mesh.mNormals[vertex].x, 3, numbers.begin() + 3);
    }
    if (whole && mesh.HasTextureCoords(0)) {
        std::copy_n(&mesh.mTextureCoords[0][vertex].x, 2, numbers.begin() + 6);
    }
    Key key;
    std::transform(numbers.begin(), numbers.end(), key.begin(),
                   [](float number) { return std::bit_cast<std::uint32_t>(number + 0.0f); });
    return key;
}

} // namespace

JoinedVertices joinVertices(const aiMesh& mesh, bool whole) {
    JoinedVertices joined;
    joined.group.reserve(mesh.mNumVertices);
    std::unordered_map<Key, std::uint32_t, KeyHash> groups;
    for (std::uint32_t vertex = 0; vertex < mesh.mNumVertices; ++vertex) {
        const auto [found, isNew] =
            groups.try_emplace(keyOf(mesh, vertex, whole), static_cast<std::uint32_t>(joined.kept.size()));
        if (isNew) {
            joined.kept.push_back(vertex);
        }
        joined.group.push_back(found->second);
    }
    return joined;
}

JoinedVertices keepVertices(const aiMesh& mesh) {
    JoinedVertices all;
    all.kept.resize(mesh.mNumVertices);
    std::iota(all.kept.begin(), all.kept.end(), 0u);
    all.group = all.kept;
    return all;
}

} // namespace metamarch

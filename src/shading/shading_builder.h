// SPDX-License-Identifier: MIT
// From a scene and its light to what the path tracer reads.
#pragma once
#include "metamarch/scene/scene.h"
#include "metamarch/shading/surroundings.h"
#include "metamarch/shared/shading_scene.h"

#include <cstdint>

namespace metamarch {

// Every device lets a shader see that much of a buffer.
inline constexpr std::uint64_t kTexelChunkBytes = std::uint64_t{128} << 20u;

struct ShadingOptions {
    bool isSingleScatter = false; // --brdf gltf
    bool isWhite =
        false; // every surface a white diffuse reflector without light of its own (--integrator ao)

    bool operator==(const ShadingOptions&) const = default;
};

// Throws Error(outOfMemory) where the textures do not fit kTexelChunks chunks of `chunkBytes`, naming their
// size.
ShadingScene makeShadingScene(const Scene& scene, const Surroundings& surroundings,
                              const ShadingOptions& options, std::uint64_t chunkBytes = kTexelChunkBytes);

} // namespace metamarch

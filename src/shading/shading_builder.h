// SPDX-License-Identifier: MIT
// Builds the data that the path tracer reads from a scene and its light.
#pragma once
#include "metamarch/scene/scene.h"
#include "metamarch/shading/surroundings.h"
#include "metamarch/shared/shading_scene.h"

#include <cstdint>
#include <optional>

namespace metamarch {

// The largest range of a buffer that a shader can see on every device.
inline constexpr std::uint64_t kTexelChunkBytes = std::uint64_t{128} << 20u;

struct ShadingOptions {
    bool isSingleScatter = false; // the BRDF `gltf`
    bool isWhite = false;         // the integrator `ao`: all surfaces are white, diffuse and not emissive
    std::uint32_t catcher = kNoMaterial;      // the material of the surfaces that only catch shadow
    std::optional<float> catcherReflection{}; // as in PathChoice

    bool operator==(const ShadingOptions&) const = default;
};

// Throws Error(outOfMemory), naming their size, if the textures do not fit kTexelChunks chunks of
// `chunkBytes` bytes.
ShadingScene makeShadingScene(const Scene& scene, const Surroundings& surroundings,
                              const ShadingOptions& options, std::uint64_t chunkBytes = kTexelChunkBytes);

} // namespace metamarch

// From a scene and its light to what the path tracer reads.
#pragma once
#include "metamarch/scene/scene.h"
#include "metamarch/shading/light/environment.h"
#include "metamarch/shared/shading_scene.h"

#include <glm/glm.hpp>

#include <optional>

namespace metamarch {

// Light that does not come from the scene's file.
struct Surroundings {
    glm::vec3 background{0.0f};             // radiance from everywhere, where there is no map
    std::optional<Environment> environment; // not empty
    float rotation = 0.0f;                  // radians; turns the map around y, from +z towards +x
    float intensity = 1.0f;                 // multiplies the map's radiance, at least 0
    std::optional<LightRecord> sun;         // a kLightDisc
};

struct ShadingOptions {
    bool isSingleScatter = false; // --brdf gltf
    bool isWhite =
        false; // every surface a white diffuse reflector without light of its own (--integrator ao)

    bool operator==(const ShadingOptions&) const = default;
};

// Throws Error(outOfMemory) where the textures do not fit kTexelChunks chunks of `chunkBytes`, naming their
// size.
ShadingScene makeShadingScene(const Scene& scene, const Surroundings& surroundings,
                              const ShadingOptions& options, std::uint64_t chunkBytes);

} // namespace metamarch

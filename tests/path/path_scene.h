// SPDX-License-Identifier: MIT
// Scenes for the path tracer, made in memory, and what its film says of them.
#pragma once
#include "metamarch/scene/scene.h"
#include "metamarch/shading/shading_builder.h"
#include "metamarch/shading/view.h"
#include "metamarch/shared/film.h"

#include <cstdint>
#include <span>
#include <vector>

namespace metamarch::tests {

struct PathScene {
    Scene scene;
    Surroundings surroundings;
    ShadingOptions options;
    SceneCamera view;
    CameraOptions camera;
    std::uint64_t chunkBytes = std::uint64_t{1} << 30; // of textures
};

struct PathWork {
    std::uint32_t samples = 16; // of each pixel
    std::uint32_t maxBounces = 8;
    std::uint32_t seed = 0;
    std::uint32_t strategies = kSampleLights | kSampleBsdf;
    std::uint32_t side = 16; // of the picture, in pixels
    float clampLuminance = 0.0f;
};

// The render settings of a scene's light and of the work.
PathSettings settingsOf(const ShadingScene& shading, const PathWork& work);

ShadingScene shadingOf(const PathScene& made);

// Of a square picture, by the CPU.
std::vector<FilmPixel> render(const PathScene& made, const PathWork& work);

// Of all pixels, or of those of which every sample met a surface.
glm::dvec3 meanOf(std::span<const FilmPixel> film);
glm::dvec3 coveredMeanOf(std::span<const FilmPixel> film);
glm::dvec3 meanOf(const FilmPixel& pixel);
std::uint64_t rejectedOf(std::span<const FilmPixel> film);

// What `target` looks like from `eye`: a picture 1e-4 radians high, in which nothing changes. The samples of
// its 64 pixels are independent.
glm::dvec3 probe(const PathScene& made, glm::vec3 eye, glm::vec3 target, PathWork work);

// Materials. The first is a pure Lambert reflector.
Material lambert(glm::vec3 albedo);
Material unlit(glm::vec3 color);
Material emitter(glm::vec3 radiance); // black, to its front
Material metal(glm::vec3 color, float roughness);
Material glass(float ior, float roughness); // a volume without attenuation

std::uint32_t addMaterial(Scene& scene, const Material& material);

// A parallelogram; its front is where cross(right, up) points. Texture coordinates go from (0, 0) at `corner`
// to (1, 1).
void addQuad(Scene& scene, glm::vec3 corner, glm::vec3 right, glm::vec3 up, std::uint32_t material);

// Six quads, their fronts outwards or inwards.
enum class Facing { outwards, inwards };
void addBox(Scene& scene, glm::vec3 lo, glm::vec3 hi, std::uint32_t material,
            Facing facing = Facing::outwards);

// A tessellated sphere with texture coordinates; its facets are flat unless `isSmooth`.
void addBall(Scene& scene, glm::vec3 center, float radius, std::uint32_t material, bool isSmooth = false,
             std::uint32_t slices = 32);

// A triangle whose front is not on the side of `inside`.
void addFacet(Scene& scene, glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 inside, std::uint32_t material);

void addPointLight(Scene& scene, glm::vec3 position, float candela);

// A map of `height` rows and twice as many columns, of radiance 1 above the horizon and 0 below.
Environment upperHalf(std::uint32_t height);

// An image of 8-bit texels with its texture; returns the latter. `width` texels a row. The filter, nearest or
// linear, is that from far, too.
std::uint32_t addTexture(Scene& scene, std::uint32_t width, const std::vector<glm::u8vec4>& texels,
                         TextureFilter filter);

} // namespace metamarch::tests

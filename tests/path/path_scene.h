// SPDX-License-Identifier: MIT
// Makes scenes for the path tracer in memory, renders them and evaluates their films.
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
    std::uint64_t chunkBytes = std::uint64_t{1} << 30; // largest size of a chunk of texels
};

struct PathWork {
    std::uint32_t samples = 16; // of each pixel
    std::uint32_t maxBounces = 8;
    std::uint32_t seed = 0;
    std::uint32_t strategies = kSampleLights | kSampleBsdf;
    std::uint32_t side = 16; // of the picture, in pixels
    float clampLuminance = 0.0f;
    std::uint32_t filmParts = 0; // kFilm…; for BothSides
};

// Returns the settings of the path tracer for a scene's light and for the work.
PathSettings settingsOf(const ShadingScene& shading, const PathWork& work);

ShadingScene shadingOf(const PathScene& made);

// Renders a square picture on the CPU.
std::vector<FilmPixel> render(const PathScene& made, const PathWork& work);

// Return the mean radiance of all pixels, or only of those whose samples have all hit a surface.
glm::dvec3 meanOf(std::span<const FilmPixel> film);
glm::dvec3 coveredMeanOf(std::span<const FilmPixel> film);
glm::dvec3 meanOf(const FilmPixel& pixel);
std::uint64_t rejectedOf(std::span<const FilmPixel> film);

// Returns the radiance from `target` at `eye`: the mean of a picture that is 1e-4 radians high, in which the
// radiance hardly varies. The samples of its 64 pixels are independent.
glm::dvec3 probe(const PathScene& made, glm::vec3 eye, glm::vec3 target, PathWork work);

// Materials. lambert() reflects only diffusely.
Material lambert(glm::vec3 albedo);
Material unlit(glm::vec3 color);
Material emitter(glm::vec3 radiance); // black; emits on its front
Material metal(glm::vec3 color, float roughness);
Material glass(float ior, float roughness); // a volume without attenuation

std::uint32_t addMaterial(Scene& scene, const Material& material);

// Appends a parallelogram. Its front is on the side of cross(right, up). Texture coordinates go from (0, 0)
// at `corner` to (1, 1).
void addQuad(Scene& scene, glm::vec3 corner, glm::vec3 right, glm::vec3 up, std::uint32_t material);

// Appends a box of six quads, with their fronts outwards or inwards.
enum class Facing { outwards, inwards };
void addBox(Scene& scene, glm::vec3 lo, glm::vec3 hi, std::uint32_t material,
            Facing facing = Facing::outwards);

// Appends a tessellated sphere with texture coordinates. Its facets are flat unless `isSmooth`.
void addBall(Scene& scene, glm::vec3 center, float radius, std::uint32_t material, bool isSmooth = false,
             std::uint32_t slices = 32);

// Appends a triangle whose back is on the side of `inside`.
void addFacet(Scene& scene, glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 inside, std::uint32_t material);

void addPointLight(Scene& scene, glm::vec3 position, float candela);

// Returns a map with `height` rows and twice as many columns. The radiance is 1 above the horizon and 0
// below.
Environment upperHalf(std::uint32_t height);

// Appends an image of 8-bit texels, with `width` texels per row, and a texture of it; returns the texture's
// index. `filter` is for magnification and minification.
std::uint32_t addTexture(Scene& scene, std::uint32_t width, const std::vector<glm::u8vec4>& texels,
                         TextureFilter filter);

} // namespace metamarch::tests

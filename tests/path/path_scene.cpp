// SPDX-License-Identifier: MIT
#include "path/path_scene.h"

#include "fixtures/shapes.h"
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/reference/eye_media.h"
#include "metamarch/reference/path.h"

#include <cmath>

namespace metamarch::tests {
namespace {

constexpr std::uint32_t kProbeSide = 8;
constexpr float kProbeFov = 1e-4f;

// Appends a vertex as addTriangle does, with texture coordinates.
std::uint32_t addVertex(Scene& scene, const glm::vec3 position, const glm::vec2 texCoord) {
    scene.positions.push_back(position);
    scene.normals.emplace_back(0.0f);
    scene.texCoords.push_back(texCoord);
    return static_cast<std::uint32_t>(scene.positions.size() - 1);
}

void addIndices(Scene& scene, const glm::uvec3 indices, const std::uint32_t material) {
    if (scene.meshes.empty()) {
        scene.meshes.push_back({"made"});
    }
    scene.triangles.push_back(indices);
    scene.triangleMesh.push_back(0);
    scene.triangleMaterial.push_back(material);
}

} // namespace

ShadingScene shadingOf(const PathScene& made) {
    return makeShadingScene(made.scene, made.surroundings, made.options, made.chunkBytes);
}

PathSettings settingsOf(const ShadingScene& shading, const PathWork& work) {
    PathSettings settings = shading.settings;
    settings.maxBounces = work.maxBounces;
    settings.seed = work.seed;
    settings.strategies = work.strategies;
    settings.clampLuminance = work.clampLuminance;
    return settings;
}

std::vector<FilmPixel> render(const PathScene& made, const PathWork& work) {
    const AccelerationStructure structure = buildAccelerationStructure(made.scene, {});
    const ShadingScene shading = shadingOf(made);
    const Camera camera = makeCamera(made.view, work.side, work.side, made.camera);
    PathSettings settings = settingsOf(shading, work);
    settings.eyeMedia = mediaAt(structure, shading, camera.eye);
    return renderPathsByJudge(structure, shading, settings, camera, work.samples, {}).pixels;
}

glm::dvec3 meanOf(const FilmPixel& pixel) {
    return glm::dvec3(pixel.radiance) / static_cast<double>(pixel.samples - pixel.rejected);
}

glm::dvec3 meanOf(const std::span<const FilmPixel> film) {
    glm::dvec3 sum(0.0);
    double samples = 0.0;
    for (const FilmPixel& pixel : film) {
        sum += glm::dvec3(pixel.radiance);
        samples += pixel.samples - pixel.rejected;
    }
    return sum / samples;
}

glm::dvec3 coveredMeanOf(const std::span<const FilmPixel> film) {
    std::vector<FilmPixel> covered;
    for (const FilmPixel& pixel : film) {
        if (pixel.covered == static_cast<float>(pixel.samples)) {
            covered.push_back(pixel);
        }
    }
    return meanOf(covered);
}

std::uint64_t rejectedOf(const std::span<const FilmPixel> film) {
    std::uint64_t rejected = 0;
    for (const FilmPixel& pixel : film) {
        rejected += pixel.rejected;
    }
    return rejected;
}

glm::dvec3 probe(const PathScene& made, const glm::vec3 eye, const glm::vec3 target, PathWork work) {
    PathScene seen = made;
    const glm::vec3 along = glm::normalize(target - eye);
    seen.view = lookAt(eye, target, std::abs(along.y) > 0.9f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0));
    seen.view.verticalFov = kProbeFov;
    work.side = kProbeSide;
    return meanOf(render(seen, work));
}

Material lambert(const glm::vec3 albedo) {
    Material material;
    material.baseColorFactor = glm::vec4(albedo, 1.0f);
    material.metallicFactor = 0.0f;
    material.specularFactor = 0.0f;
    return material;
}

Material unlit(const glm::vec3 color) {
    Material material = lambert(color);
    material.unlit = true;
    return material;
}

Material emitter(const glm::vec3 radiance) {
    Material material = lambert(glm::vec3(0.0f));
    material.emissiveFactor = radiance;
    return material;
}

Material metal(const glm::vec3 color, const float roughness) {
    Material material;
    material.baseColorFactor = glm::vec4(color, 1.0f);
    material.roughnessFactor = roughness;
    return material;
}

Material glass(const float ior, const float roughness) {
    Material material;
    material.metallicFactor = 0.0f;
    material.roughnessFactor = roughness;
    material.transmissionFactor = 1.0f;
    material.thicknessFactor = 1.0f;
    material.ior = ior;
    return material;
}

std::uint32_t addMaterial(Scene& scene, const Material& material) {
    scene.materials.push_back(material);
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

void addQuad(Scene& scene, const glm::vec3 corner, const glm::vec3 right, const glm::vec3 up,
             const std::uint32_t material) {
    const std::uint32_t first = addVertex(scene, corner, {0.0f, 0.0f});
    addVertex(scene, corner + right, {1.0f, 0.0f});
    addVertex(scene, corner + right + up, {1.0f, 1.0f});
    addVertex(scene, corner + up, {0.0f, 1.0f});
    addIndices(scene, {first, first + 1, first + 2}, material);
    addIndices(scene, {first, first + 2, first + 3}, material);
}

void addBox(Scene& scene, const glm::vec3 lo, const glm::vec3 hi, const std::uint32_t material,
            const Facing facing) {
    const auto corner = [&](const unsigned i) {
        return glm::vec3(i & 1u ? hi.x : lo.x, i & 2u ? hi.y : lo.y, i & 4u ? hi.z : lo.z);
    };
    constexpr unsigned kFaces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                       {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (const auto& face : kFaces) {
        const bool isTurned = facing == Facing::inwards;
        const std::uint32_t first = addVertex(scene, corner(face[0]), {0.0f, 0.0f});
        addVertex(scene, corner(face[isTurned ? 3 : 1]), {1.0f, 0.0f});
        addVertex(scene, corner(face[2]), {1.0f, 1.0f});
        addVertex(scene, corner(face[isTurned ? 1 : 3]), {0.0f, 1.0f});
        addIndices(scene, {first, first + 1, first + 2}, material);
        addIndices(scene, {first, first + 2, first + 3}, material);
    }
}

void addBall(Scene& scene, const glm::vec3 center, const float radius, const std::uint32_t material,
             const bool isSmooth, const std::uint32_t slices) {
    const std::size_t firstVertex = scene.positions.size();
    const std::size_t firstTriangle = scene.triangles.size();
    addSphere(scene, center, radius, slices, slices / 2);
    for (std::size_t i = firstVertex; i < scene.positions.size(); ++i) {
        const glm::vec3 direction = glm::normalize(scene.positions[i] - center);
        scene.normals[i] = isSmooth ? direction : glm::vec3(0.0f);
        scene.texCoords[i] = {0.5f + 0.5f * direction.x, 0.5f - 0.5f * direction.y};
    }
    for (std::size_t i = firstTriangle; i < scene.triangles.size(); ++i) {
        scene.triangleMaterial[i] = material;
    }
}

void addFacet(Scene& scene, const glm::vec3 a, const glm::vec3 b, const glm::vec3 c, const glm::vec3 inside,
              const std::uint32_t material) {
    const bool isTurned = glm::dot(glm::cross(b - a, c - a), inside - a) > 0.0f;
    const std::uint32_t first = addVertex(scene, a, {0.0f, 0.0f});
    addVertex(scene, isTurned ? c : b, {1.0f, 0.0f});
    addVertex(scene, isTurned ? b : c, {0.0f, 1.0f});
    addIndices(scene, {first, first + 1, first + 2}, material);
}

void addPointLight(Scene& scene, const glm::vec3 position, const float candela) {
    PunctualLight light;
    light.position = position;
    light.intensity = candela;
    scene.lights.push_back(light);
}

Environment upperHalf(const std::uint32_t height) {
    Environment map;
    map.width = 2 * height;
    map.height = height;
    for (std::uint32_t i = 0; i < map.width * map.height; ++i) {
        map.texels.emplace_back(i / map.width < height / 2 ? 1.0f : 0.0f);
    }
    return map;
}

std::uint32_t addTexture(Scene& scene, const std::uint32_t width, const std::vector<glm::u8vec4>& texels,
                         const TextureFilter filter) {
    TextureImage image;
    image.name = "made";
    image.width = width;
    image.height = static_cast<std::uint32_t>(texels.size()) / width;
    image.bytes = texels;
    scene.images.push_back(image);
    Texture texture;
    texture.image = static_cast<std::uint32_t>(scene.images.size() - 1);
    texture.magFilter = filter;
    texture.minFilter = filter;
    scene.textures.push_back(texture);
    return static_cast<std::uint32_t>(scene.textures.size() - 1);
}

} // namespace metamarch::tests

// SPDX-License-Identifier: MIT
#include "metamarch/shading/shadow_catcher.h"

#include "metamarch/error/error.h"
#include "metamarch/scene/choice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace metamarch {
namespace {

constexpr const char* kName = "shadow catcher";
constexpr double kReach = 20.0; // in sizes of the scene; 1 / tan(3 degrees) is 19
// How far the lowest plane lies below the scene, so that flat undersides are not in the same place: in sizes
// of the scene, and in parts of the height, for scenes far from the origin. Rays leave the plane 0.9e-4 sizes
// above it (SurfacePoint::lift).
constexpr double kGap = 2.5e-4;
constexpr double kGapOfHeight = 1e-6;

// What objects see of the plane: the grey that Blender gives to new surfaces.
std::uint32_t addGround(Scene& scene) {
    Material ground;
    ground.name = kName;
    ground.baseColorFactor = glm::vec4(0.8f, 0.8f, 0.8f, 1.0f);
    ground.metallicFactor = 0.0f;
    ground.specularFactor = 0.0f;
    scene.materials.push_back(ground);
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

// Returns the largest extent of what is above `height`.
double sizeAbove(const Bounds& bounds, const double height) {
    const glm::dvec3 size = glm::dvec3(bounds.hi) - glm::dvec3(bounds.lo);
    return std::max({size.x, bounds.hi.y - height, size.z});
}

float heightUnder(const Bounds& bounds) {
    const double lowest = bounds.lo.y;
    const double gap = kGap * sizeAbove(bounds, lowest) + kGapOfHeight * std::abs(lowest);
    return static_cast<float>(lowest - gap);
}

void addSquare(Scene& scene, const Bounds& bounds, const float height, const std::uint32_t material) {
    const glm::dvec3 lo = bounds.lo;
    const glm::dvec3 hi = bounds.hi;
    const double reach = kReach * sizeAbove(bounds, height);
    const auto place = [&](const double x, const double z) {
        constexpr double kFar = 1e30;
        return glm::vec3(glm::clamp(x, -kFar, kFar), height, glm::clamp(z, -kFar, kFar));
    };
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    scene.positions.push_back(place(lo.x - reach, lo.z - reach));
    scene.positions.push_back(place(lo.x - reach, hi.z + reach));
    scene.positions.push_back(place(hi.x + reach, hi.z + reach));
    scene.positions.push_back(place(hi.x + reach, lo.z - reach));
    const std::size_t vertices = scene.positions.size();
    scene.normals.resize(vertices, glm::vec3(0.0f));
    scene.texCoords.resize(vertices, glm::vec2(0.0f));
    for (std::vector<glm::vec2>* const set : {&scene.texCoords1, &scene.texCoords2, &scene.texCoords3}) {
        set->resize(set->empty() ? 0 : vertices, glm::vec2(0.0f));
    }
    scene.colors.resize(scene.colors.empty() ? 0 : vertices, glm::vec4(1.0f));
    scene.tangents.resize(scene.tangents.empty() ? 0 : vertices, glm::vec4(0.0f));

    std::uint32_t mesh = 0;
    for (const MeshInstance& instance : scene.meshes) {
        mesh = std::max(mesh, instance.mesh + 1);
    }
    scene.meshes.push_back({kName, mesh, kName, kName});
    for (const glm::uvec3 corners : {glm::uvec3(0, 1, 2), glm::uvec3(0, 2, 3)}) {
        scene.triangles.push_back(corners + first);
        scene.triangleMesh.push_back(static_cast<std::uint32_t>(scene.meshes.size() - 1));
        scene.triangleMaterial.push_back(material);
    }
}

} // namespace

std::uint32_t catcherMaterial(const Scene& scene, const std::string& selection) {
    std::vector<std::string> names;
    names.reserve(scene.materials.size());
    for (const Material& material : scene.materials) {
        names.push_back(material.name);
    }
    try {
        return static_cast<std::uint32_t>(chooseIndex("material", names, selection, "scene"));
    } catch (const Error& error) {
        throw Error(error.kind, std::string(error.what()) + "; a plane is y=HEIGHT or auto",
                    {"shadow-catcher"});
    }
}

std::uint32_t placeCatcher(Scene& scene, const CatcherChoice& choice) {
    if (!choice.isPlane()) {
        return catcherMaterial(scene, choice.material);
    }
    Bounds bounds = boundsOf(scene);
    if (scene.triangles.empty()) {
        bounds = {glm::vec3(-0.5f, 0.0f, -0.5f), glm::vec3(0.5f, 1.0f, 0.5f)};
    }
    const std::uint32_t material = addGround(scene);
    addSquare(scene, bounds, choice.kind == CatcherChoice::Kind::plane ? choice.height : heightUnder(bounds),
              material);
    return material;
}

} // namespace metamarch

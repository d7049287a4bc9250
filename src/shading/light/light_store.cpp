// SPDX-License-Identifier: MIT
#include "metamarch/shading/light/light_store.h"

#include "metamarch/shading/light/light_tree.h"
#include "metamarch/shading/light/weighted_table.h"
#include "metamarch/shared/hit_point.h"
#include "metamarch/shared/material.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace metamarch {
namespace {

// The power of each light, by kind. Half of a light's sampling probability follows its power; the other half
// is shared equally among the kinds that exist, so that no kind drowns out the others.
struct Weights {
    std::vector<double> emitters;
    std::vector<double> lights;
    double environment = 0.0;
};

double areaOf(const Emitter& emitter) {
    const glm::dvec3 e1 = glm::dvec3(emitter.v1) - glm::dvec3(emitter.v0);
    const glm::dvec3 e2 = glm::dvec3(emitter.v2) - glm::dvec3(emitter.v0);
    return 0.5 * glm::length(glm::cross(e1, e2));
}

LightRecord recordOf(const PunctualLight& light) {
    LightRecord record{};
    record.position = light.position;
    record.strength = light.color * light.intensity;
    switch (light.type) {
    case PunctualLight::Type::directional:
        record.kind = kLightDirectional;
        record.direction = -light.direction;
        break;
    case PunctualLight::Type::point:
        record.kind = kLightPoint;
        record.direction = light.direction;
        break;
    case PunctualLight::Type::spot: {
        record.kind = kLightSpot;
        record.direction = light.direction;
        const double inner = light.innerConeAngle;
        const double outer = light.outerConeAngle;
        const glm::vec2 falloff =
            makeSpotFalloff(static_cast<float>(std::cos(inner)), static_cast<float>(std::cos(outer)));
        record.scale = falloff.x;
        record.offset = falloff.y;
        break;
    }
    }
    return record;
}

// Returns roughly the watts that reach a scene with this radius.
double powerOf(const LightRecord& light, const double radius) {
    const double strength = luminance(light.strength);
    switch (light.kind) {
    case kLightDirectional:
        return strength * M_PI * radius * radius;
    case kLightDisc:
        return strength * 2.0 * M_PI * light.scale * M_PI * radius * radius;
    default:
        return strength * 4.0 * M_PI;
    }
}

void addEmitters(const Scene& scene, const std::span<const glm::vec3> meanEmission, ShadingScene& target,
                 Weights& weights) {
    for (std::uint32_t triangleId = 0; triangleId < scene.triangles.size(); ++triangleId) {
        const std::uint32_t materialId = target.surfaces[triangleId].material;
        const double strength = luminance(meanEmission[materialId]);
        const glm::uvec3 corners = scene.triangles[triangleId];
        const Emitter emitter{scene.positions[corners.x], triangleId, scene.positions[corners.y], materialId,
                              scene.positions[corners.z], 0};
        const vec3 normal = scaledNormal(emitter.v0, emitter.v1, emitter.v2);
        const bool isDegenerate = largest(abs(normal)) < kSmallestNormal;
        if (strength > 0.0 && !isDegenerate) {
            const double sides =
                (target.materials[materialId].flags & kMaterialDoubleSided) != 0u ? 2.0 : 1.0;
            target.emitters.push_back(emitter);
            weights.emitters.push_back(strength * M_PI * sides * areaOf(emitter));
        }
    }
}

// Returns the tables, which go behind that of all lights.
EnvironmentTables addEnvironment(const Environment& environment, ShadingScene& target, Weights& weights,
                                 const double radius) {
    EnvironmentTables tables = makeEnvironmentTables(environment);
    target.environment.reserve(environment.texels.size());
    for (std::size_t i = 0; i < environment.texels.size(); ++i) {
        target.environment.emplace_back(environment.texels[i], tables.weights[i]);
    }
    target.settings.blockColumnShift = tables.blockColumnShift;
    target.settings.blockRowShift = tables.blockRowShift;
    target.settings.environmentWidth = environment.width;
    target.settings.environmentHeight = environment.height;
    double sum = 0.0;
    double area = 0.0;
    for (std::uint32_t y = 0; y < environment.height; ++y) {
        const double sine = std::sin(M_PI * (y + 0.5) / environment.height);
        for (std::uint32_t x = 0; x < environment.width; ++x) {
            sum += luminance(environment.texels[std::size_t{y} * environment.width + x]) * sine;
            area += sine;
        }
    }
    weights.environment = sum / area * target.settings.environmentScale * 4.0 * M_PI * M_PI * radius * radius;
    target.features |= kFeatureEnvironment;
    return tables;
}

// Returns the probability of each light, in the table's order.
std::vector<double> probabilities(const Weights& weights) {
    const double emitters = std::accumulate(weights.emitters.begin(), weights.emitters.end(), 0.0);
    const double lights = std::accumulate(weights.lights.begin(), weights.lights.end(), 0.0);
    const double all = emitters + lights + weights.environment;
    const double kinds = (emitters > 0.0) + (lights > 0.0) + (weights.environment > 0.0);
    const auto share = [&](const double weight, const double kind) {
        return weight > 0.0 ? 0.5 * weight / all + 0.5 * weight / kind / kinds : 0.0;
    };
    std::vector<double> result;
    result.reserve(weights.emitters.size() + weights.lights.size() + 1);
    for (const double weight : weights.emitters) {
        result.push_back(share(weight, emitters));
    }
    for (const double weight : weights.lights) {
        result.push_back(share(weight, lights));
    }
    result.push_back(share(weights.environment, weights.environment));
    return result;
}

// Returns the mean radiance of an emitter by 16 points, so that a tree knows which parts of an emissive
// texture are bright. `mean` is that of its material. A tenth of it counts, because the points may miss
// light.
double radianceOf(const ShadingScene& scene, const Emitter& emitter, const double mean) {
    const MaterialRecord& material = scene.materials[emitter.material];
    if (material.emissionTexture == kNoTextureRecord) {
        return mean;
    }
    constexpr int kPoints = 16;
    double sum = 0.0;
    for (int i = 0; i < kPoints; ++i) {
        // M. Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018.
        const glm::dvec2 u =
            glm::fract(0.5 + static_cast<double>(i) * glm::dvec2(0.7548776662466927, 0.5698402909980532));
        const vec3 weights = sampleTriangle(vec2(u));
        const Surface& surface = scene.surfaces[emitter.triangleId];
        const TexturePoint at = finestPoint(scene, surface, weights);
        const vec3 texel = vec3(lookUp(scene, material.emissionTexture, at));
        sum += luminance(material.emission * texel) * coverage(scene, material, surface, weights, at);
    }
    return 0.9 * sum / kPoints + 0.1 * mean;
}

// Returns the emitter for the tree. `radiance` is its mean.
PlacedLight placedEmitter(const Emitter& emitter, const double radiance, const bool isTwoSided) {
    const glm::dvec3 v0(emitter.v0);
    const glm::dvec3 v1(emitter.v1);
    const glm::dvec3 v2(emitter.v2);
    return {.corners = {v0, v1, v2},
            .axis = glm::normalize(glm::cross(v1 - v0, v2 - v0)),
            .isTwoSided = isTwoSided,
            .intensity = radiance * areaOf(emitter)};
}

bool isPlaced(const LightRecord& light) { return light.kind == kLightPoint || light.kind == kLightSpot; }

PlacedLight placedPunctual(const LightRecord& light) {
    const glm::dvec3 position(light.position);
    const bool isSpot = light.kind == kLightSpot;
    // The cosines of the cones of a spot: see makeSpotFalloff.
    const double outer = -double{light.offset} / light.scale;
    const double inner = outer + 1.0 / light.scale;
    const auto angle = [](const double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)); };
    return {.corners = {position, position, position},
            .axis = glm::normalize(glm::dvec3(light.direction)),
            .spread = isSpot ? inner : -1.0,
            .end = isSpot ? std::cos(angle(outer) - angle(inner)) : 0.0,
            .intensity = luminance(light.strength)};
}

// With more lights than this that have a place, a tree chooses among them. Two may be the halves of one
// quadrilateral, which a table samples as well.
constexpr std::size_t kFewLights = 2;

// Replaces the entries of all lights that have a place in `chances`, the table of lights, by one entry for a
// tree of them, if they are many.
void addLightTree(const std::span<const glm::vec3> meanEmission, ShadingScene& target,
                  std::vector<double>& chances) {
    std::vector<PlacedLight> placed;
    std::vector<std::uint32_t> indices; // of lights: emitters first, then punctual lights
    double chance = 0.0;
    const auto add = [&](const std::size_t index, const PlacedLight& light) {
        if (light.intensity > 0.0) {
            placed.push_back(light);
            indices.push_back(static_cast<std::uint32_t>(index));
            chance += chances[index];
        }
    };
    for (std::size_t i = 0; i < target.emitters.size(); ++i) {
        const Emitter& emitter = target.emitters[i];
        const bool isTwoSided = (target.materials[emitter.material].flags & kMaterialDoubleSided) != 0u;
        const double radiance = radianceOf(target, emitter, luminance(meanEmission[emitter.material]));
        add(i, placedEmitter(emitter, radiance, isTwoSided));
    }
    for (std::size_t i = 0; i < target.lights.size(); ++i) {
        if (isPlaced(target.lights[i])) {
            add(target.emitters.size() + i, placedPunctual(target.lights[i]));
        }
    }
    if (placed.size() <= kFewLights) {
        return;
    }
    LightTree tree = makeLightTree(placed);
    for (LightNode& node : tree.nodes) {
        if (node.link >= kLightLeaf) {
            node.link = kLightLeaf | indices[node.link & ~kLightLeaf];
        }
    }
    for (std::size_t i = 0; i < placed.size(); ++i) {
        if (indices[i] < target.emitters.size()) {
            target.emitters[indices[i]].branches = tree.branches[i];
        } else {
            chances[indices[i]] = 0.0;
        }
    }
    target.lightNodes = std::move(tree.nodes);
    target.features |= kFeatureLightTree;
    chances.erase(chances.begin(), chances.begin() + static_cast<std::ptrdiff_t>(target.emitters.size()));
    chances.insert(chances.begin(), chance);
}

} // namespace

void addLights(const std::span<const PunctualLight> lights, const Scene& scene,
               const Surroundings& surroundings, const std::span<const glm::vec3> meanEmission,
               ShadingScene& target) {
    const Bounds bounds = boundsOf(scene);
    const double radius = scene.triangles.empty() ? 1.0 : 0.5 * glm::distance(bounds.lo, bounds.hi);
    PathSettings& settings = target.settings;
    settings.background = surroundings.background;
    const double rotation = surroundings.rotation;
    settings.environmentCosine = static_cast<float>(std::cos(rotation));
    settings.environmentSine = static_cast<float>(std::sin(rotation));
    settings.environmentScale = surroundings.intensity;
    settings.sunIndex = kNoSun;

    Weights weights;
    addEmitters(scene, meanEmission, target, weights);
    for (const PunctualLight& light : lights) {
        target.lights.push_back(recordOf(light));
    }
    if (surroundings.sun) {
        settings.sunIndex = static_cast<std::uint32_t>(target.lights.size());
        target.lights.push_back(*surroundings.sun);
    }
    for (const LightRecord& light : target.lights) {
        weights.lights.push_back(powerOf(light, radius));
    }
    EnvironmentTables tables;
    if (surroundings.environment) {
        tables = addEnvironment(*surroundings.environment, target, weights, radius);
    }

    std::vector<double> chances = probabilities(weights);
    const bool hasLight = std::ranges::any_of(chances, [](const double chance) { return chance > 0.0; });
    settings.emitterCount = static_cast<std::uint32_t>(target.emitters.size());
    settings.punctualCount = static_cast<std::uint32_t>(target.lights.size());
    settings.environmentProbability = static_cast<float>(chances.back());
    target.features |= hasLight ? kFeatureLights : 0u;
    for (std::size_t i = 0; i < target.emitters.size(); ++i) {
        // Equal for all emitters of a material.
        const double density = chances[i] / areaOf(target.emitters[i]);
        target.materials[target.emitters[i].material].emissionDensity = static_cast<float>(density);
    }
    addLightTree(meanEmission, target, chances);
    settings.lightCount = static_cast<std::uint32_t>(chances.size());
    const std::vector<float> rounded(chances.begin(), chances.end());
    const std::vector<TableEntry> ofAll = makeWeightedTable(rounded);
    target.tables.reserve(ofAll.size() + tables.blocks.size() + tables.rows.size() + tables.columns.size());
    for (const auto& part :
         {std::span(ofAll), std::span<const TableEntry>(tables.blocks),
          std::span<const TableEntry>(tables.rows), std::span<const TableEntry>(tables.columns)}) {
        target.tables.insert(target.tables.end(), part.begin(), part.end());
    }
}

} // namespace metamarch

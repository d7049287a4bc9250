// SPDX-License-Identifier: MIT
#include "path/gpu_scenes.h"

#include "metamarch/shading/light/sky.h"

#include <cmath>

namespace metamarch::tests {
namespace {

// Adds a texture of waves with four different channels, with 8 bits per channel or deep.
std::uint32_t addWaves(Scene& scene, const bool isDeep, const TextureWrap wrap = TextureWrap::repeat) {
    constexpr std::uint32_t kSide = 12;
    std::vector<glm::u8vec4> bytes;
    std::vector<glm::vec4> floats;
    for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
        const float x = static_cast<float>(i % kSide);
        const std::uint32_t row = i / kSide;
        const auto y = static_cast<float>(row);
        const glm::vec4 texel = 0.5f + 0.4f * glm::sin(glm::vec4(x, y, x + y + 1.0f, 0.7f * x - y) *
                                                       glm::vec4(1.1f, 0.9f, 0.6f, 1));
        floats.push_back(texel);
        bytes.emplace_back(texel * 255.0f);
    }
    const std::uint32_t texture = addTexture(scene, kSide, bytes, TextureFilter::linear);
    scene.textures.back().wrapS = wrap;
    scene.textures.back().wrapT = wrap;
    if (isDeep) {
        scene.images.back().bytes.clear();
        scene.images.back().floats = floats;
    }
    return texture;
}

// Returns a ball with the first material, a floor with the second, and a wall. `change` may add more.
constexpr std::uint32_t kFloor = 1;
using Change = std::function<void(PathScene& made, Material& ball)>;

PathScene ballScene(const Change& change) {
    PathScene made;
    Scene& scene = made.scene;
    const std::uint32_t ball = addMaterial(scene, metal({0.9f, 0.6f, 0.3f}, 0.35f));
    scene.materials[ball].metallicFactor = 0.2f;
    addBall(scene, {0, 1, 0}, 0.9f, ball, true, 12);
    addQuad(scene, {-3, 0, 3}, {6, 0, 0}, {0, 0, -6}, addMaterial(scene, lambert({0.6f, 0.7f, 0.5f})));
    addQuad(scene, {-3, 0, -2}, {6, 0, 0}, {0, 4, 0}, addMaterial(scene, lambert({0.3f, 0.4f, 0.8f})));
    scene.tangents.assign(scene.positions.size(), glm::vec4(0.6f, 0.0f, 0.8f, 1.0f));
    scene.tangents[3].w = -1.0f;
    made.surroundings.background = {0.3f, 0.4f, 0.5f};
    made.view = lookAt({1.5f, 2.0f, 4.0f}, {0, 0.9f, 0}, {0, 1, 0});
    // `change` may add materials and so move them, so it gets a copy.
    Material changed = scene.materials[ball];
    change(made, changed);
    scene.materials[ball] = changed;
    scene.tangents.resize(scene.positions.size(), glm::vec4(0.0f));
    return made;
}

PathScene ofMaterial(const std::function<void(Material& ball)>& change) {
    return ballScene([&](PathScene&, Material& ball) { change(ball); });
}

void coat(Material& m) {
    m.clearcoatFactor = 0.8f;
    m.clearcoatRoughnessFactor = 0.2f;
}
void sheen(Material& m) {
    m.sheenColorFactor = {0.9f, 0.5f, 0.7f};
    m.sheenRoughnessFactor = 0.4f;
}
void thinGlass(Material& m) {
    m.metallicFactor = 0.0f;
    m.transmissionFactor = 0.8f;
}
void volume(Material& m) {
    thinGlass(m);
    m.thicknessFactor = 1.0f;
    m.attenuationDistance = 0.7f;
    m.attenuationColor = {0.9f, 0.4f, 0.2f};
}
void smoothVolume(Material& m) {
    volume(m);
    m.transmissionFactor = 1.0f;
    m.roughnessFactor = 0.0f;
}
void iridescence(Material& m) {
    m.iridescenceFactor = 0.9f;
    m.iridescenceThicknessMaximum = 550.0f;
}
void diffuseTransmission(Material& m) {
    m.metallicFactor = 0.0f;
    m.diffuseTransmissionFactor = 0.5f;
    m.diffuseTransmissionColorFactor = {0.2f, 0.9f, 0.3f};
}
void anisotropy(Material& m) {
    m.anisotropyStrength = 0.7f;
    m.anisotropyRotation = 0.8f;
}
void dispersion(Material& m) {
    smoothVolume(m);
    m.dispersion = 2.0f;
}
void specular(Material& m) {
    m.specularFactor = 0.6f;
    m.specularColorFactor = {1.5f, 0.3f, 0.8f};
}

void textures(PathScene& made, Material& ball, const bool isDeep) {
    ball.baseColorTexture = {addWaves(made.scene, isDeep, TextureWrap::mirroredRepeat), 0, true};
    ball.baseColorTexture.transform = glm::mat3x2(3.0f, 0.5f, -0.7f, 2.0f, 0.1f, -0.3f);
    ball.metallicRoughnessTexture = {addWaves(made.scene, isDeep, TextureWrap::clampToEdge), 1};
    ball.emissiveTexture = {addWaves(made.scene, isDeep), 0, true};
    ball.emissiveFactor = {0.4f, 0.3f, 0.2f};
    made.scene.textures.back().magFilter = TextureFilter::nearest;
    made.scene.textures.back().minFilter = TextureFilter::nearest;
    made.scene.texCoords1 = made.scene.texCoords;
    for (glm::vec2& place : made.scene.texCoords1) {
        place = glm::vec2(1.7f * place.y - 0.3f, place.x);
    }
}

// Four sets of texture coordinates, each its own, with levels.
void furtherSets(PathScene& made, Material& ball) {
    textures(made, ball, false);
    ball.transmissionFactor = 0.5f;
    ball.transmissionTexture = {addWaves(made.scene, false), 2};
    ball.emissiveTexture.texCoord = 3;
    for (Texture& texture : made.scene.textures) {
        texture.minFilter = TextureFilter::linearMipmapLinear;
    }
    made.scene.texCoords2 = made.scene.texCoords;
    made.scene.texCoords3 = made.scene.texCoords1;
    for (std::size_t i = 0; i < made.scene.texCoords2.size(); ++i) {
        made.scene.texCoords2[i] = 2.3f * made.scene.texCoords2[i] + glm::vec2(0.1f, 0.4f);
        made.scene.texCoords3[i] = 0.6f * made.scene.texCoords3[i] - glm::vec2(0.7f, 0.2f);
    }
}

// Returns a floor with many repetitions of a texture, which are smaller than a pixel at its far end.
void mipmaps(PathScene& made, const bool isDeep, const TextureFilter minFilter,
             const TextureFilter magFilter = TextureFilter::linear) {
    TextureRef waves{addWaves(made.scene, isDeep), 0, true};
    waves.transform = glm::mat3x2(9.0f, 2.0f, -2.0f, 9.0f, 0.0f, 0.0f);
    made.scene.textures.back().magFilter = magFilter;
    made.scene.textures.back().minFilter = minFilter;
    made.scene.materials[kFloor].baseColorTexture = waves;
}

void normalMap(PathScene& made, Material& ball) {
    ball.normalTexture = {addWaves(made.scene, false)};
    ball.normalScale = 0.7f;
}

void colors(PathScene& made) {
    for (std::size_t i = 0; i < made.scene.positions.size(); ++i) {
        const float x = static_cast<float>(i % 7) / 7.0f;
        made.scene.colors.emplace_back(x, 1.0f - x, 0.5f, 0.4f + 0.5f * x);
    }
}

void lamp(PathScene& made) {
    Material light = emitter({9, 7, 5});
    light.emissiveStrength = 2.0f;
    light.emissiveTexture = {addWaves(made.scene, false)};
    addQuad(made.scene, {-1.5f, 3, -0.5f}, {1, 0, 0}, {0, 0, 1}, addMaterial(made.scene, light));
}

// Panes between ball and lights. The roughness of the second one varies, so it is a pane in part.
void panes(PathScene& made) {
    Material clear;
    clear.metallicFactor = 0.0f;
    clear.roughnessFactor = 0.0f;
    clear.transmissionFactor = 0.9f;
    clear.baseColorFactor = {0.9f, 0.8f, 0.7f, 1.0f};
    addQuad(made.scene, {-2, 2.3f, -1.5f}, {3, 0, 0.2f}, {0, 0.1f, 3}, addMaterial(made.scene, clear));
    Material holed = clear;
    holed.roughnessFactor = 1.0f;
    holed.metallicRoughnessTexture = {
        addTexture(made.scene, 2, {{0, 0, 0, 255}, {0, 0, 0, 255}, {0, 90, 0, 255}, {0, 0, 0, 255}},
                   TextureFilter::nearest)};
    addQuad(made.scene, {1.2f, 0.2f, -1}, {0.1f, 0, 2.5f}, {0, 2, 0}, addMaterial(made.scene, holed));
}

void punctual(PathScene& made) {
    addPointLight(made.scene, {2, 3, 1}, 4.0f);
    PunctualLight spot;
    spot.type = PunctualLight::Type::spot;
    spot.position = {-2, 3, 2};
    spot.direction = glm::normalize(glm::vec3(2, -3, -2));
    spot.intensity = 20.0f;
    spot.outerConeAngle = 0.5f;
    made.scene.lights.push_back(spot);
    PunctualLight sun;
    sun.type = PunctualLight::Type::directional;
    sun.direction = glm::normalize(glm::vec3(1, -2, -1));
    sun.color = {1.0f, 0.8f, 0.6f};
    made.scene.lights.push_back(sun);
}

// Lamps and punctual lights among which the tree of lights chooses.
void manyLights(PathScene& made) {
    lamp(made);
    punctual(made);
    addBall(made.scene, {-1.6f, 1.2f, 1.0f}, 0.2f, addMaterial(made.scene, emitter({6, 3, 2})), false, 8);
    Material sheet = emitter({1, 3, 5});
    sheet.doubleSided = true;
    addQuad(made.scene, {1.5f, 0.4f, -0.5f}, {0.1f, 0.4f, 0}, {0, 0, 0.6f}, addMaterial(made.scene, sheet));
}

void sky(PathScene& made) {
    Sky above = makeSky({.resolution = 32});
    made.surroundings.environment = above.environment;
    made.surroundings.sun = above.sun;
    made.surroundings.rotation = 0.9f;
    made.surroundings.intensity = 2.0f;
}

// Adds a second ball with its own material.
void addNeighbour(PathScene& made, const glm::vec3 center, const std::function<void(Material&)>& change) {
    Material material = metal({0.8f, 0.8f, 0.7f}, 0.3f);
    material.metallicFactor = 0.0f;
    change(material);
    addBall(made.scene, center, 0.4f, addMaterial(made.scene, material), true, 12);
}

PathScene withAlpha(const AlphaMode mode) {
    return ballScene([&](PathScene& made, Material& ball) {
        ball.alphaMode = mode;
        ball.baseColorFactor.a = 0.8f;
        ball.baseColorTexture = {addWaves(made.scene, false)};
        punctual(made);
    });
}

// Returns a closed room that absorbs nothing, so paths have the maximum length.
PathScene whiteRoom() {
    PathScene made;
    addBox(made.scene, {-1, -1, -1}, {1, 1, 1}, addMaterial(made.scene, lambert(glm::vec3(1.0f))),
           Facing::inwards);
    addPointLight(made.scene, {0, 0, 0}, 1e-3f);
    made.view = lookAt({0.5f, 0.5f, 0.5f}, {-1, -1, -0.9f}, {0, 1, 0});
    return made;
}

// A volume around all that the camera is in as well; in it one ball within another, rough and dispersive, and
// one that overlaps both.
PathScene nestedVolumes() {
    return ballScene([](PathScene& made, Material& ball) {
        smoothVolume(ball);
        ball.ior = 1.33f;
        addNeighbour(made, {0.1f, 1.1f, 0.2f}, volume);
        addNeighbour(made, {0.6f, 1.2f, 0.5f}, dispersion);
        addNeighbour(made, {1.2f, 0.6f, 0.9f}, [](Material& m) {
            smoothVolume(m);
            m.ior = 1.0f;
        });
        Material water = glass(1.2f, 0.0f);
        water.attenuationColor = {0.5f, 0.8f, 0.9f};
        water.attenuationDistance = 10.0f;
        addBox(made.scene, {-5, -1, -4}, {5, 6, 6}, addMaterial(made.scene, water));
        punctual(made);
    });
}

// The floor is the catcher.
PathScene withCatcher(PathScene made) {
    made.options.catcher = kFloor;
    return made;
}

} // namespace

PathScene blended() { return withAlpha(AlphaMode::blend); }

PathScene everything() {
    return ballScene([](PathScene& made, Material& ball) {
        textures(made, ball, true);
        normalMap(made, ball);
        ball.clearcoatNormalTexture = {addWaves(made.scene, true), 1};
        for (Texture& texture : made.scene.textures) {
            texture.minFilter = TextureFilter::linearMipmapLinear;
        }
        mipmaps(made, false, TextureFilter::nearestMipmapLinear);
        coat(ball);
        sheen(ball);
        anisotropy(ball);
        ball.anisotropyTexture = {addWaves(made.scene, false)};
        addNeighbour(made, {1.4f, 0.5f, 0.8f}, dispersion);
        addNeighbour(made, {-1.4f, 0.5f, 0.9f}, [](Material& m) {
            iridescence(m);
            specular(m);
            m.alphaMode = AlphaMode::blend;
            m.baseColorFactor.a = 0.6f;
        });
        addNeighbour(made, {0.2f, 0.4f, 1.6f}, [](Material& m) {
            diffuseTransmission(m);
            m.alphaMode = AlphaMode::mask;
            m.alphaCutoff = 0.6f;
        });
        addNeighbour(made, {-1.8f, 1.6f, 0.0f}, [](Material& m) { m.unlit = true; });
        lamp(made);
        punctual(made);
        sky(made);
        made.scene.texCoords1.resize(made.scene.positions.size(), glm::vec2(0.3f));
        colors(made);
    });
}

const std::vector<GpuPathScene>& gpuPathScenes() {
    static const std::vector<GpuPathScene> kScenes = {
        {"plain", [] { return ofMaterial([](Material&) {}); }},
        {"coat", [] { return ofMaterial(coat); }},
        {"sheen", [] { return ofMaterial(sheen); }},
        {"thin_glass", [] { return ofMaterial(thinGlass); }},
        {"volume", [] { return ofMaterial(volume); }},
        {"smooth_volume", [] { return ofMaterial(smoothVolume); }},
        {"nested_volumes",
         nestedVolumes,
         {.samples = 5, .maxBounces = 6, .clampLuminance = 0.5f, .filmParts = kFilmLight}},
        {"iridescence", [] { return ofMaterial(iridescence); }},
        {"diffuse_transmission", [] { return ofMaterial(diffuseTransmission); }},
        {"anisotropy", [] { return ofMaterial(anisotropy); }},
        {"dispersion", [] { return ofMaterial(dispersion); }},
        {"specular", [] { return ofMaterial(specular); }},
        {"unlit", [] { return ofMaterial([](Material& m) { m.unlit = true; }); }},
        {"single_scatter",
         [] { return ballScene([](PathScene& made, Material&) { made.options.isSingleScatter = true; }); }},
        {"vertex_colours", [] { return ballScene([](PathScene& made, Material&) { colors(made); }); }},
        {"textures",
         [] { return ballScene([](PathScene& m, Material& ball) { textures(m, ball, false); }); }},
        {"deep_textures",
         [] { return ballScene([](PathScene& m, Material& ball) { textures(m, ball, true); }); }},
        {"further_sets", [] { return ballScene(furtherSets); }},
        {"texture_chunks",
         [] {
             return ballScene([](PathScene& made, Material& ball) {
                 textures(made, ball, true);
                 made.chunkBytes = 1500; // each chunk has room for one image of 1,152 bytes
             });
         }},
        {"mipmaps",
         [] {
             return ballScene(
                 [](PathScene& made, Material&) { mipmaps(made, false, TextureFilter::linearMipmapLinear); });
         }},
        {"deep_mipmaps",
         [] {
             return ballScene(
                 [](PathScene& made, Material&) { mipmaps(made, true, TextureFilter::linearMipmapNearest); });
         }},
        {"nearest_of_mipmaps",
         [] {
             return ballScene([](PathScene& made, Material&) {
                 mipmaps(made, false, TextureFilter::nearestMipmapLinear, TextureFilter::nearest);
                 made.camera.apertureRadius = 0.1f;
                 made.camera.focusDistance = 4.0f;
             });
         }},
        {"nearest_from_far",
         [] {
             return ballScene([](PathScene& made, Material&) {
                 mipmaps(made, false, TextureFilter::nearest, TextureFilter::linear);
             });
         }},
        {"mipmaps_around",
         [] {
             return ballScene([](PathScene& made, Material& ball) {
                 mipmaps(made, false, TextureFilter::nearestMipmapNearest);
                 ball.metallicFactor = 1.0f;
                 ball.roughnessFactor = 0.0f;
                 made.camera.isPanorama = true;
             });
         }},
        {"mipmaps_in_parallel",
         [] {
             return ballScene([](PathScene& made, Material&) {
                 mipmaps(made, false, TextureFilter::linearMipmapLinear);
                 made.view.projection = SceneCamera::Projection::orthographic;
                 made.view.verticalExtent = 5.0f;
             });
         }},
        {"normal_map", [] { return ballScene(normalMap); }},
        {"mask", [] { return withAlpha(AlphaMode::mask); }},
        {"blend", blended},
        {"lamp", [] { return ballScene([](PathScene& made, Material&) { lamp(made); }); }},
        {"lamp_by_lights",
         [] { return ballScene([](PathScene& made, Material&) { lamp(made); }); },
         {.samples = 5, .seed = 3, .strategies = kSampleLights}},
        {"lamp_by_bsdf",
         [] { return ballScene([](PathScene& made, Material&) { lamp(made); }); },
         {.samples = 5, .seed = 4, .strategies = kSampleBsdf, .clampLuminance = 1.5f}},
        {"punctual", [] { return ballScene([](PathScene& made, Material&) { punctual(made); }); }},
        {"many_points",
         [] {
             return ballScene([](PathScene& made, Material&) {
                 punctual(made);
                 addPointLight(made.scene, {-1, 2, -2}, 3.0f);
             });
         }},
        {"many_lights", [] { return ballScene([](PathScene& made, Material&) { manyLights(made); }); }},
        {"many_lights_by_bsdf",
         [] { return ballScene([](PathScene& made, Material&) { manyLights(made); }); },
         {.samples = 5, .maxBounces = 6, .strategies = kSampleBsdf}},
        {"sky", [] { return ballScene([](PathScene& made, Material&) { sky(made); }); }},
        {"panes",
         [] {
             return ballScene([](PathScene& made, Material&) {
                 panes(made);
                 lamp(made);
                 punctual(made);
                 sky(made);
             });
         },
         {.samples = 5, .maxBounces = 4, .filmParts = kFilmLight}},
        {"panes_over_shadow_catcher",
         [] {
             return withCatcher(ballScene([](PathScene& made, Material& ball) {
                 panes(made);
                 manyLights(made);
                 sky(made);
                 ball.alphaMode = AlphaMode::blend;
                 ball.baseColorFactor.a = 0.6f;
             }));
         },
         {.samples = 5, .maxBounces = 3, .filmParts = kFilmLight}},
        {"lens",
         [] {
             return ballScene([](PathScene& made, Material&) {
                 made.camera.pixelFilter = kFilterBlackmanHarris;
                 made.camera.apertureRadius = 0.2f;
                 made.camera.focusDistance = 4.0f;
             });
         }},
        {"panorama",
         [] {
             return ballScene([](PathScene& made, Material&) {
                 made.camera.pixelFilter = kFilterTent;
                 made.camera.isPanorama = true;
             });
         }},
        {"shadow_catcher",
         [] {
             return withCatcher(ballScene([](PathScene& made, Material&) {
                 lamp(made);
                 sky(made);
             }));
         },
         {.samples = 19, .maxBounces = 3, .filmParts = kFilmLight}},
        {"shadow_catcher_with_reflection",
         [] {
             PathScene made = withCatcher(ballScene([](PathScene& of, Material&) {
                 lamp(of);
                 sky(of);
             }));
             made.options.catcherReflection = 0.2f;
             return made;
         },
         {.samples = 19, .maxBounces = 3, .filmParts = kFilmLight}},
        // Rays from the catcher go on through all of the sheets to the lamp.
        {"shadow_catcher_under_sheets",
         [] {
             return withCatcher(ballScene([](PathScene& made, Material&) {
                 lamp(made);
                 for (int i = 0; i < 60; ++i) {
                     const float height = 2.1f + 0.02f * static_cast<float>(i);
                     addQuad(made.scene, {-1, height, -1}, {0, 0, 2}, {2, 0, 0}, 0u);
                 }
             }));
         },
         {.samples = 2, .maxBounces = 2, .side = 6, .filmParts = kFilmLight}},
        {"everything",
         [] { return withCatcher(everything()); },
         {.samples = 5, .maxBounces = 6, .filmParts = kFilmLight}},
        {"far_away",
         [] {
             PathScene made = blended();
             for (glm::vec3& position : made.scene.positions) {
                 position += 3e4f;
             }
             for (PunctualLight& light : made.scene.lights) {
                 light.position += 3e4f;
             }
             made.view.eye += 3e4f;
             return made;
         }},
        // For 16 samples, the kernel's loop needs more than the 2^16 turns that llvmpipe allows one
        // invocation.
        {"long_paths", whiteRoom, {.samples = 18, .maxBounces = 1000, .side = 4}},
    };
    return kScenes;
}

} // namespace metamarch::tests

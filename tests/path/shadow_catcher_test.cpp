// SPDX-License-Identifier: MIT
// The shadow catcher: its shadow by closed forms and by plain renders of a white ground, and what the camera
// sees of it.
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/reference/path.h"
#include "metamarch/shading/light/sky.h"
#include "metamarch/shading/shadow_catcher.h"
#include "path/path_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace metamarch::tests {
namespace {

constexpr std::uint32_t kSide = 8;

FilmData filmOf(const PathScene& made, const PathWork& work) {
    const AccelerationStructure structure = buildAccelerationStructure(made.scene, {});
    const ShadingScene shading = shadingOf(made);
    const Camera camera = makeCamera(made.view, kSide, kSide, made.camera);
    return renderPathsByJudge(structure, shading, settingsOf(shading, work), camera, work.samples,
                              {.parts = kFilmLight});
}

// Sums over all pixels.
struct Caught {
    glm::dvec3 reached{0.0};
    glm::dvec3 unblocked{0.0};
    glm::dvec3 behind{0.0};
    glm::dvec3 direct{0.0};
    glm::dvec3 indirect{0.0};
    double mirrored = 0.0;
    double mirrorSamples = 0.0;
    double samples = 0.0;

    glm::dvec3 left() const { return reached / unblocked; }
};

Caught caughtBy(const PathScene& made, const PathWork& work) {
    Caught sum;
    for (const LightParts& light : filmOf(made, work).light) {
        sum.reached += glm::dvec3(light.reached);
        sum.unblocked += glm::dvec3(light.unblocked);
        sum.behind += glm::dvec3(light.behind);
        sum.direct += glm::dvec3(light.direct);
        sum.indirect += glm::dvec3(light.indirect);
        sum.mirrored += light.mirrored;
        sum.mirrorSamples += light.mirrorSamples;
        sum.samples += light.caught;
    }
    return sum;
}

void addCatcher(PathScene& made, const CatcherChoice& choice = {CatcherChoice::Kind::plane, 0.0f}) {
    made.options.catcher = placeCatcher(made.scene, choice);
}

// A black square of side 2 at height 1, seen from below it: the camera looks at the ground under its centre.
PathScene underSquare() {
    PathScene made;
    addQuad(made.scene, {-1, 1, -1}, {2, 0, 0}, {0, 0, 2}, addMaterial(made.scene, lambert(glm::vec3(0.0f))));
    made.view = lookAt({0, 0.5f, 0}, {0, 0, 0}, {1, 0, 0});
    made.view.verticalFov = 1e-3f;
    return made;
}

// The form factor from a point to a square of side 2 that is parallel to it, centred, at distance 1. J. R.
// Howell, "A Catalog of Radiation Heat Transfer Configuration Factors", B-3.
const double kHiddenSky = 4.0 / std::numbers::pi * std::sqrt(0.5) * std::atan(std::sqrt(0.5));

// Four standard errors of a mean of 64 * 256 zeros and ones.
constexpr double kNoise = 0.016;
constexpr PathWork kWork{.samples = 256, .maxBounces = 4};

TEST(ShadowCatcher, takesOcclusionInClosedForm) {
    PathScene made = underSquare();
    addCatcher(made);
    made.surroundings.background = {1.0f, 2.0f, 3.0f};
    const Caught caught = caughtBy(made, kWork);
    EXPECT_EQ(caught.samples, kSide * kSide * kWork.samples);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(caught.unblocked[c], caught.samples * (c + 1), 1e-4 * caught.samples);
        EXPECT_NEAR(caught.left()[c], 1.0 - kHiddenSky, kNoise);
        EXPECT_NEAR(caught.behind[c], caught.samples * (c + 1), 1e-4 * caught.samples);
    }
}

// A red light from straight above is hidden, and the white sky is in part: the shadow has a colour.
TEST(ShadowCatcher, takesShadowOfEachColour) {
    PathScene made = underSquare();
    addCatcher(made);
    made.surroundings.background = glm::vec3(0.5f);
    PunctualLight light;
    light.type = PunctualLight::Type::directional;
    light.direction = {0, -1, 0};
    light.color = {1, 0, 0};
    light.intensity = 2.0f * std::numbers::pi_v<float>; // a white surface reflects a radiance of 2
    made.scene.lights.push_back(light);
    const glm::dvec3 left = caughtBy(made, kWork).left();
    EXPECT_NEAR(left.r, 0.5 * (1.0 - kHiddenSky) / 2.5, kNoise);
    EXPECT_NEAR(left.b, 1.0 - kHiddenSky, kNoise);
}

// A square lamp that hides the sky as underSquare() does, and does not reflect, if it is not white.
void addSquareLamp(Scene& scene, const float height, Material lamp) {
    lamp.emissiveFactor = glm::vec3(3.0f);
    addQuad(scene, {-height, height, -height}, {2 * height, 0, 0}, {0, 0, 2 * height},
            addMaterial(scene, lamp));
}

// The body of a lamp is there with and without the objects, so it takes no light from the ground. Behind a
// black square it is what is missing, and not the sky that it hides.
TEST(ShadowCatcher, lampsAreNoObjects) {
    PathScene made = underSquare();
    addSquareLamp(made.scene, 2.0f, lambert(glm::vec3(0.0f)));
    addCatcher(made);
    made.surroundings.background = glm::vec3(2.0f);
    const Caught caught = caughtBy(made, kWork);
    const double sky = 2.0 * (1.0 - kHiddenSky);
    EXPECT_NEAR(caught.reached.g / caught.samples, sky, 2.0 * kNoise);
    EXPECT_NEAR(caught.unblocked.g / caught.samples, sky + 3.0 * kHiddenSky, 3.0 * kNoise);
}

// Expects that no pixel of a square of the ground below 0.9 has any shadow. Returns the mean green that
// reaches it.
double lightWithoutShadow(PathScene& made) {
    made.view = lookAt({0, 0.9f, 0}, {0, 0, 0}, {1, 0, 0});
    made.view.verticalFov = 1.0f;
    constexpr std::uint32_t kSamples = 8;
    double reached = 0.0;
    for (const LightParts& light : filmOf(made, {.samples = kSamples}).light) {
        EXPECT_EQ(light.caught, static_cast<float>(kSamples));
        EXPECT_EQ(light.reached, light.unblocked);
        reached += static_cast<double>(light.reached.g);
    }
    return reached / (kSide * kSide * kSamples);
}

// Nothing else than a lamp, which also reflects, and which hides one light: no sample has any shadow.
TEST(ShadowCatcher, groundWithoutObjectsIsTransparent) {
    PathScene made;
    addSquareLamp(made.scene, 1.0f, lambert(glm::vec3(0.8f)));
    addCatcher(made);
    addPointLight(made.scene, {0.1f, 3.0f, 0.0f}, 50.0f);
    addPointLight(made.scene, {4.0f, 3.0f, 0.0f}, 50.0f);
    made.surroundings.background = glm::vec3(0.5f);
    EXPECT_GT(lightWithoutShadow(made), 0.5);
}

// Two lamps that light each other: what one reflects of the other reaches the ground with and without
// objects.
TEST(ShadowCatcher, lampsLightEachOther) {
    PathScene made;
    addSquareLamp(made.scene, 1.0f, lambert(glm::vec3(0.8f)));
    Material lamp = lambert(glm::vec3(0.8f));
    lamp.emissiveFactor = glm::vec3(3.0f);
    addQuad(made.scene, {1.0f, 0.2f, -1.0f}, {0, 0, 2}, {0, 0.8f, 0}, addMaterial(made.scene, lamp));
    addCatcher(made);
    EXPECT_GT(lightWithoutShadow(made), 0.0);
}

// The dark half of an emissive texture is an object, and so is an unlit surface.
TEST(ShadowCatcher, whatHardlyShinesIsAnObject) {
    PathScene made;
    Material half = lambert(glm::vec3(0.0f));
    half.emissiveTexture.texture =
        addTexture(made.scene, 2, {glm::u8vec4(255), glm::u8vec4(9, 9, 9, 255)}, TextureFilter::nearest);
    addSquareLamp(made.scene, 1.0f, half);
    PathScene card = underSquare();
    card.scene.materials[0] = unlit(glm::vec3(0.25f));
    made.view = card.view;
    for (PathScene* const scene : {&made, &card}) {
        scene->surroundings.background = glm::vec3(1.0f);
        addCatcher(*scene);
    }
    const Caught caught = caughtBy(made, kWork);
    const double shining = 3.0 * kHiddenSky / 2.0;
    EXPECT_NEAR(caught.reached.g / caught.samples, shining + 1.0 - kHiddenSky, 2.0 * kNoise);
    EXPECT_NEAR(caught.unblocked.g / caught.samples, shining + 1.0 - kHiddenSky / 2.0, 2.0 * kNoise);
    const Caught ofCard = caughtBy(card, kWork);
    EXPECT_NEAR(ofCard.reached.g / ofCard.samples, 1.0 - 0.75 * kHiddenSky, kNoise);
    EXPECT_NEAR(ofCard.unblocked.g / ofCard.samples, 1.0, 1e-4);
}

// A lamp, a sun and a map: everything that light sampling and BSDF sampling find together.
PathScene litByAll(const bool hasObject) {
    PathScene made;
    if (hasObject) {
        addBox(made.scene, {-0.5f, 0.0f, -0.5f}, {0.5f, 1.0f, 0.5f},
               addMaterial(made.scene, lambert(glm::vec3(0.9f, 0.5f, 0.2f))));
    }
    addQuad(made.scene, {-2.0f, 1.5f, -0.7f}, {0.3f, 0.6f, 0}, {0, 0, 1},
            addMaterial(made.scene, emitter({40, 60, 90})));
    Sky above = makeSky({.resolution = 32});
    made.surroundings.environment = above.environment;
    made.surroundings.sun = above.sun;
    made.surroundings.intensity = 3.0f;
    addPointLight(made.scene, {1.5f, 2.0f, 1.0f}, 2.0f);
    made.view = lookAt({0.9f, 3.0f, 0.4f}, {0.8f, 0.0f, 0.3f}, {0, 0, 1});
    made.view.verticalFov = 0.15f;
    return made;
}

// Returns the sum of the radiance of a white ground in a plain render, over all samples.
glm::dvec3 whiteGround(PathScene made, const PathWork& work) {
    addQuad(made.scene, {-60, 0, -60}, {0, 0, 120}, {120, 0, 0},
            addMaterial(made.scene, lambert(glm::vec3(1.0f))));
    glm::dvec3 sum(0.0);
    for (const FilmPixel& pixel : filmOf(made, work).pixels) {
        sum += glm::dvec3(pixel.radiance);
    }
    return sum;
}

// The ratio is that of two plain renders of a white ground. The light is direct, so that it does not matter
// that the ground is white only to the camera.
TEST(ShadowCatcher, agreesWithPlainRenders) {
    const PathWork work{.samples = 512, .maxBounces = 0};
    PathScene made = litByAll(true);
    addCatcher(made);
    const Caught caught = caughtBy(made, work);
    ASSERT_EQ(caught.samples, kSide * kSide * work.samples);
    const glm::dvec3 with = whiteGround(litByAll(true), work);
    const glm::dvec3 without = whiteGround(litByAll(false), work);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(caught.reached[c] / with[c], 1.0, 0.02);
        EXPECT_NEAR(caught.unblocked[c] / without[c], 1.0, 0.02);
        EXPECT_LT(with[c], 0.8 * without[c]);
    }
}

// Light that objects reflect reaches the ground too: under a white square, of light from below.
TEST(ShadowCatcher, takesLightFromObjects) {
    PathScene made = litByAll(true);
    addCatcher(made);
    const double direct = caughtBy(made, {.samples = 64, .maxBounces = 0}).left().r;
    EXPECT_GT(caughtBy(made, {.samples = 64, .maxBounces = 4}).left().r, 1.02 * direct);
}

// Everything else of the material is part of the catcher too.
PathScene paperFloor() {
    PathScene made;
    made.scene.materials.push_back(lambert(glm::vec3(0.3f)));
    made.scene.materials.back().name = "paper";
    addQuad(made.scene, {-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, 0);
    return made;
}

// A corner of two walls without objects. What is laid under it has the shadow of one wall on the other.
TEST(ShadowCatcher, doesNotShadowItself) {
    PathScene made = paperFloor();
    addQuad(made.scene, {-1, 0, -1}, {2, 0, 0}, {0, 2, 0}, 0);
    addCatcher(made, {CatcherChoice::Kind::material, 0.0f, "paper"});
    made.surroundings.background = glm::vec3(0.7f);
    made.view = lookAt({0.5f, 1.0f, 2.0f}, {0, 0.1f, -1}, {0, 1, 0});
    made.view.verticalFov = 0.3f;
    const Caught caught = caughtBy(made, {.samples = 16});
    ASSERT_EQ(caught.samples, kSide * kSide * 16);
    EXPECT_EQ(caught.reached, caught.unblocked);
}

// Every shadow ray to the light, which is below a table, passes the table.
TEST(ShadowCatcher, doesNotShadowItselfFromLights) {
    PathScene made = paperFloor();
    addQuad(made.scene, {-1, 1, -1}, {0, 0, 2}, {2, 0, 0}, 0);
    addCatcher(made, {CatcherChoice::Kind::material, 0.0f, "paper"});
    addPointLight(made.scene, {0, 2, 0}, std::numbers::pi_v<float>);
    made.view = lookAt({0, 0.5f, 0}, {0, 0, 0}, {1, 0, 0});
    made.view.verticalFov = 1e-3f;
    const Caught caught = caughtBy(made, {.samples = 16, .maxBounces = 0});
    EXPECT_NEAR(caught.reached.g / caught.samples, 0.25, 1e-4); // albedo 1, light at distance 2
    EXPECT_EQ(caught.reached, caught.unblocked);
}

// The camera sees objects as a plain render of the same surfaces shows them, because only its own rays know a
// catcher. What it sees of the catcher is a miss.
TEST(ShadowCatcher, changesNothingElse) {
    PathScene made = litByAll(true);
    made.view = lookAt({1, 2, 3}, {0, 0.5f, 0}, {0, 1, 0});
    addCatcher(made);
    const FilmData film = filmOf(made, {.samples = 4});
    made.options.catcher = kNoMaterial;
    const FilmData plain = filmOf(made, {.samples = 4});
    int objects = 0;
    int misses = 0;
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        const FilmPixel& pixel = film.pixels[i];
        if (film.light[i].caught == 0.0f) {
            ++objects;
            EXPECT_EQ(pixel.radiance, plain.pixels[i].radiance);
            EXPECT_EQ(pixel.seen.triangleId, plain.pixels[i].seen.triangleId);
        } else if (film.light[i].caught == 4.0f) {
            ++misses;
            EXPECT_EQ(pixel.radiance, glm::vec3(0.0f));
            EXPECT_EQ(pixel.seen.triangleId, kNoTriangle);
            EXPECT_EQ(pixel.covered, 0.0f);
            EXPECT_EQ(pixel.seen.albedo, glm::vec3(0.0f));
        }
    }
    EXPECT_GT(objects, 5);
    EXPECT_GT(misses, 5);
}

// A card that shines, of which the camera sees the mirror image alone, 45 degrees below it.
PathScene overMirror(const float roughness) {
    PathScene made;
    addQuad(made.scene, {5, -90, -90}, {0, 0, 180}, {0, 180, 0},
            addMaterial(made.scene, unlit({0.5f, 1, 2})));
    addCatcher(made);
    made.options.catcherReflection = roughness;
    made.view = lookAt({-1, 1, 0}, {0, 0, 0}, {0, 1, 0});
    made.view.verticalFov = 1e-3f;
    return made;
}

// Schlick's approximation for the refractive index 1.5, as in glTF 2.0, Appendix B.
double reflectance(const double cosine) { return 0.04 + 0.96 * std::pow(1.0 - cosine, 5.0); }

TEST(ShadowCatcher, mirrorsObjectsInClosedForm) {
    PathScene made = overMirror(0.0f);
    made.surroundings.background = glm::vec3(7.0f);
    for (const std::uint32_t maxBounces : {0u, 4u}) {
        const Caught caught = caughtBy(made, {.samples = 256, .maxBounces = maxBounces});
        const double part = reflectance(std::sqrt(0.5)) * caught.samples;
        EXPECT_EQ(caught.samples, kSide * kSide * 256);
        EXPECT_EQ(caught.mirrorSamples,
                  caught.samples / 2); // each aligned pair of samples has one in the mirror
        EXPECT_NEAR(caught.mirrored, part / 2, 1e-3 * part);
        EXPECT_NEAR(caught.direct.r, 0.5 * part, 1e-3 * part);
        EXPECT_NEAR(caught.direct.b, 2.0 * part, 2e-3 * part);
        EXPECT_EQ(caught.indirect, glm::dvec3(0.0));
        EXPECT_NEAR(caught.unblocked.g, 3.5 * caught.samples, 1e-3 * caught.samples); // by the other half
    }
}

// What is all around is seen through the ground, and not in it.
TEST(ShadowCatcher, mirrorsNoSky) {
    PathScene made = overMirror(0.4f);
    made.scene.triangles.erase(made.scene.triangles.begin(), made.scene.triangles.begin() + 2);
    for (std::vector<std::uint32_t>* const of : {&made.scene.triangleMesh, &made.scene.triangleMaterial}) {
        of->erase(of->begin(), of->begin() + 2);
    }
    made.surroundings.background = glm::vec3(7.0f);
    Sky above = makeSky({.resolution = 32});
    made.surroundings.sun = above.sun;
    const Caught caught = caughtBy(made, {.samples = 64});
    EXPECT_EQ(caught.mirrored, 0.0);
    EXPECT_EQ(caught.direct + caught.indirect, glm::dvec3(0.0));
    EXPECT_EQ(caught.reached, caught.unblocked);
}

// A box and a lamp in a rough mirror, as a plain render of a polished black ground shows them.
TEST(ShadowCatcher, mirrorsAsPlainRendersDo) {
    PathScene made;
    addBox(made.scene, {-0.6f, 0.02f, -1.0f}, {0.4f, 1.0f, 0.0f},
           addMaterial(made.scene, lambert(glm::vec3(0.9f, 0.5f, 0.2f))));
    addQuad(made.scene, {-2.0f, 0.2f, -1.5f}, {1, 0, 0}, {0, 1, 0},
            addMaterial(made.scene, emitter({4, 6, 9})));
    Material ground = lambert(glm::vec3(0.0f));
    ground.specularFactor = 1.0f;
    ground.roughnessFactor = 0.3f;
    addQuad(made.scene, {-60, 0, -60}, {0, 0, 120}, {120, 0, 0}, addMaterial(made.scene, ground));
    made.view = lookAt({-0.75f, 1.0f, 3.0f}, {-0.75f, 0.0f, 0.6f}, {0, 1, 0});
    made.view.verticalFov = 0.15f;
    glm::dvec3 plain(0.0);
    for (const FilmPixel& pixel : filmOf(made, {.samples = 1024, .maxBounces = 2}).pixels) {
        plain += glm::dvec3(pixel.radiance);
    }
    made.options.catcher = static_cast<std::uint32_t>(made.scene.materials.size() - 1);
    made.options.catcherReflection = 0.3f;
    const FilmData film = filmOf(made, {.samples = 1024, .maxBounces = 1}); // and one that the mirror gives
    glm::dvec3 mirrored(0.0);
    glm::dvec3 light(0.0);
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        mirrored += glm::dvec3(film.pixels[i].radiance);
        light += glm::dvec3(film.light[i].emission + film.light[i].direct + film.light[i].indirect);
        EXPECT_EQ(film.light[i].caught, 1024.0f);
    }
    for (int c = 0; c < 3; ++c) {
        EXPECT_GT(plain[c], 0.0);
        EXPECT_NEAR(mirrored[c] / plain[c], 1.0, 0.02);
        EXPECT_NEAR(light[c] / mirrored[c], 1.0, 1e-5);
    }
}

// The lowest plane is not in the place of a flat underside, near the origin and far from it, and is so near
// that the ground beside a black wall sees half of the sky.
TEST(ShadowCatcher, lowestPlaneTouchesFlatUndersides) {
    for (const float height : {0.0f, -2.0f, 3e4f}) {
        PathScene made;
        addQuad(made.scene, {-1, height, -1}, {0, 0, 2}, {2, 0, 0},
                addMaterial(made.scene, lambert(glm::vec3(0.5f))));
        addCatcher(made, {CatcherChoice::Kind::lowest});
        made.view = lookAt({0.3f, height + 3.0f, 0.4f}, {0, height, 0}, {1, 0, 0});
        made.view.verticalFov = 0.4f;
        EXPECT_EQ(caughtBy(made, {.samples = 4, .maxBounces = 0}).samples, 0.0);
    }
    PathScene made;
    addBox(made.scene, {-1, 0, -1}, {1, 2, 1}, addMaterial(made.scene, lambert(glm::vec3(0.0f))));
    addCatcher(made, {CatcherChoice::Kind::lowest});
    made.surroundings.background = glm::vec3(1.0f);
    made.view = lookAt({1.02f, 1.0f, 0}, {1.02f, 0, 0}, {1, 0, 0});
    made.view.verticalFov = 1e-3f;
    const Caught caught = caughtBy(made, kWork);
    EXPECT_EQ(caught.samples, kSide * kSide * kWork.samples);
    EXPECT_NEAR(caught.left().g, 0.5 * (1.0 + 0.02 / std::hypot(0.02, 1.0)), kNoise);
}

TEST(ShadowCatcher, planeLiesUnderTheScene) {
    PathScene made;
    addBox(made.scene, {1, -2, 3}, {2, 5, 4}, addMaterial(made.scene, lambert(glm::vec3(0.5f))));
    Scene scene = made.scene;
    const std::uint32_t material = placeCatcher(scene, {CatcherChoice::Kind::lowest});
    EXPECT_EQ(material, scene.materials.size() - 1);
    ASSERT_EQ(scene.triangles.size(), made.scene.triangles.size() + 2);
    EXPECT_EQ(scene.triangleMaterial.back(), material);
    EXPECT_EQ(scene.triangleMesh.back(), scene.meshes.size() - 1);
    EXPECT_EQ(scene.positions.size(), scene.normals.size());
    const Bounds bounds = boundsOf(scene);
    const float height = -2.0f - 7.0f * 2.5e-4f - 2e-6f;
    const float reach = 20.0f * (5.0f - height);
    EXPECT_NEAR(bounds.lo.y, height, 1e-6f);
    for (const int axis : {0, 2}) {
        EXPECT_NEAR(bounds.lo[axis], made.scene.positions[0][axis] - reach, 1.01f);
        EXPECT_NEAR(bounds.hi[axis] - bounds.lo[axis], 1.0f + 2.0f * reach, 1e-4f);
    }
    EXPECT_EQ(bounds.hi.y, 5.0f);
    for (std::size_t i = scene.triangles.size() - 2; i < scene.triangles.size(); ++i) {
        const glm::uvec3 corners = scene.triangles[i];
        const glm::vec3 a = scene.positions[corners.x];
        EXPECT_EQ(a.y, bounds.lo.y);
        EXPECT_GT(glm::cross(scene.positions[corners.y] - a, scene.positions[corners.z] - a).y, 0.0f);
    }

    Scene empty;
    placeCatcher(empty, {CatcherChoice::Kind::plane, 3.0f});
    EXPECT_EQ(boundsOf(empty).lo.y, 3.0f);
    EXPECT_EQ(empty.triangles.size(), 2u);
}

} // namespace
} // namespace metamarch::tests

// SPDX-License-Identifier: MIT
// Mip levels: the choice of the level, the filters of glTF, and the effect on noise.
#include "metamarch/shared/path.h"
#include "path/path_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace metamarch::tests {
namespace {

const glm::u8vec4 kDark(30, 30, 30, 255);
const glm::u8vec4 kBright(230, 230, 230, 255);

std::vector<glm::u8vec4> checkerboard(const std::uint32_t side, const std::uint32_t square) {
    std::vector<glm::u8vec4> texels;
    for (std::uint32_t i = 0; i < side * side; ++i) {
        const bool isBright = ((i % side / square) + (i / side / square)) % 2 == 1;
        texels.push_back(isBright ? kBright : kDark);
    }
    return texels;
}

std::uint32_t addFiltered(Scene& scene, const std::uint32_t width, const std::vector<glm::u8vec4>& texels,
                          const TextureFilter mag, const TextureFilter min) {
    const std::uint32_t texture = addTexture(scene, width, texels, mag);
    scene.textures[texture].minFilter = min;
    return texture;
}

// --- choice of the level

constexpr float kSide = 8.0f;
constexpr std::uint32_t kTexels = 64;

// Returns a square with sides of length kSide and kTexels texels per side. Its front faces +z.
PathScene square() {
    PathScene made;
    Material paint = unlit({1, 1, 1});
    paint.baseColorTexture = {addFiltered(made.scene, kTexels, checkerboard(kTexels, 8),
                                          TextureFilter::linear, TextureFilter::linearMipmapLinear)};
    addQuad(made.scene, {-4, -4, 0}, {kSide, 0, 0}, {0, kSide, 0}, addMaterial(made.scene, paint));
    return made;
}

// Returns log2 of the side, in texels, of the footprint of pixel (x, y) of a 60 x 40 picture on the square.
float texelsSeen(const PathScene& made, const std::uint32_t x, const std::uint32_t y,
                 const std::uint32_t sample) {
    const ShadingScene shading = shadingOf(made);
    const Camera camera = makeCamera(made.view, 60, 40, made.camera);
    const CameraRay view = cameraRay(camera, x, y);
    const float t = -view.origin.z / view.dir.z;
    const Scene& scene = made.scene;
    const glm::uvec3 corners = scene.triangles[0];
    const TriangleRecord triangle{scene.positions[corners.x], 0, scene.positions[corners.y], 0,
                                  scene.positions[corners.z], 0};
    const float width = widthAt(cameraCone(camera, view.dir), t);
    const TexturePoint at = texturePoint(shading, shading.surfaces[0], {1, 0, 0},
                                         seenPart(triangle, view.dir, width, sample), 0.0f);
    return at.firstLevel + shading.textures[0].use.unitLevel;
}

// On a plane that is seen at a right angle from distance d, a pixel is 2 d tan(fov / 2) / 40 wide, even at
// the side.
TEST(PathMipmap, levelOfAPlaneFollowsFromItsDistance) {
    PathScene made = square();
    for (const float distance : {5.0f, 20.0f, 333.0f}) {
        made.view = lookAt({0, 0, distance}, {0, 0, 0}, {0, 1, 0});
        made.view.verticalFov = 0.7f;
        const double pixel = 2.0 * distance * std::tan(0.35) / 40.0;
        const double exact = std::log2(pixel * kTexels / kSide);
        EXPECT_NEAR(texelsSeen(made, 30, 20, 0), exact, 2e-3); // half a pixel beside the centre
        EXPECT_NEAR(texelsSeen(made, 0, 0, 0), exact, 2e-3);
        EXPECT_NEAR(texelsSeen(made, 30, 20, 15), exact - 3.0, 2e-3);
    }
}

TEST(PathMipmap, levelInAParallelViewIsTheSameEverywhere) {
    PathScene made = square();
    made.view = lookAt({0, 0, 9}, {0, 0, 0}, {0, 1, 0});
    made.view.projection = SceneCamera::Projection::orthographic;
    made.view.verticalExtent = 80.0f;
    EXPECT_NEAR(texelsSeen(made, 3, 5, 0), 4.0f, 1e-5f);
    EXPECT_NEAR(texelsSeen(made, 50, 30, 0), 4.0f, 1e-5f);
}

// At 45 degrees, a pixel's area is twice that at the foot of the perpendicular because of the distance, and
// larger by sqrt(2) because of the tilt: on a floor the area grows with the third power of the distance.
TEST(PathMipmap, levelOfALeaningPlaneFollowsFromItsArea) {
    PathScene made = square();
    made.view = lookAt({0, -10, 10}, {0, 0, 0}, {0, 1, 0});
    made.view.verticalFov = 0.02f;
    const double pixel = 2.0 * std::sqrt(200.0) * std::tan(0.01) / 40.0;
    const double exact = std::log2(pixel * kTexels / kSide) + 0.25; // the root of the root of two
    EXPECT_NEAR(texelsSeen(made, 30, 20, 0), exact, 2e-3);
}

TEST(PathMipmap, whatHasNoAreaInTheTextureIsSeenInFullSize) {
    PathScene made = square();
    made.view = lookAt({0, 0, 100}, {0, 0, 0}, {0, 1, 0});
    for (glm::vec2& place : made.scene.texCoords) {
        place.y = 0.5f;
    }
    EXPECT_LT(texelsSeen(made, 30, 20, 0), -20.0f);
}

// --- filters of glTF

// A row of four greys. Level 1 has 0.1 and 0.9, level 2 the mean 0.5.
const std::vector<glm::u8vec4> kGreys = {glm::u8vec4(0), glm::u8vec4(51), glm::u8vec4(204), glm::u8vec4(255)};

struct Seen {
    TextureFilter mag;
    TextureFilter min;
    float level; // log2 of the footprint's side in texels
    float u;
    float expected; // at a quarter of the width: the left edge of texel 1
};

constexpr TextureFilter kNearest = TextureFilter::nearest;
constexpr TextureFilter kLinear = TextureFilter::linear;

TEST(PathMipmap, hasEveryFilterOfGltf) {
    constexpr float kByte = 1.0f / 255.0f; // bytes cannot represent 0.1 and 0.5 exactly
    const Seen cases[] = {
        // The texture is magnified.
        {kNearest, TextureFilter::linearMipmapLinear, -0.1f, 0.99f, 0.2f},
        {kLinear, TextureFilter::nearestMipmapLinear, -0.1f, 0.99f, 0.1f},
        {kLinear, kNearest, 0.0f, 0.5f, 0.1f},
        // The filter uses no levels.
        {kLinear, kNearest, 5.0f, 0.5f, 0.2f},
        {kNearest, kLinear, 5.0f, 0.5f, 0.1f},
        // The filter uses the nearest level, whatever u is.
        {kLinear, TextureFilter::nearestMipmapNearest, 0.4f, 0.9f, 0.2f},
        {kLinear, TextureFilter::nearestMipmapNearest, 0.6f, 0.0f, 0.1f},
        {kLinear, TextureFilter::nearestMipmapNearest, 1.6f, 0.0f, 0.5f},
        {kNearest, TextureFilter::linearMipmapNearest, 0.4f, 0.9f, 0.1f},
        {kNearest, TextureFilter::linearMipmapNearest, 1.4f, 0.9f, 0.1f},
        // The filter uses one of two levels at random.
        {kLinear, TextureFilter::nearestMipmapLinear, 0.25f, 0.7f, 0.2f},
        {kLinear, TextureFilter::nearestMipmapLinear, 0.25f, 0.8f, 0.1f},
        {kNearest, TextureFilter::linearMipmapLinear, 1.25f, 0.7f, 0.1f},
        {kNearest, TextureFilter::linearMipmapLinear, 1.25f, 0.8f, 0.5f},
        // The footprint is larger than the last level's texel.
        {kLinear, TextureFilter::linearMipmapLinear, 40.0f, 0.5f, 0.5f},
    };
    for (const Seen& seen : cases) {
        PathScene made;
        Material paint = lambert({1, 1, 1});
        paint.baseColorTexture = {addFiltered(made.scene, 4, kGreys, seen.mag, seen.min)};
        made.scene.textures[0].wrapS = TextureWrap::clampToEdge;
        addMaterial(made.scene, paint);
        const ShadingScene shading = shadingOf(made);
        const float level = seen.level - shading.textures[0].use.unitLevel;
        TexturePoint at{};
        at.first = {0.25f, 0.5f};
        at.firstLevel = level;
        at.uLevel = seen.u;
        EXPECT_NEAR(lookUp(shading, 0, at).x, seen.expected, kByte)
            << "mag " << static_cast<int>(seen.mag) << ", min " << static_cast<int>(seen.min) << ", level "
            << seen.level << ", u " << seen.u;
    }
}

// A texture transform of a file can make coordinates infinite or NaN. They must not leave the texels.
TEST(PathMipmap, coordinatesThatAreNoNumbersLookUpTheFirstTexel) {
    constexpr float kInfinite = std::numeric_limits<float>::infinity();
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    for (const TextureWrap wrap :
         {TextureWrap::repeat, TextureWrap::mirroredRepeat, TextureWrap::clampToEdge}) {
        PathScene made;
        Material paint = lambert({1, 1, 1});
        paint.baseColorTexture = {
            addFiltered(made.scene, 4, kGreys, kNearest, TextureFilter::nearestMipmapLinear)};
        made.scene.textures[0].wrapS = wrap;
        made.scene.textures[0].wrapT = wrap;
        addMaterial(made.scene, paint);
        const ShadingScene shading = shadingOf(made);
        const auto seen = [&](const float u, const float v, const float level) {
            TexturePoint at{};
            at.first = {u, v};
            at.firstLevel = level;
            return lookUp(shading, 0, at);
        };
        const float first = seen(0.0f, 0.0f, kFinestLevel).x;
        for (const float odd : {kInfinite, -kInfinite, kNaN, 3e38f, -3e38f}) {
            EXPECT_EQ(seen(odd, odd, kFinestLevel).x, first) << odd << ", wrap " << static_cast<int>(wrap);
        }
        EXPECT_EQ(seen(0.0f, 0.0f, kNaN).x, first);
    }
}

// The mean of the randomly chosen levels is the blend of the two.
TEST(PathMipmap, chanceMixesTwoLevels) {
    const std::uint32_t flags = kTextureBetweenLevels | 9u << kTextureLastLevelShift;
    for (const float texels : {0.0f, 0.3f, 2.75f, 8.5f, 11.0f}) {
        constexpr std::uint32_t kDraws = 1000;
        double sum = 0.0;
        for (std::uint32_t i = 0; i < kDraws; ++i) {
            sum += chosenLevel(flags, texels, (static_cast<float>(i) + 0.5f) / kDraws);
        }
        EXPECT_NEAR(sum / kDraws, std::min(texels, 9.0f), 1e-3);
    }
}

// --- pictures

// Returns a floor with a checkerboard that extends to the horizon.
PathScene horizon(const TextureFilter min) {
    PathScene made;
    Material paint = unlit({1, 1, 1});
    paint.baseColorTexture = {addFiltered(made.scene, 32, checkerboard(32, 8), kLinear, min), 0, true};
    paint.baseColorTexture.transform = glm::mat3x2(2000.0f, 0.0f, 0.0f, 2000.0f, 0.0f, 0.0f);
    addQuad(made.scene, {-400, 0, 400}, {800, 0, 0}, {0, 0, -800}, addMaterial(made.scene, paint));
    made.view = lookAt({0.3f, 1.0f, 0.2f}, {0.0f, 0.9f, -2.0f}, {0, 1, 0});
    made.view.verticalFov = 0.09f; // begins one degree below the horizon, so the picture shows only floor
    made.view.forward = glm::normalize(glm::vec3(0.0f, -0.06f, -1.0f));
    return made;
}

double meanSquareError(const std::vector<FilmPixel>& film, const std::vector<FilmPixel>& exact) {
    double sum = 0.0;
    for (std::size_t i = 0; i < film.size(); ++i) {
        sum += std::pow(meanOf(film[i]).g - meanOf(exact[i]).g, 2.0);
    }
    return sum / static_cast<double>(film.size());
}

// Levels reduce the noise, with one sample and with many, and the picture converges to the one without
// levels. Levels that are too coarse would leave an error that samples cannot remove.
TEST(PathMipmap, checkerboardToTheHorizonHasLessNoiseAndTheSameMean) {
    PathWork work{.samples = 4096, .side = 32};
    const std::vector<FilmPixel> exact = render(horizon(kLinear), work);
    struct Bound {
        std::uint32_t samples;
        double left; // fraction of the error that remains; measured: 0.05, 0.17, 0.35 and 0.55
    };
    for (const auto [samples, left] : {Bound{1, 0.1}, {4, 0.3}, {16, 0.5}, {64, 0.75}}) {
        work.samples = samples;
        work.seed = 1;
        const std::vector<FilmPixel> plain = render(horizon(kLinear), work);
        const std::vector<FilmPixel> smooth = render(horizon(TextureFilter::linearMipmapLinear), work);
        const double plainError = meanSquareError(plain, exact);
        EXPECT_LT(meanSquareError(smooth, exact), left * plainError) << samples;
        // The bound covers the noise of the mean, and the rounding of the levels to bytes, in linear light.
        const double bound = 3.0 * std::sqrt(plainError) / work.side + 0.004;
        EXPECT_NEAR(meanOf(smooth).g, meanOf(exact).g, bound) << samples;
    }
}

TEST(PathMipmap, constantTexturesStayConstant) {
    PathScene made = horizon(TextureFilter::linearMipmapLinear);
    made.scene.images[0].bytes.assign(std::size_t{32} * 32, glm::u8vec4(77, 130, 200, 255));
    PathScene plain = made;
    plain.scene.textures[0].minFilter = kLinear;
    const PathWork work{.samples = 2};
    const std::vector<FilmPixel> film = render(made, work);
    const std::vector<FilmPixel> expected = render(plain, work);
    for (std::size_t i = 0; i < film.size(); ++i) {
        ASSERT_NEAR(film[i].radiance.r, expected[i].radiance.r, 1e-6f);
        ASSERT_NEAR(film[i].radiance.b, expected[i].radiance.b, 1e-6f);
    }
}

// Returns a floor with a texture of leaves: opaque texels are green, transparent ones magenta.
PathScene leaves(const AlphaMode mode, const TextureFilter min) {
    PathScene made = horizon(min);
    for (std::uint32_t i = 0; i < 32 * 32; ++i) {
        const bool isLeaf = made.scene.images[0].bytes[i] == kBright;
        made.scene.images[0].bytes[i] = isLeaf ? glm::u8vec4(0, 255, 0, 255) : glm::u8vec4(255, 0, 255, 0);
    }
    made.scene.textures[0].magFilter = kNearest;
    made.scene.materials[0].alphaMode = mode;
    return made;
}

// Alpha is looked up in the full-size level, so levels do not change which parts are opaque, only their
// colour.
TEST(PathMipmap, levelsKeepHolesAndTheirColours) {
    for (const AlphaMode mode : {AlphaMode::mask, AlphaMode::blend}) {
        const PathWork work{.samples = 4};
        const std::vector<FilmPixel> film = render(leaves(mode, TextureFilter::linearMipmapLinear), work);
        const std::vector<FilmPixel> expected = render(leaves(mode, kNearest), work);
        double covered = 0.0;
        for (std::size_t i = 0; i < film.size(); ++i) {
            ASSERT_EQ(film[i].covered, expected[i].covered);
            covered += film[i].covered;
            ASSERT_EQ(film[i].radiance.r, 0.0f);
            ASSERT_NEAR(film[i].radiance.g, film[i].covered, 1e-5f);
        }
        EXPECT_NEAR(covered / static_cast<double>(4 * film.size()), 0.5, 0.05);
    }
}

// A rough mirror widens the cone, so that the texture is averaged over its lobe: less noise, the same mean.
TEST(PathMipmap, conesWidenOnRoughSurfaces) {
    const auto mirrored = [](const TextureFilter min, const PathWork& work) {
        PathScene made = horizon(min);
        addQuad(made.scene, {-400, 3, -400}, {800, 0, 0}, {0, 0, 800},
                addMaterial(made.scene, metal({1, 1, 1}, 0.6f)));
        made.view.forward = glm::normalize(glm::vec3(0.0f, 0.7f, -1.0f));
        return render(made, work);
    };
    const PathWork work{.samples = 16, .maxBounces = 1, .side = 32};
    const std::vector<FilmPixel> plain = mirrored(kLinear, work);
    const std::vector<FilmPixel> smooth = mirrored(TextureFilter::linearMipmapLinear, work);
    double plainSquares = 0.0;
    double smoothSquares = 0.0;
    for (std::size_t i = 0; i < plain.size(); ++i) {
        plainSquares += plain[i].squares.g;
        smoothSquares += smooth[i].squares.g;
    }
    EXPECT_LT(smoothSquares, 0.9 * plainSquares);
    EXPECT_NEAR(meanOf(smooth).g, meanOf(plain).g, 0.01);
}

} // namespace
} // namespace metamarch::tests

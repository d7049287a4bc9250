// SPDX-License-Identifier: MIT
// Compares the debug views of the device bit by bit with the same functions on the results of the twins. Also
// tests divided work, replaced shaders and traces that the driver ends early.
#include "fixtures/shapes.h"
#include "fixtures/vulkan_environment.h"
#include "metamarch/reference/twins.h"
#include "metamarch/render/inspector.h"
#include "metamarch/render/view_names.h"
#include "metamarch/scene/import.h"
#include "metamarch/shaders/shader_library.h"
#include "metamarch/shading/shading.h"
#include "metamarch/shading/view.h"
#include "metamarch/shared/packed_pixel.h"
#include "metamarch/vulkan/transfer.h"
#include "path/gpu_scenes.h"
#include "render/inspect_judge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <set>
#include <span>
#include <vector>

namespace metamarch::tests {
namespace {

const std::string kDefaultTraversal(traversals().front());
constexpr float kManySteps = 24.0f; // some rays take more, most take less

// A scene on the device and on the CPU.
class InspectorOnBothSides {
  public:
    enum class Where { fasterMemory, storageBuffers };

    explicit InspectorOnBothSides(const PathScene& given, const AccelerationOptions& options = {},
                                  const Where where = Where::fasterMemory)
        : made(given), structure(buildAccelerationStructure(made.scene, options)), structures(structure),
          shading(shadingOf(made)), primary(makeShadingData(made.scene)),
          sceneBuffers(where == Where::fasterMemory
                           ? render::SceneBuffers(vulkan::testDevice(), structure, primary)
                           : render::SceneBuffers(vulkan::testDevice(), structure, primary,
                                                  vulkan::testDevice().report().maxStorageBufferRange)),
          shadingBuffers(vulkan::testDevice(), shading) {}

    std::vector<std::uint32_t> onCpu(const std::string& traversal, const Camera& camera,
                                     const std::uint32_t view, const float scaleMax,
                                     const float scaleMin = 0.0f) const {
        return inspectOnCpu(structures, shading, traversal, camera, view, scaleMax, scaleMin);
    }

    render::Inspector inspector(const std::string& traversal, const std::uint32_t mostPixels,
                                const std::span<const std::uint32_t> spirv = {},
                                const std::span<const std::uint32_t> cellsSpirv = {}) const {
        return render::Inspector(vulkan::testDevice(), sceneBuffers, shadingBuffers, traversal, mostPixels,
                                 spirv, cellsSpirv);
    }

    Camera camera(const std::uint32_t width, const std::uint32_t height) const {
        return makeCamera(made.view, width, height, made.camera);
    }

    // Returns a distance that is at least that from the eye to the far end of the scene.
    float reach() const {
        const Bounds bounds = boundsOf(made.scene);
        return glm::length(made.view.eye - bounds.lo) + glm::length(bounds.hi - bounds.lo);
    }

    Memory memory() const { return sceneBuffers.memoryKind(); }
    const SceneCamera& view() const { return made.view; }

  private:
    PathScene made;
    AccelerationStructure structure;
    StructureSet structures;
    ShadingScene shading;
    ShadingData primary;
    render::SceneBuffers sceneBuffers;
    render::ShadingBuffers shadingBuffers;
};

PathScene fromFile(const char* name) {
    PathScene made;
    made.scene = loadScene(std::filesystem::path(METAMARCH_SOURCE_DIR) / "scenes" / name);
    made.view = made.scene.cameras.empty()
                    ? frameBounds(boundsOf(made.scene), kDefaultVerticalFov, 4.0f / 3.0f)
                    : made.scene.cameras.front();
    return made;
}

PathScene soup() {
    PathScene made;
    made.scene = triangleSoup(3000, 5);
    made.view = frameBounds(boundsOf(made.scene), kDefaultVerticalFov, 4.0f / 3.0f);
    return made;
}

// Reads the picture of this camera.
std::vector<std::uint32_t> pixelsOf(const render::Inspector& inspector, const Camera& camera) {
    std::vector<std::uint32_t> pixels(std::size_t{camera.width} * camera.height);
    vulkan::read(vulkan::testDevice(), inspector.picture(), 0, std::as_writable_bytes(std::span(pixels)));
    return pixels;
}

std::vector<std::uint32_t> draw(render::Inspector& inspector, const Camera& camera, const std::uint32_t view,
                                const float scaleMax) {
    inspector.start(camera, view, scaleMax);
    while (!inspector.advance()) {
    }
    return pixelsOf(inspector, camera);
}

std::size_t colorsIn(const std::vector<std::uint32_t>& picture) {
    return std::set<std::uint32_t>(picture.begin(), picture.end()).size();
}

void expectSamePicture(const std::vector<std::uint32_t>& picture, const std::vector<std::uint32_t>& expected,
                       const std::uint32_t width) {
    ASSERT_EQ(picture.size(), expected.size());
    std::size_t different = 0;
    for (std::size_t i = 0; i < picture.size(); ++i) {
        if (picture[i] != expected[i] && different++ == 0) {
            ADD_FAILURE() << "pixel " << i % width << ", " << i / width << ": " << std::hex << picture[i]
                          << ", expected " << expected[i];
        }
    }
    EXPECT_EQ(different, 0u) << "pixels";
}

struct InspectedScene {
    const char* name;
    std::function<PathScene()> make;
    AccelerationOptions options{};
};

// NOLINTNEXTLINE(readability-identifier-naming): GoogleTest calls it by this name
void PrintTo(const InspectedScene& scene, std::ostream* out) { *out << scene.name; }

class Inspector : public testing::TestWithParam<InspectedScene> {
  protected:
    void TearDown() override { EXPECT_EQ(vulkan::validationMessages(), 0u); }

    // The first camera draws with every traversal.
    static void expectViewsOfTwin(const InspectorOnBothSides& sides, const std::string& traversal,
                                  const std::span<const Camera> cameras) {
        const bool isDefault = traversal == kDefaultTraversal;
        render::Inspector inspector = sides.inspector(traversal, 75 * 50);
        for (const render::ViewName& viewName : render::kViewNames) {
            const std::uint32_t view = viewName.view;
            if (!isDefault && view != kViewSteps && view != kViewTests && view != kViewShadingNormals) {
                continue;
            }
            SCOPED_TRACE(viewName.name);
            const float scaleMax = viewName.scale == render::ViewScale::distance ? sides.reach() : kManySteps;
            for (const Camera& camera : cameras.first(isDefault ? cameras.size() : 1)) {
                const auto expected = sides.onCpu(traversal, camera, view, scaleMax);
                expectSamePicture(draw(inspector, camera, view, scaleMax), expected, camera.width);
                // Brute force makes the same number of tests for each ray, so its view may have one colour.
                EXPECT_TRUE(!isDefault || colorsIn(expected) > 1u) << "the view has only one colour";
            }
        }
    }
};

// Draws all views with all cameras for the default traversal. For the other traversals it draws only the
// views that differ, steps and tests, and one view of each program.
TEST_P(Inspector, drawsWhatTheTwinsDraw) {
    const InspectorOnBothSides sides(GetParam().make(), GetParam().options);
    SceneCamera flat = sides.view();
    flat.projection = SceneCamera::Projection::orthographic;
    flat.verticalExtent = 0.5f * sides.reach();
    const Camera cameras[] = {
        sides.camera(75, 50), // not multiples of a tile's size
        makeCamera(flat, 61, 47),
        makeCamera(sides.view(), 70, 35, {.isPanorama = true}),
    };
    bool isDrawn = false;
    for (const std::string_view name : traversals()) {
        if (!hasTwin(name)) {
            continue;
        }
        SCOPED_TRACE(name);
        const auto drawn = vulkan::ifTexelsSuffice([&] {
            expectViewsOfTwin(sides, std::string(name), cameras);
            return true;
        });
        isDrawn = isDrawn || drawn;
    }
    if (!isDrawn) {
        GTEST_SKIP() << "the scene has too many texels for every traversal";
    }
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, Inspector,
    testing::Values(InspectedScene{"objects", [] { return fromFile("objects.glb"); }},
                    InspectedScene{"cornell", [] { return fromFile("cornell.glb"); }},
                    InspectedScene{"degenerate", [] { return fromFile("degenerate.glb"); }},
                    InspectedScene{"soup", soup},
                    InspectedScene{"without_exit_boxes", soup, {{}, 4096u, {}, TableMethod::unit, {}, false}},
                    InspectedScene{"everything", everything}),
    [](const auto& instance) { return std::string(instance.param.name); });

class InspectorWork : public testing::Test {
  protected:
    void TearDown() override { EXPECT_EQ(vulkan::validationMessages(), 0u); }

    // With few cells, so that every device takes it.
    const InspectorOnBothSides sides{soup(), {{}, 4096u, {}}};
};

TEST_F(InspectorWork, hasANameForEachView) {
    std::set<std::string_view> names;
    for (std::uint32_t view = 0; view < render::kViewNames.size(); ++view) {
        EXPECT_EQ(render::kViewNames[view].view, view);
        names.insert(render::kViewNames[view].name);
    }
    EXPECT_EQ(names.size(), render::kViewNames.size());
}

TEST_F(InspectorWork, drawsAnEmptyScene) {
    PathScene made;
    made.view = frameBounds(boundsOf(made.scene), kDefaultVerticalFov, 1.0f);
    const InspectorOnBothSides empty(made);
    const Camera camera = empty.camera(9, 9);
    render::Inspector inspector = empty.inspector(kDefaultTraversal, 81);
    for (const render::ViewName& name : render::kViewNames) {
        SCOPED_TRACE(name.name);
        expectSamePicture(draw(inspector, camera, name.view, 1.0f),
                          empty.onCpu(kDefaultTraversal, camera, name.view, 1.0f), 9);
    }
}

// A view has one ray per pixel, which goes through the centre of the lens.
TEST_F(InspectorWork, drawsThroughTheCentreOfTheLens) {
    const Camera camera = makeCamera(sides.view(), 40, 30, {.apertureRadius = 0.5f, .focusDistance = 1.0f});
    render::Inspector inspector = sides.inspector(kDefaultTraversal, 40 * 30);
    expectSamePicture(draw(inspector, camera, kViewNormals, 1.0f),
                      sides.onCpu(kDefaultTraversal, sides.camera(40, 30), kViewNormals, 1.0f), 40);
}

// The depths that are white and black, and what lies outside of them.
TEST_F(InspectorWork, drawsDepthsBetweenTwo) {
    const Camera camera = sides.camera(40, 30);
    render::Inspector inspector = sides.inspector(kDefaultTraversal, 40 * 30);
    const float far = sides.reach();
    for (const auto& [least, most] : {std::pair(0.3f, 0.6f), std::pair(-1.0f, 0.5f), std::pair(2.0f, 3.0f)}) {
        inspector.start(camera, kViewDepth, most * far, least * far);
        while (!inspector.advance()) {
        }
        const auto expected = sides.onCpu(kDefaultTraversal, camera, kViewDepth, most * far, least * far);
        expectSamePicture(pixelsOf(inspector, camera), expected, 40);
    }
    inspector.start(camera, kViewDepth, 3.0f * far, 2.0f * far);
    while (!inspector.advance()) {
    }
    for (const std::uint32_t pixel :
         pixelsOf(inspector, camera)) { // all that is hit lies before the least depth
        EXPECT_TRUE(pixel == kMissColor || pixel == packedPixel(vec3(1.0f)));
    }
    EXPECT_THROW(inspector.start(camera, kViewDepth, 1.0f, 1.0f), std::invalid_argument);
}

// Factor times texel, as glTF has them: green is the roughness, blue the metallic part, red transmits.
TEST(InspectorParameters, areFactorTimesTexture) {
    PathScene made;
    Material material;
    material.metallicFactor = 0.5f;
    material.roughnessFactor = 0.8f;
    material.emissiveFactor = glm::vec3(0.25f, 0.5f, 1.0f);
    material.transmissionFactor = 0.6f;
    const TextureRef texture{.texture =
                                 addTexture(made.scene, 1, {{51, 102, 204, 255}}, TextureFilter::nearest)};
    material.metallicRoughnessTexture = texture;
    material.transmissionTexture = texture;
    addQuad(made.scene, {-1.0f, -1.0f, 0.0f}, {2.0f, 0.0f, 0.0f}, {0.0f, 2.0f, 0.0f},
            addMaterial(made.scene, material));
    made.view = lookAt({0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f});
    const InspectorOnBothSides sides(made);
    const Camera camera = sides.camera(1, 1);
    render::Inspector inspector = sides.inspector(kDefaultTraversal, 1);
    const auto expectColor = [&](const std::uint32_t view, const std::uint32_t expected) {
        SCOPED_TRACE(render::kViewNames[view].name);
        const std::vector<std::uint32_t> picture = draw(inspector, camera, view, 1.0f);
        EXPECT_EQ(picture.front(), expected);
        EXPECT_EQ(picture, sides.onCpu(kDefaultTraversal, camera, view, 1.0f));
    };
    expectColor(kViewMetallic, packedPixel(vec3(0.5f * 204.0f / 255.0f)));
    expectColor(kViewRoughness, packedPixel(vec3(0.8f * 102.0f / 255.0f)));
    expectColor(kViewEmissive, packedLinear(vec3(0.25f, 0.5f, 1.0f)));
    expectColor(kViewTransmission, packedPixel(vec3(0.6f * 51.0f / 255.0f)));
}

TEST_F(InspectorWork, storageBuffersDrawTheSame) {
    const InspectorOnBothSides inStorage(blended(), {}, InspectorOnBothSides::Where::storageBuffers);
    ASSERT_EQ(inStorage.memory(), Memory::storage);
    const Camera camera = inStorage.camera(40, 30);
    render::Inspector inspector = inStorage.inspector(kDefaultTraversal, 40 * 30);
    for (const std::uint32_t view :
         {kViewSteps, kViewAlbedo, kViewRoughness, kViewShadingNormals, kViewExitBoxes}) {
        SCOPED_TRACE(view);
        expectSamePicture(draw(inspector, camera, view, kManySteps),
                          inStorage.onCpu(kDefaultTraversal, camera, view, kManySteps), 40);
    }
}

TEST_F(InspectorWork, cutSmallDrawsTheSame) {
    const Camera camera = sides.camera(93, 70);
    constexpr std::uint32_t kTiles = 12 * 9;
    for (const std::uint32_t view : {kViewTests, kViewAlbedo, kViewCellBorders}) {
        SCOPED_TRACE(view);
        render::Inspector inspector = sides.inspector(kDefaultTraversal, 93 * 70);
        inspector.start(camera, view, kManySteps);
        EXPECT_FALSE(inspector.isWhole());
        std::uint32_t submissions = 1;
        while (!inspector.advance(1e-9)) {
            ++submissions;
        }
        EXPECT_EQ(submissions, kTiles);
        EXPECT_TRUE(inspector.isWhole());
        EXPECT_GT(inspector.deviceSeconds(), 0.0);
        const auto picture = pixelsOf(inspector, camera);
        expectSamePicture(picture, sides.onCpu(kDefaultTraversal, camera, view, kManySteps), 93);

        const double seconds = inspector.deviceSeconds();
        EXPECT_TRUE(inspector.advance());
        EXPECT_EQ(inspector.deviceSeconds(), seconds);
        EXPECT_EQ(pixelsOf(inspector, camera), picture);
    }
}

TEST_F(InspectorWork, startsAnewBeforeThePictureIsWhole) {
    render::Inspector inspector = sides.inspector(kDefaultTraversal, 90 * 70);
    inspector.start(sides.camera(90, 70), kViewSteps, kManySteps);
    EXPECT_FALSE(inspector.advance());
    const Camera smaller = sides.camera(33, 21);
    expectSamePicture(draw(inspector, smaller, kViewLeafId, 1.0f),
                      sides.onCpu(kDefaultTraversal, smaller, kViewLeafId, 1.0f), 33);
    EXPECT_EQ(inspector.picture().size(), std::size_t{90} * 70 * sizeof(std::uint32_t));
}

TEST_F(InspectorWork, refusesWhatItHasNoRoomForAndWhatIsNoView) {
    render::Inspector inspector = sides.inspector(kDefaultTraversal, 1000);
    EXPECT_TRUE(inspector.isWhole());
    EXPECT_THROW(inspector.start(sides.camera(143, 7), kViewSteps, 1.0f), std::invalid_argument);
    EXPECT_THROW(inspector.start(sides.camera(10, 10), render::kViewNames.size(), 1.0f),
                 std::invalid_argument);
    for (const float scale : {0.0f, -1.0f, std::numeric_limits<float>::quiet_NaN()}) {
        EXPECT_THROW(inspector.start(sides.camera(10, 10), kViewSteps, scale), std::invalid_argument);
    }
    Camera empty = sides.camera(10, 10);
    empty.width = 0;
    EXPECT_THROW(inspector.start(empty, kViewSteps, 1.0f), std::invalid_argument);
    inspector.start(sides.camera(142, 7), kViewSteps, 1.0f);
}

// Returns the embedded shader of a kernel, changed to use another colour for misses.
std::vector<std::uint32_t> recolored(const std::string_view kernel, const std::string_view traversal,
                                     const Memory memory, const std::uint32_t color) {
    const auto all = shaders();
    const auto shader = std::ranges::find_if(all, [&](const Shader& candidate) {
        return candidate.kernel == kernel && candidate.traversal == traversal && candidate.memory == memory;
    });
    std::vector<std::uint32_t> spirv(shader->spirv.begin(), shader->spirv.end());
    EXPECT_EQ(std::ranges::count(spirv, kMissColor), 1);
    std::ranges::replace(spirv, kMissColor, color);
    return spirv;
}

TEST_F(InspectorWork, takesShadersInPlaceOfTheEmbeddedOnes) {
    constexpr std::uint32_t kOther = 0xff563412u;
    constexpr std::uint32_t kOtherOfCells = 0xff654321u;
    const Camera camera = sides.camera(40, 30);
    const auto withMisses = [&](const std::uint32_t view, const std::uint32_t color) {
        auto expected = sides.onCpu(kDefaultTraversal, camera, view, 1.0f);
        EXPECT_GT(std::ranges::count(expected, kMissColor), 0);
        std::ranges::replace(expected, kMissColor, color);
        return expected;
    };
    render::Inspector inspector = [&] {
        // The inspector must copy them, because they are destroyed here.
        const auto spirv = recolored("inspect", kDefaultTraversal, sides.memory(), kOther);
        const auto cellsSpirv = recolored("cells", "", sides.memory(), kOtherOfCells);
        return sides.inspector(kDefaultTraversal, 40 * 30, spirv, cellsSpirv);
    }();
    for (const std::uint32_t view : {kViewNormals, kViewAlbedo}) {
        expectSamePicture(draw(inspector, camera, view, 1.0f), withMisses(view, kOther), 40);
    }
    expectSamePicture(draw(inspector, camera, kViewLeafId, 1.0f), withMisses(kViewLeafId, kOtherOfCells), 40);
}

// Returns the number of pixels that have the colour of unfinished traces; the others must be right.
std::size_t expectLoudOrRight(const InspectorOnBothSides& sides, const std::string& traversal,
                              const std::uint32_t view) {
    const Camera camera = sides.camera(8, 8);
    render::Inspector inspector = sides.inspector(traversal, 64);
    const auto expected = sides.onCpu(traversal, camera, view, 4.0f);
    const auto picture = draw(inspector, camera, view, 4.0f);
    std::size_t unfinished = 0;
    for (std::size_t i = 0; i < picture.size(); ++i) {
        const bool isUnfinished = picture[i] == kUnfinishedColor;
        unfinished += isUnfinished ? 1 : 0;
        EXPECT_TRUE(isUnfinished || picture[i] == expected[i]) << "pixel " << i;
    }
    return unfinished;
}

// Later versions of llvmpipe end no loop.
bool endsLongLoops() {
    const vulkan::DeviceReport& report = vulkan::testDevice().report();
    return report.driver == "llvmpipe" && report.driverInfo.starts_with("Mesa 22.");
}

PathScene denseSphere(const unsigned slices, const unsigned stacks) {
    PathScene made;
    addSphere(made.scene, glm::vec3(0.0f), 1.0f, slices, stacks);
    made.view = frameBounds(boundsOf(made.scene), kDefaultVerticalFov, 1.0f);
    return made;
}

// One leaf has more groups of boxes than llvmpipe turns in a loop.
TEST(InspectorCutShort, isDrawnLoudlyOrRight) {
    const InspectorOnBothSides sides(denseSphere(800, 400), {{}, {}, 0u}); // 638,400 triangles in one leaf
    for (const std::uint32_t view : {kViewSteps, kViewNormals, kViewLeafId}) {
        SCOPED_TRACE(view);
        const std::size_t unfinished =
            vulkan::skipUnlessTexelsSuffice([&] { return expectLoudOrRight(sides, "meta_table", view); });
        EXPECT_EQ(unfinished > 0, endsLongLoops());
    }
}

// Eight rays visit leaves of several lengths together. Where llvmpipe ends their loops, some of them are
// between two leaves.
class InspectorCutBetweenLeaves : public testing::TestWithParam<std::string> {};

TEST_P(InspectorCutBetweenLeaves, isDrawnLoudlyOrRight) {
    PathScene made = denseSphere(300, 300); // 179,400 triangles
    // In a large scene, uniform cells hold thousands of the triangles.
    addTriangle(made.scene, {100, 100, 100}, {101, 100, 100}, {100, 101, 100});
    const InspectorOnBothSides sides(made, {{}, 200'000u, 24u});
    const std::size_t unfinished =
        vulkan::skipUnlessTexelsSuffice([&] { return expectLoudOrRight(sides, GetParam(), kViewNormals); });
    EXPECT_EQ(unfinished > 0, endsLongLoops());
}

INSTANTIATE_TEST_SUITE_P(Traversals, InspectorCutBetweenLeaves, testing::Values("kd_restart", "uniform_grid"),
                         [](const auto& instance) { return instance.param; });

} // namespace
} // namespace metamarch::tests

// SPDX-License-Identifier: MIT
// Host and device agree on the layout of buffers: compares the SPIR-V of every shader with the structs of
// C++.
#include "metamarch/shaders/shader_library.h"
#include "metamarch/shared/bvh_node.h"
#include "metamarch/shared/camera.h"
#include "metamarch/shared/display_filter.h"
#include "metamarch/shared/film.h"
#include "metamarch/shared/grid_walk.h"
#include "metamarch/shared/inspect_view.h"
#include "metamarch/shared/kd_node.h"
#include "metamarch/shared/kd_parent.h"
#include "metamarch/shared/light_node.h"
#include "metamarch/shared/path_input.h"
#include "metamarch/shared/primary.h"
#include "metamarch/shared/ray_query.h"
#include "metamarch/shared/rectilinear.h"
#include "metamarch/shared/reference_box.h"
#include "metamarch/shared/scene_layout.h"
#include "metamarch/shared/screen.h"
#include "metamarch/shared/shading_layout.h"
#include "metamarch/shared/wide_bvh_node.h"
#include "metamarch/vulkan/device_report.h"
#include "shaders/spirv_layout.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <ostream>

namespace metamarch {

// NOLINTNEXTLINE(readability-identifier-naming): GoogleTest calls it by this name
void PrintTo(const Shader& shader, std::ostream* out) {
    *out << shader.kernel << " " << shader.traversal
         << (shader.memory == Memory::texel ? " texel" : " storage");
}

namespace tests {
namespace {

struct MemberLayout {
    std::string_view name;
    std::size_t offset;
    std::size_t size;
};

struct StructLayout {
    std::string_view name;
    std::size_t size;
    std::vector<MemberLayout> members;
};

// NOLINTNEXTLINE(readability-identifier-naming): GoogleTest calls it by this name
void PrintTo(const StructLayout& layout, std::ostream* out) { *out << layout.name; }

#define MEMBER(Struct, member)                                                                               \
    { #member, offsetof(Struct, member), sizeof(Struct::member) }

// All structs of shaders/shared that are in a buffer or in push constants.
const StructLayout kStructs[] = {
    {"Lattice",
     sizeof(Lattice),
     {MEMBER(Lattice, origin), MEMBER(Lattice, extent), MEMBER(Lattice, cellsPerUnit),
      MEMBER(Lattice, cellCount), MEMBER(Lattice, resolution), MEMBER(Lattice, triangleCount)}},
    {"Leaf",
     sizeof(Leaf),
     {MEMBER(Leaf, lo), MEMBER(Leaf, hi), MEMBER(Leaf, firstTriangle), MEMBER(Leaf, triangleCount)}},
    {"LeafFrame",
     sizeof(LeafFrame),
     {MEMBER(LeafFrame, x), MEMBER(LeafFrame, y), MEMBER(LeafFrame, z), MEMBER(LeafFrame, firstIndices)}},
    {"LeafHead",
     sizeof(LeafHead),
     {MEMBER(LeafHead, lo), MEMBER(LeafHead, hi), MEMBER(LeafHead, leafId), MEMBER(LeafHead, triangleCount)}},
    {"KdNode", sizeof(KdNode), {MEMBER(KdNode, tag), MEMBER(KdNode, target)}},
    {"KdParent",
     sizeof(KdParent),
     {MEMBER(KdParent, lo), MEMBER(KdParent, hi), MEMBER(KdParent, parent), MEMBER(KdParent, padding)}},
    {"WideBvhNode",
     sizeof(WideBvhNode),
     {MEMBER(WideBvhNode, origin), MEMBER(WideBvhNode, steps), MEMBER(WideBvhNode, lo),
      MEMBER(WideBvhNode, padding0), MEMBER(WideBvhNode, hi), MEMBER(WideBvhNode, padding1),
      MEMBER(WideBvhNode, child0), MEMBER(WideBvhNode, child1), MEMBER(WideBvhNode, child2),
      MEMBER(WideBvhNode, child3)}},
    {"BvhNode",
     sizeof(BvhNode),
     {MEMBER(BvhNode, lo0), MEMBER(BvhNode, child0), MEMBER(BvhNode, hi0), MEMBER(BvhNode, child1),
      MEMBER(BvhNode, lo1), MEMBER(BvhNode, padding0), MEMBER(BvhNode, hi1), MEMBER(BvhNode, padding1)}},
    {"Grid",
     sizeof(Grid),
     {MEMBER(Grid, scale), MEMBER(Grid, cellCount), MEMBER(Grid, resolution), MEMBER(Grid, padding)}},
    {"GridCell", sizeof(GridCell), {MEMBER(GridCell, firstTriangle), MEMBER(GridCell, triangleCount)}},
    {"Rectilinear",
     sizeof(Rectilinear),
     {MEMBER(Rectilinear, bucketsPerUnit), MEMBER(Rectilinear, cellCount), MEMBER(Rectilinear, resolution),
      MEMBER(Rectilinear, padding0), MEMBER(Rectilinear, firstPlane), MEMBER(Rectilinear, padding1),
      MEMBER(Rectilinear, firstBucket), MEMBER(Rectilinear, padding2), MEMBER(Rectilinear, lastBucket),
      MEMBER(Rectilinear, padding3)}},
    {"TriangleRecord",
     sizeof(TriangleRecord),
     {MEMBER(TriangleRecord, v0), MEMBER(TriangleRecord, triangleId), MEMBER(TriangleRecord, v1),
      MEMBER(TriangleRecord, padding0), MEMBER(TriangleRecord, v2), MEMBER(TriangleRecord, padding1)}},
    {"ShadingMaterial",
     sizeof(ShadingMaterial),
     {MEMBER(ShadingMaterial, baseColor), MEMBER(ShadingMaterial, alpha)}},
    {"Camera",
     sizeof(Camera),
     {MEMBER(Camera, eye), MEMBER(Camera, width), MEMBER(Camera, forward), MEMBER(Camera, height),
      MEMBER(Camera, eyeRight), MEMBER(Camera, projection), MEMBER(Camera, eyeDown),
      MEMBER(Camera, pixelFilter), MEMBER(Camera, dirRight), MEMBER(Camera, inverseFocus),
      MEMBER(Camera, dirDown), MEMBER(Camera, padding0), MEMBER(Camera, lensRight), MEMBER(Camera, padding1),
      MEMBER(Camera, lensDown), MEMBER(Camera, padding2)}},
    {"TileOrder",
     sizeof(TileOrder),
     {MEMBER(TileOrder, perRow), MEMBER(TileOrder, rows), MEMBER(TileOrder, rowStride),
      MEMBER(TileOrder, columnStride)}},
    {"PrimaryPush", sizeof(PrimaryPush), {MEMBER(PrimaryPush, firstPlace), MEMBER(PrimaryPush, order)}},
    {"InspectPush",
     sizeof(InspectPush),
     {MEMBER(InspectPush, firstPlace), MEMBER(InspectPush, order), MEMBER(InspectPush, view),
      MEMBER(InspectPush, scaleMax), MEMBER(InspectPush, scaleMin)}},
    {"RayQuery",
     sizeof(RayQuery),
     {MEMBER(RayQuery, origin), MEMBER(RayQuery, tMin), MEMBER(RayQuery, dir), MEMBER(RayQuery, tMax)}},
    {"RayResult",
     sizeof(RayResult),
     {MEMBER(RayResult, t), MEMBER(RayResult, triangleId), MEMBER(RayResult, steps),
      MEMBER(RayResult, tests)}},
    {"RaysPush", sizeof(RaysPush), {MEMBER(RaysPush, first), MEMBER(RaysPush, end)}},
    {"Surface",
     sizeof(Surface),
     {MEMBER(Surface, vertex0), MEMBER(Surface, vertex1), MEMBER(Surface, vertex2),
      MEMBER(Surface, material)}},
    {"Vertex",
     sizeof(Vertex),
     {MEMBER(Vertex, normal), MEMBER(Vertex, u0), MEMBER(Vertex, v0), MEMBER(Vertex, u1), MEMBER(Vertex, v1),
      MEMBER(Vertex, further)}},
    {"MaterialRecord",
     sizeof(MaterialRecord),
     {
#define PARAMETER(type, name, value) MEMBER(MaterialRecord, name),
#define TEXTURE(name, value) MEMBER(MaterialRecord, name),
#include "metamarch/shared/material_rows.inc"
     }},
    {"TextureRecord", sizeof(TextureRecord), {MEMBER(TextureRecord, level), MEMBER(TextureRecord, use)}},
    {"Emitter",
     sizeof(Emitter),
     {MEMBER(Emitter, v0), MEMBER(Emitter, triangleId), MEMBER(Emitter, v1), MEMBER(Emitter, material),
      MEMBER(Emitter, v2), MEMBER(Emitter, branches)}},
    {"LightRecord",
     sizeof(LightRecord),
     {MEMBER(LightRecord, position), MEMBER(LightRecord, kind), MEMBER(LightRecord, direction),
      MEMBER(LightRecord, scale), MEMBER(LightRecord, strength), MEMBER(LightRecord, offset)}},
    {"LightNode",
     sizeof(LightNode),
     {MEMBER(LightNode, center), MEMBER(LightNode, radius), MEMBER(LightNode, axis),
      MEMBER(LightNode, angles), MEMBER(LightNode, intensity), MEMBER(LightNode, link)}},
    {"TableEntry",
     sizeof(TableEntry),
     {MEMBER(TableEntry, from), MEMBER(TableEntry, upTo), MEMBER(TableEntry, probability),
      MEMBER(TableEntry, guide)}},
    {"Media",
     sizeof(Media),
     {MEMBER(Media, first), MEMBER(Media, second), MEMBER(Media, third), MEMBER(Media, fourth)}},
    {"PathSettings",
     sizeof(PathSettings),
     {MEMBER(PathSettings, background),
      MEMBER(PathSettings, maxBounces),
      MEMBER(PathSettings, seed),
      MEMBER(PathSettings, strategies),
      MEMBER(PathSettings, lightCount),
      MEMBER(PathSettings, emitterCount),
      MEMBER(PathSettings, punctualCount),
      MEMBER(PathSettings, environmentWidth),
      MEMBER(PathSettings, environmentHeight),
      MEMBER(PathSettings, environmentProbability),
      MEMBER(PathSettings, environmentCosine),
      MEMBER(PathSettings, environmentSine),
      MEMBER(PathSettings, environmentScale),
      MEMBER(PathSettings, clampLuminance),
      MEMBER(PathSettings, sunIndex),
      MEMBER(PathSettings, eyeMedia),
      MEMBER(PathSettings, blockColumnShift),
      MEMBER(PathSettings, blockRowShift),
      MEMBER(PathSettings, catcher),
      MEMBER(PathSettings, catcherWhite),
      MEMBER(PathSettings, catcherMirror),
      MEMBER(PathSettings, padding0),
      MEMBER(PathSettings, padding1)}},
    {"PathInput",
     sizeof(PathInput),
     {MEMBER(PathInput, camera), MEMBER(PathInput, settings), MEMBER(PathInput, areaLeft),
      MEMBER(PathInput, areaTop), MEMBER(PathInput, areaWidth), MEMBER(PathInput, areaHeight)}},
    {"Count", sizeof(Count), {MEMBER(Count, low), MEMBER(Count, high)}},
    {"PathStatus",
     sizeof(PathStatus),
     {MEMBER(PathStatus, unfinished), MEMBER(PathStatus, stuck), MEMBER(PathStatus, outOfTurns),
      MEMBER(PathStatus, rays), MEMBER(PathStatus, steps), MEMBER(PathStatus, tests)}},
    {"AddBlockPush", sizeof(AddBlockPush), {MEMBER(AddBlockPush, firstPlace)}},
    {"PathPush",
     sizeof(PathPush),
     {MEMBER(PathPush, firstPlace), MEMBER(PathPush, order), MEMBER(PathPush, firstSample),
      MEMBER(PathPush, samples), MEMBER(PathPush, bandPlace), MEMBER(PathPush, isFresh),
      MEMBER(PathPush, turns)}},
    {"ResolvePush",
     sizeof(ResolvePush),
     {MEMBER(ResolvePush, firstPlace), MEMBER(ResolvePush, order), MEMBER(ResolvePush, bandPlace),
      MEMBER(ResolvePush, width), MEMBER(ResolvePush, height), MEMBER(ResolvePush, toneOperator),
      MEMBER(ResolvePush, scale)}},
    {"FilterSurface", sizeof(FilterSurface), {MEMBER(FilterSurface, albedo), MEMBER(FilterSurface, depth)}},
    {"FilterShape", sizeof(FilterShape), {MEMBER(FilterShape, normal), MEMBER(FilterShape, slope)}},
    {"FilterLight", sizeof(FilterLight), {MEMBER(FilterLight, light), MEMBER(FilterLight, variance)}},
    {"FilterBeginPush",
     sizeof(FilterBeginPush),
     {MEMBER(FilterBeginPush, firstPlace), MEMBER(FilterBeginPush, order), MEMBER(FilterBeginPush, bandPlace),
      MEMBER(FilterBeginPush, width), MEMBER(FilterBeginPush, height)}},
    {"FilterPush",
     sizeof(FilterPush),
     {MEMBER(FilterPush, firstRow), MEMBER(FilterPush, width), MEMBER(FilterPush, height),
      MEMBER(FilterPush, isSingle), MEMBER(FilterPush, distance), MEMBER(FilterPush, tolerance),
      MEMBER(FilterPush, kept), MEMBER(FilterPush, toneOperator), MEMBER(FilterPush, scale)}},
    {"PresentPush",
     sizeof(PresentPush),
     {MEMBER(PresentPush, width), MEMBER(PresentPush, height), MEMBER(PresentPush, firstColumn),
      MEMBER(PresentPush, endColumn), MEMBER(PresentPush, fineWidth), MEMBER(PresentPush, fineHeight),
      MEMBER(PresentPush, coarseWidth), MEMBER(PresentPush, coarseHeight), MEMBER(PresentPush, isBlueFirst),
      MEMBER(PresentPush, backdropColumns), MEMBER(PresentPush, backdropRows)}},
    {"MagnifyPush",
     sizeof(MagnifyPush),
     {MEMBER(MagnifyPush, width), MEMBER(MagnifyPush, scale), MEMBER(MagnifyPush, skippedColumns),
      MEMBER(MagnifyPush, skippedRows)}},
    {"FirstHit",
     sizeof(FirstHit),
     {MEMBER(FirstHit, albedo), MEMBER(FirstHit, t), MEMBER(FirstHit, normal), MEMBER(FirstHit, triangleId),
      MEMBER(FirstHit, shadingNormal), MEMBER(FirstHit, depth)}},
    {"LightParts",
     sizeof(LightParts),
     {MEMBER(LightParts, emission), MEMBER(LightParts, caught), MEMBER(LightParts, direct),
      MEMBER(LightParts, mirrored), MEMBER(LightParts, indirect), MEMBER(LightParts, mirrorSamples),
      MEMBER(LightParts, reached), MEMBER(LightParts, padding0), MEMBER(LightParts, unblocked),
      MEMBER(LightParts, padding1), MEMBER(LightParts, behind), MEMBER(LightParts, padding2)}},
    {"FilmPixel",
     sizeof(FilmPixel),
     {MEMBER(FilmPixel, radiance), MEMBER(FilmPixel, samples), MEMBER(FilmPixel, squares),
      MEMBER(FilmPixel, rejected), MEMBER(FilmPixel, seen), MEMBER(FilmPixel, covered),
      MEMBER(FilmPixel, rays), MEMBER(FilmPixel, shadowRays), MEMBER(FilmPixel, steps),
      MEMBER(FilmPixel, tests), MEMBER(FilmPixel, padding0), MEMBER(FilmPixel, padding1),
      MEMBER(FilmPixel, padding2)}},
};

#undef MEMBER

const StructLayout* findStruct(const std::string_view name) {
    const auto* const found =
        std::find_if(std::begin(kStructs), std::end(kStructs),
                     [&](const StructLayout& candidate) { return candidate.name == name; });
    return found == std::end(kStructs) ? nullptr : found;
}

// The buffers that shaders read as vectors of words, from which they assemble structs.
struct WordBuffer {
    std::string_view block;
    std::string_view element;
};

const WordBuffer kWordBuffers[] = {
    {"leafWordsBuffer", "Leaf"},
    {"leafWordsBuffer", "LeafHead"},
    {"leafWordsBuffer", "LeafFrame"}, // and groups of four boxes and of four indices: all have one size
    {"kdNodeWordsBuffer", "KdNode"},
    {"kdParentWordsBuffer", "KdParent"},
    {"bvhNodeWordsBuffer", "BvhNode"},
    {"wideNodeWordsBuffer", "WideBvhNode"},
    {"gridCellWordsBuffer", "GridCell"},
    {"rayWordsBuffer", "RayQuery"},
    {"surfaceWordsBuffer", "Surface"},
    {"vertexWordsBuffer", "Vertex"},
    {"materialWordsBuffer", "MaterialRecord"},
    {"textureWordsBuffer", "TextureRecord"},
    {"emitterWordsBuffer", "Emitter"},
    {"lightWordsBuffer", "LightRecord"},
    {"lightWordsBuffer", "LightNode"}, // behind the lights
    {"tableWordsBuffer", "TableEntry"},
};

// The buffers whose entries are four numbers without a struct, or single words that are read four at a time.
constexpr std::string_view kVectorBuffers[] = {"BackdropBuffer", "colorWordsBuffer", "tangentWordsBuffer",
                                               "metaTableWordsBuffer", "environmentWordsBuffer"};

// The buffers with several members, and the struct of C++ with the same members.
const WordBuffer kBlocks[] = {{"InputBuffer", "PathInput"}};

const StructLayout* findElement(const std::string_view block) {
    const auto* const found =
        std::find_if(std::begin(kWordBuffers), std::end(kWordBuffers),
                     [&](const WordBuffer& candidate) { return candidate.block == block; });
    return found == std::end(kWordBuffers) ? nullptr : findStruct(found->element);
}

std::optional<std::size_t> sizeOf(const SpirvLayout& layout, const std::uint32_t typeId) {
    if (layout.numbers.contains(typeId)) {
        return layout.numbers.at(typeId);
    }
    const auto found = layout.structs.find(typeId);
    const StructLayout* const known =
        found == layout.structs.end() ? nullptr : findStruct(found->second.name);
    return known == nullptr ? std::nullopt : std::optional(known->size);
}

// A struct that is assembled from words has no offsets in SPIR-V: its members follow each other.
void expectMembers(const SpirvLayout& layout, const SpirvStruct& found, const StructLayout& expected) {
    ASSERT_EQ(found.members.size(), expected.members.size());
    std::uint32_t end = 0;
    for (std::size_t i = 0; i < found.members.size(); ++i) {
        const SpirvMember& member = found.members[i];
        SCOPED_TRACE(member.name);
        const std::optional<std::size_t> size = sizeOf(layout, member.typeId);
        ASSERT_TRUE(size) << "neither a number nor a vector nor a struct of the table";
        EXPECT_EQ(member.name, expected.members[i].name);
        EXPECT_EQ(member.offset.value_or(end), expected.members[i].offset);
        EXPECT_EQ(*size, expected.members[i].size);
        end = member.offset.value_or(end) + static_cast<std::uint32_t>(*size);
    }
    EXPECT_EQ(end, expected.size) << "the struct ends with unnamed padding";
}

// A buffer has one member: a struct of the table, a number, or an array of these without gaps.
void expectBlock(const SpirvLayout& layout, const SpirvStruct& block) {
    const auto* const whole = std::ranges::find(kBlocks, block.name, &WordBuffer::block);
    if (whole != std::end(kBlocks)) {
        expectMembers(layout, block, *findStruct(whole->element));
        return;
    }
    ASSERT_EQ(block.members.size(), 1u);
    EXPECT_EQ(block.members.front().offset, 0u);
    const auto array = layout.arrays.find(block.members.front().typeId);
    const bool isArray = array != layout.arrays.end();
    const std::uint32_t typeId = isArray ? array->second.elementTypeId : block.members.front().typeId;
    if (layout.structs.contains(typeId)) {
        const StructLayout* const element = findStruct(layout.structs.at(typeId).name);
        ASSERT_NE(element, nullptr) << layout.structs.at(typeId).name << " is not in the table of this test";
        EXPECT_EQ(isArray ? array->second.stride : element->size, element->size);
        return;
    }
    ASSERT_TRUE(isArray && layout.numbers.contains(typeId));
    const std::uint32_t size = layout.numbers.at(typeId);
    EXPECT_EQ(array->second.stride, size);
    if (size > sizeof(std::uint32_t) &&
        std::ranges::find(kVectorBuffers, block.name) == std::end(kVectorBuffers)) {
        const StructLayout* const element = findElement(block.name);
        ASSERT_NE(element, nullptr) << "the struct of its words is not in the table of this test";
        EXPECT_EQ(element->size % size, 0u);
    }
}

class Layout : public testing::TestWithParam<Shader> {};

TEST_P(Layout, isTheOneOfTheStructsInCpp) {
    const SpirvLayout layout = readLayout(GetParam().spirv);
    std::size_t blocks = 0;
    for (const auto& [typeId, found] : layout.structs) {
        SCOPED_TRACE(found.name);
        if (found.isBlock) {
            expectBlock(layout, found);
            ++blocks;
        } else if (const StructLayout* const expected = findStruct(found.name)) {
            expectMembers(layout, found, *expected);
        } else {
            EXPECT_FALSE(found.liesInMemory()) << "not in the table of this test";
        }
    }
    EXPECT_GT(blocks, 0u);
}

INSTANTIATE_TEST_SUITE_P(Shaders, Layout, testing::ValuesIn(shaders().begin(), shaders().end()),
                         [](const auto& instance) {
                             return fmt::format("{}_{}_{}", instance.param.kernel, instance.param.traversal,
                                                instance.param.memory == Memory::texel ? "texel" : "storage");
                         });

// A device that has as many descriptors runs every kernel (vulkan::DeviceReport::runsEveryKernel).
TEST(Descriptors, areAsManyAsADeviceIsAskedFor) {
    std::uint32_t storageBuffers = 0;
    std::uint32_t texelBuffers = 0;
    for (const Shader& shader : shaders()) {
        const SpirvLayout layout = readLayout(shader.spirv);
        storageBuffers = std::max(storageBuffers, layout.storageBuffers);
        if (shader.memory == Memory::texel) {
            EXPECT_LE(layout.storageBuffers, vulkan::kLeastStorageBuffers)
                << shader.kernel << shader.traversal;
        }
        texelBuffers = std::max(texelBuffers, layout.texelBuffers);
    }
    EXPECT_EQ(storageBuffers, vulkan::kMostStorageBuffers);
    EXPECT_EQ(texelBuffers, vulkan::kMostTexelBuffers);
}

class SharedStruct : public testing::TestWithParam<StructLayout> {};

bool liesInMemory(const SpirvLayout& layout, const StructLayout& wanted) {
    return std::any_of(layout.structs.begin(), layout.structs.end(), [&](const auto& entry) {
        const SpirvStruct& candidate = entry.second;
        const bool isElement = std::ranges::any_of(kWordBuffers, [&](const WordBuffer& buffer) {
            return buffer.block == candidate.name && buffer.element == wanted.name;
        });
        const auto* const whole = std::ranges::find(kBlocks, candidate.name, &WordBuffer::block);
        return (candidate.name == wanted.name && candidate.liesInMemory()) ||
               (whole != std::end(kBlocks) && whole->element == wanted.name) ||
               (candidate.isBlock && isElement);
    });
}

// Ensures that the test above has compared something.
TEST_P(SharedStruct, liesInTheMemoryOfSomeShader) {
    EXPECT_TRUE(std::any_of(shaders().begin(), shaders().end(), [](const Shader& shader) {
        return liesInMemory(readLayout(shader.spirv), GetParam());
    }));
}

INSTANTIATE_TEST_SUITE_P(Structs, SharedStruct, testing::ValuesIn(kStructs),
                         [](const auto& instance) { return std::string(instance.param.name); });

} // namespace
} // namespace tests
} // namespace metamarch

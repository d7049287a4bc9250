// SPDX-License-Identifier: MIT
// The division of the triangle records into buffers.
#include "fixtures/expect_error.h"
#include "metamarch/render/scene_buffers.h"

#include <gtest/gtest.h>

namespace metamarch::render {
namespace {

constexpr std::uint64_t kRange = std::uint64_t{1}
                                 << 27; // that of lavapipe, which is the least that Vulkan allows
constexpr std::uint64_t kRecordsPerChunk = kRange / sizeof(TriangleRecord);

TEST(TriangleChunks, areAsFewAsTheRangeAllows) {
    EXPECT_EQ(chunkTriangles(0, kRange).count, 1u);
    EXPECT_EQ(chunkTriangles(1, kRange).count, 1u);
    for (std::uint32_t count = 1; count <= kTriangleChunks; ++count) {
        EXPECT_EQ(chunkTriangles(count * kRecordsPerChunk, kRange).count, count);
        EXPECT_EQ(chunkTriangles((count - 1) * kRecordsPerChunk + 1, kRange).count, count);
    }
}

TEST(TriangleChunks, holdWholeRecords) {
    for (const std::uint64_t range :
         {kRange, kRange + 1, kRange + 47, std::uint64_t{sizeof(TriangleRecord)}}) {
        const std::uint64_t perChunk = chunkTriangles(1, range).triangles;
        EXPECT_LE(perChunk * sizeof(TriangleRecord), range);
        EXPECT_GT((perChunk + 1) * sizeof(TriangleRecord), range);
    }
}

// Shaders count records with 32 bits.
TEST(TriangleChunks, keepTo32BitsWhateverTheRange) {
    EXPECT_EQ(chunkTriangles(kRecordsPerChunk, std::uint64_t{1} << 40).triangles, 0xffffffffu);
    EXPECT_EQ(chunkTriangles(std::uint64_t{1} << 32, std::uint64_t{1} << 40).count, 2u);
}

TEST(TriangleChunks, refuseMoreRecordsThanTheyHold) {
    const std::uint64_t most = kTriangleChunks * kRecordsPerChunk;
    EXPECT_NO_THROW(chunkTriangles(most, kRange));
    for (const std::uint64_t count : {most + 1, std::uint64_t{1} << 30}) {
        expectError(ErrorKind::outOfMemory, "maxStorageBufferRange (128.0 MiB); choose a smaller tree depth",
                    [&] { chunkTriangles(count, kRange); });
        expectError(ErrorKind::outOfMemory, std::to_string(count) + " triangle references",
                    [&] { chunkTriangles(count, kRange); });
    }
}

} // namespace
} // namespace metamarch::render

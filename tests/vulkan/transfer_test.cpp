// SPDX-License-Identifier: MIT
#include "fixtures/vulkan_environment.h"
#include "metamarch/vulkan/transfer.h"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

namespace metamarch::vulkan {
namespace {

// Returns data that differs at every place where a chunk could go wrong.
std::vector<uint32_t> pattern(size_t count) {
    std::vector<uint32_t> values(count);
    uint32_t state = 1;
    for (uint32_t& value : values) {
        state = state * 1664525u + 1013904223u;
        value = state;
    }
    return values;
}

TEST(Transfer, bringsBackWhatItUploaded) {
    const std::vector<uint32_t> values = pattern(1001);
    const Buffer buffer = upload(testDevice(), std::span(values), "values");
    EXPECT_EQ(buffer.size(), values.size() * sizeof(uint32_t));
    EXPECT_EQ(buffer.name(), "values");
    EXPECT_TRUE(buffer.mapped().empty());
    EXPECT_EQ(download<uint32_t>(testDevice(), buffer), values);
}

TEST(Transfer, crossesSeveralChunks) {
    const std::vector<uint32_t> values = pattern(5 * kTransferChunkSize / (2 * sizeof(uint32_t)) + 3);
    const Buffer buffer(testDevice(), BufferUse::storage, values.size() * sizeof(uint32_t), "values");
    write(testDevice(), buffer, 0, std::as_bytes(std::span(values)));
    // Compared as a whole, so that a failure does not print megabytes.
    EXPECT_TRUE(download<uint32_t>(testDevice(), buffer) == values);
}

// A new buffer is filled without staging where the host sees the device's memory, however large it is.
TEST(Transfer, uploadsMoreThanAChunk) {
    const std::vector<uint32_t> values = pattern(kTransferChunkSize / sizeof(uint32_t) + 3);
    const Buffer buffer = upload(testDevice(), std::span(values), "values");
    EXPECT_TRUE(download<uint32_t>(testDevice(), buffer) == values);
}

TEST(Transfer, reusesItsMemory) {
    std::vector<uint32_t> values = pattern(1001);
    const Buffer buffer = upload(testDevice(), std::span(values), "values");
    EXPECT_EQ(download<uint32_t>(testDevice(), buffer), values);
    const uint64_t before = testDevice().memoryUse().allocations;
    for (int i = 0; i < 3; ++i) {
        ++values[500];
        write(testDevice(), buffer, 0, std::as_bytes(std::span(values)));
        EXPECT_EQ(download<uint32_t>(testDevice(), buffer), values);
    }
    EXPECT_EQ(testDevice().memoryUse().allocations, before);
    const Buffer more(testDevice(), BufferUse::storage, 4, "more");
    EXPECT_EQ(testDevice().memoryUse().allocations, before + 1);
}

TEST(Transfer, takesAnyNumberOfBytes) {
    const std::vector<uint8_t> bytes = {1, 2, 3, 4, 5};
    const Buffer buffer = upload(testDevice(), std::span(bytes), "bytes");
    EXPECT_EQ(download<uint8_t>(testDevice(), buffer), bytes);
}

TEST(Transfer, takesNothing) {
    const Buffer buffer = upload(testDevice(), std::span<const std::byte>(), "nothing");
    EXPECT_EQ(buffer.size(), 0u);
    EXPECT_TRUE(download<uint32_t>(testDevice(), buffer).empty());
}

TEST(Transfer, writesAndReadsAtAnOffset) {
    std::vector<uint32_t> values = pattern(100);
    const Buffer buffer = upload(testDevice(), std::span(values), "values");
    const std::vector<uint32_t> patch = {7, 8, 9};
    write(testDevice(), buffer, 40, std::as_bytes(std::span(patch)));
    std::memcpy(values.data() + 10, patch.data(), sizeof(uint32_t) * patch.size());
    EXPECT_EQ(download<uint32_t>(testDevice(), buffer), values);

    std::vector<uint32_t> part(2);
    read(testDevice(), buffer, 44, std::as_writable_bytes(std::span(part)));
    EXPECT_EQ(part, (std::vector<uint32_t>{8, 9}));
}

} // namespace
} // namespace metamarch::vulkan

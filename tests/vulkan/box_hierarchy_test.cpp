// SPDX-License-Identifier: MIT
// Tests the driver's hierarchy on devices with ray queries; on others, that it is refused.
#include "fixtures/vulkan_environment.h"
#include "kernels/boxes.h"
#include "metamarch/vulkan/box_hierarchy.h"
#include "metamarch/vulkan/submission.h"
#include "metamarch/vulkan/transfer.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <iostream>
#include <stdexcept>

namespace metamarch::vulkan {
namespace {

constexpr uint32_t kBoxes = 8;

// Returns unit cubes along x, two units apart.
std::vector<VkAabbPositionsKHR> row() {
    std::vector<VkAabbPositionsKHR> boxes;
    for (uint32_t i = 0; i < kBoxes; ++i) {
        const auto x = static_cast<float>(3 * i);
        boxes.push_back({x, 0.0f, 0.0f, x + 1.0f, 1.0f, 1.0f});
    }
    return boxes;
}

// Returns, for each pair of origin and direction, a bit mask of the boxes that the ray may meet.
std::vector<uint32_t> meet(const std::vector<VkAabbPositionsKHR>& boxes, const std::vector<glm::vec4>& rays) {
    const Device& device = testDevice();
    const BoxHierarchy hierarchy(device, boxes, "boxes");
    EXPECT_GT(hierarchy.size(), 0u);
    const uint32_t count = static_cast<uint32_t>(rays.size()) / 2;
    const Buffer input = upload(device, std::span(rays), "rays");
    const Buffer output(device, BufferUse::storage, count * sizeof(uint32_t), "masks");
    ComputePipeline kernel(
        device, {.name = "boxes", .spirv = boxesSpirv, .storageBindings = {1, 2}, .hierarchyBindings = {0}});
    kernel.bind(0, hierarchy);
    kernel.bind(1, input);
    kernel.bind(2, output);
    Submission submission(device);
    submission.run([&](Commands& commands) { commands.dispatch(kernel, {count, 1, 1}); });
    return download<uint32_t>(device, output);
}

bool refused() {
    if (testDevice().report().hasRayQuery()) {
        return false;
    }
    std::cerr << testDevice().name() << " has no ray queries: only the refusal is tested\n";
    EXPECT_THROW(BoxHierarchy(testDevice(), row(), "boxes"), std::logic_error);
    return true;
}

TEST(BoxHierarchy, offersTheBoxesThatARayMeetsByTheirNumbers) {
    if (refused()) {
        return;
    }
    std::vector<glm::vec4> rays;
    for (uint32_t i = 0; i < kBoxes; ++i) { // down through each cube
        rays.emplace_back(3.0f * static_cast<float>(i) + 0.5f, 9, 0.5f, 0);
        rays.emplace_back(0, -2, 0, 0);
    }
    rays.emplace_back(-1, 0.5f, 0.5f, 0); // along the row, through all of them
    rays.emplace_back(1, 0, 0, 0);
    rays.emplace_back(-1, 5, 0.5f, 0); // past all of them
    rays.emplace_back(1, 0, 0, 0);
    const std::vector<uint32_t> masks = meet(row(), rays);
    for (uint32_t i = 0; i < kBoxes; ++i) {
        EXPECT_EQ(masks[i], 1u << i);
    }
    EXPECT_EQ(masks[kBoxes], (1u << kBoxes) - 1u);
    EXPECT_EQ(masks[kBoxes + 1], 0u);
    EXPECT_EQ(validationMessages(), 0u);
}

TEST(BoxHierarchy, mayBeEmpty) {
    if (refused()) {
        return;
    }
    EXPECT_EQ(meet({}, {{0.5f, 9, 0.5f, 0}, {0, -1, 0, 0}}), std::vector<uint32_t>{0});
    EXPECT_EQ(validationMessages(), 0u);
}

} // namespace
} // namespace metamarch::vulkan

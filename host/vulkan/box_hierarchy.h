// SPDX-License-Identifier: MIT
// The driver's bounding volume hierarchy over boxes, for ray queries: VK_KHR_acceleration_structure.
#pragma once
#include "metamarch/vulkan/buffer.h"
#include "metamarch/vulkan/device.h"

#include <cstdint>
#include <span>
#include <string>

namespace metamarch::vulkan {

// Move-only. It has two levels, as Vulkan requires: a bottom level over the boxes and a top level with one
// untransformed instance of it.
class BoxHierarchy {
  public:
    // The device must have ray queries (DeviceReport::hasRayQuery). The index of a box in `boxes` is its
    // primitive index in ray queries. Neighbours in space should be neighbours in `boxes`, because not every
    // driver sorts them. Throws Error(outOfMemory), naming the limit, if the device cannot hold the
    // hierarchy.
    BoxHierarchy(const Device& device, std::span<const vk::AabbPositionsKHR> boxes, const std::string& name);

    uint64_t size() const { return bottom_.buffer.size() + top_.buffer.size(); } // bytes on the device
    vk::AccelerationStructureKHR handle() const { return *top_.structure; }

  private:
    struct Level {
        Buffer buffer;
        vk::raii::AccelerationStructureKHR structure;
    };

    static Level build(const Device& device, vk::AccelerationStructureTypeKHR type,
                       const vk::AccelerationStructureGeometryKHR& geometry, uint32_t count,
                       const std::string& name);
    static Level buildBottom(const Device& device, std::span<const vk::AabbPositionsKHR> boxes,
                             const std::string& name);
    static Level buildTop(const Device& device, const Level& bottom, const std::string& name);

    Level bottom_;
    Level top_; // refers to the bottom level
};

} // namespace metamarch::vulkan

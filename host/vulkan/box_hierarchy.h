// SPDX-License-Identifier: MIT
// The driver's bounding volume hierarchy over boxes, for ray queries: VK_KHR_acceleration_structure.
#pragma once
#include "metamarch/vulkan/device.h"
#include "metamarch/vulkan/handle_types.h"

#include <cstdint>
#include <memory>
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
    BoxHierarchy(const Device& device, std::span<const VkAabbPositionsKHR> boxes, const std::string& name);
    ~BoxHierarchy();
    BoxHierarchy(BoxHierarchy&&) noexcept;
    BoxHierarchy& operator=(BoxHierarchy&&) noexcept;

    uint64_t size() const; // bytes on the device
    vk::AccelerationStructureKHR handle() const;

  private:
    struct Levels;

    std::unique_ptr<Levels> levels_;
};

} // namespace metamarch::vulkan

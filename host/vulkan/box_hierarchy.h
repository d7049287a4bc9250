// The driver's own bounding volume hierarchy over boxes, for ray queries: VK_KHR_acceleration_structure.
#pragma once
#include "metamarch/vulkan/buffer.h"
#include "metamarch/vulkan/device.h"

#include <cstdint>
#include <span>
#include <string>

namespace metamarch::vulkan {

// Move-only. Two levels, as Vulkan wants it: a bottom one over the boxes and a top one that holds it once, in
// its own place and size.
class BoxHierarchy {
  public:
    // For a device with ray queries (DeviceReport::hasRayQuery). A box's number in `boxes` is the primitive
    // index of a ray query; neighbours in space should be neighbours in `boxes`, as not every driver sorts
    // them. Throws Error(outOfMemory), naming the limit, where the device cannot hold it.
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
    Level top_; // points to the bottom one
};

} // namespace metamarch::vulkan

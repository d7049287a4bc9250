// SPDX-License-Identifier: MIT
#include "metamarch/vulkan/box_hierarchy.h"

#include "metamarch/error/error.h"
#include "metamarch/vulkan/buffer.h"
#include "metamarch/vulkan/refusal.h"
#include "metamarch/vulkan/submission.h"
#include "metamarch/vulkan/transfer.h"

#include <fmt/format.h>
#include <vulkan/vulkan_raii.hpp>

#include <array>
#include <stdexcept>
#include <utility>

namespace metamarch::vulkan {
namespace {

using LevelType = vk::AccelerationStructureTypeKHR;

// Uploads input for a build.
Buffer uploadInput(const Device& device, const std::span<const std::byte> data, const std::string& name) {
    Buffer buffer(device, BufferUse::hierarchyInput, data.size(), name);
    write(device, buffer, 0, data);
    return buffer;
}

void requireRoom(const Device& device, const uint64_t boxes, const std::string& name) {
    const DeviceReport& report = device.report();
    if (!report.hasRayQuery()) {
        throw std::logic_error("a BoxHierarchy on a device without ray queries");
    }
    if (boxes > report.maxHierarchyBoxes) {
        throw Error(ErrorKind::outOfMemory,
                    fmt::format("{}: {} of {} boxes is over maxPrimitiveCount, {}", device.name(), name,
                                boxes, report.maxHierarchyBoxes));
    }
}

} // namespace

struct BoxHierarchy::Levels {
    struct Level {
        Buffer buffer;
        vk::raii::AccelerationStructureKHR structure;
    };

    Levels(const Device& device, const std::span<const VkAabbPositionsKHR> boxes, const std::string& name)
        : bottom(buildBottom(device, boxes, name)), top(buildTop(device, bottom, name)) {}

    // Builds one level from a geometry with `count` primitives.
    static Level build(const Device& device, LevelType type,
                       const vk::AccelerationStructureGeometryKHR& geometry, uint32_t count,
                       const std::string& name);
    static Level buildBottom(const Device& device, std::span<const VkAabbPositionsKHR> boxes,
                             const std::string& name);
    static Level buildTop(const Device& device, const Level& bottom, const std::string& name);

    Level bottom;
    Level top; // refers to the bottom level
};

BoxHierarchy::Levels::Level BoxHierarchy::Levels::build(const Device& device, const LevelType type,
                                                        const vk::AccelerationStructureGeometryKHR& geometry,
                                                        const uint32_t count, const std::string& name) {
    try {
        vk::AccelerationStructureBuildGeometryInfoKHR info(
            type, vk::BuildAccelerationStructureFlagBitsKHR::ePreferFastTrace,
            vk::BuildAccelerationStructureModeKHR::eBuild);
        info.setGeometries(geometry);
        const vk::AccelerationStructureBuildSizesInfoKHR sizes =
            device.handle().getAccelerationStructureBuildSizesKHR(
                vk::AccelerationStructureBuildTypeKHR::eDevice, info, count);
        Buffer buffer(device, BufferUse::hierarchy, sizes.accelerationStructureSize, name);
        vk::raii::AccelerationStructureKHR structure(
            device.handle(),
            vk::AccelerationStructureCreateInfoKHR({}, buffer.handle(), 0, buffer.size(), type));

        // The driver may require a stricter alignment of this buffer's address than it gives to buffers.
        const uint64_t alignment = device.report().minScratchAlignment;
        const Buffer scratch(device, BufferUse::scratch, sizes.buildScratchSize + alignment,
                             name + " (scratch)");
        info.setDstAccelerationStructure(*structure);
        info.scratchData.deviceAddress = (scratch.address() + alignment - 1) / alignment * alignment;
        Submission submission(device);
        submission.run([&](Commands& commands) { commands.build(info, count); });
        return {std::move(buffer), std::move(structure)};
    } catch (const vk::SystemError& error) {
        throw refusalOf(error, fmt::format("{}: cannot build {}", device.name(), name));
    }
}

BoxHierarchy::Levels::Level BoxHierarchy::Levels::buildBottom(const Device& device,
                                                              const std::span<const VkAabbPositionsKHR> boxes,
                                                              const std::string& name) {
    requireRoom(device, boxes.size(), name);
    const Buffer input = uploadInput(device, std::as_bytes(boxes), name + " (boxes)");
    vk::AccelerationStructureGeometryKHR geometry(vk::GeometryTypeKHR::eAabbs);
    geometry.geometry.setAabbs({input.address(), sizeof(VkAabbPositionsKHR)});
    return build(device, LevelType::eBottomLevel, geometry, static_cast<uint32_t>(boxes.size()), name);
}

BoxHierarchy::Levels::Level BoxHierarchy::Levels::buildTop(const Device& device, const Level& bottom,
                                                           const std::string& name) {
    const vk::TransformMatrixKHR identity(
        std::array<std::array<float, 4>, 3>{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}});
    const vk::AccelerationStructureInstanceKHR instance(
        identity, 0, 0xff, 0, {}, device.handle().getAccelerationStructureAddressKHR(*bottom.structure));
    const Buffer input = uploadInput(device, std::as_bytes(std::span(&instance, 1)), name + " (instance)");
    vk::AccelerationStructureGeometryKHR geometry(vk::GeometryTypeKHR::eInstances);
    geometry.geometry.setInstances({VK_FALSE, input.address()});
    return build(device, LevelType::eTopLevel, geometry, 1, name + " (top)");
}

BoxHierarchy::BoxHierarchy(const Device& device, const std::span<const VkAabbPositionsKHR> boxes,
                           const std::string& name)
    : levels_(std::make_unique<Levels>(device, boxes, name)) {}

BoxHierarchy::~BoxHierarchy() = default;
BoxHierarchy::BoxHierarchy(BoxHierarchy&&) noexcept = default;
BoxHierarchy& BoxHierarchy::operator=(BoxHierarchy&&) noexcept = default;

uint64_t BoxHierarchy::size() const { return levels_->bottom.buffer.size() + levels_->top.buffer.size(); }

vk::AccelerationStructureKHR BoxHierarchy::handle() const { return *levels_->top.structure; }

} // namespace metamarch::vulkan

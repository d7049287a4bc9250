// SPDX-License-Identifier: MIT
// Declares those classes of Vulkan-Hpp that our headers name. Only the source files that call Vulkan include
// Vulkan-Hpp's own headers, which take a compiler 4 seconds.
#pragma once
#include <vulkan/vulkan_core.h>

namespace vk {
class AccelerationStructureKHR;
class Buffer;
class DescriptorSet;
class Pipeline;
class PipelineLayout;
class SystemError;
struct AccelerationStructureBuildGeometryInfoKHR;
struct PhysicalDeviceMemoryProperties;

namespace raii {
class CommandBuffer;
class CommandPool;
class Device;
class Instance;
class PhysicalDevice;
class Queue;
class SurfaceKHR;
} // namespace raii
} // namespace vk

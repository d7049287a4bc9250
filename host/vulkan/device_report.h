// What a device is, what of its limits we depend on, and why we refuse it.
#pragma once
#include "metamarch/vulkan/context.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace metamarch::vulkan {

// The best to run on first.
enum class DeviceType { discrete, integrated, virtualGpu, cpu, other };

// What a device is to be opened for. A window's device also draws and presents.
enum class DeviceUse { compute, window };

struct DeviceReport {
    uint32_t index = 0; // in the order of the loader
    std::string name;
    std::string driver;     // "llvmpipe"
    std::string driverInfo; // "Mesa 22.3.6 (LLVM 15.0.6)"
    uint32_t apiVersion = 0;
    DeviceType type = DeviceType::other;
    DeviceUse use = DeviceUse::compute; // that the queue family and the refusals are for

    std::optional<uint32_t> computeQueueFamily; // of a window's device it draws, too
    bool hasSwapchain = false;
    uint32_t timestampValidBits = 0; // of that family; 0: no timestamps, durations are wall-clock
    float timestampPeriod = 0;       // nanoseconds per tick

    uint64_t maxStorageBufferRange = 0;   // bytes one binding can see
    uint32_t maxTexelBufferElements = 0;  // texels one binding can see
    uint64_t maxMemoryAllocationSize = 0; // bytes of one buffer
    uint64_t deviceLocalHeapSize = 0;     // bytes of the largest device-local heap
    std::array<uint32_t, 3> maxComputeWorkGroupCount{};
    uint32_t maxComputeWorkGroupInvocations = 0;
    uint32_t maxComputeWorkGroupSizeX = 0;
    uint32_t maxPerStageDescriptorStorageBuffers = 0;
    uint32_t maxPushConstantsSize = 0; // bytes
    uint32_t subgroupSize = 0;         // invocations

    // Ray queries through the driver's own hierarchy (BoxHierarchy), which only some traversals want.
    std::vector<std::string> missingForRayQuery; // extensions and features; empty: it has ray queries
    uint64_t maxHierarchyBoxes = 0;              // where it has them
    uint32_t minScratchAlignment = 0;            // bytes, where it has them

    std::vector<std::string> refusals; // what we need and it lacks, in words; empty: usable

    bool usable() const { return refusals.empty(); }
    bool hasRayQuery() const { return missingForRayQuery.empty(); }
};

// What ray queries take: the extensions that a device is opened with where it has all of them.
inline constexpr std::array<const char*, 3> kRayQueryExtensions{
    VK_KHR_RAY_QUERY_EXTENSION_NAME, VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME,
    VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME};

// "discrete", "integrated", "virtual", "cpu", "other".
std::string typeText(DeviceType type);
// "1.3.230".
std::string versionText(uint32_t apiVersion);

// Everything but `refusals` decides: an empty list means the device can run us.
std::vector<std::string> refusalsOf(const DeviceReport& report);

// One report per device of the context, in its order.
std::vector<DeviceReport> reportDevices(const Context& context, DeviceUse use = DeviceUse::compute);

} // namespace metamarch::vulkan

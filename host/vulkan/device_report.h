// SPDX-License-Identifier: MIT
// The properties of a device, those of its limits that we depend on, and the reasons why we refuse it.
#pragma once
#include "metamarch/vulkan/context.h"
#include "metamarch/vulkan/exact_floats.h"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace metamarch::vulkan {

// The types are in order of preference.
enum class DeviceType { discrete, integrated, virtualGpu, cpu, other };

// Returns true if a queue of this family can present to the caller's window. This library knows no windows.
using PresentSupport = std::function<bool(VkPhysicalDevice device, uint32_t queueFamily)>;

struct DeviceReport {
    uint32_t index = 0; // in the loader's order
    std::string name;
    std::string driver;     // "llvmpipe"
    std::string driverInfo; // "Mesa 22.3.6 (LLVM 15.0.6)"
    uint32_t apiVersion = 0;
    DeviceType type = DeviceType::other;
    bool isForWindow = false; // whether computeQueueFamily and refusals are those for a window

    std::optional<uint32_t> computeQueueFamily; // for a window it also draws and presents
    bool hasSwapchain = false;
    uint32_t timestampValidBits = 0; // of that queue family; 0: no timestamps, durations are wall-clock times
    float timestampPeriod = 0;       // nanoseconds per tick

    uint64_t maxStorageBufferRange = 0;   // bytes that one binding can see
    uint32_t maxTexelBufferElements = 0;  // texels that one binding can see
    uint64_t maxMemoryAllocationSize = 0; // bytes of a single buffer
    uint64_t deviceLocalHeapSize = 0;     // bytes of the largest device-local heap
    bool hasMemoryBudget = false;         // VK_EXT_memory_budget
    std::array<uint32_t, 3> maxComputeWorkGroupCount{};
    uint32_t maxComputeWorkGroupInvocations = 0;
    uint32_t maxComputeWorkGroupSizeX = 0;
    uint32_t maxPerStageDescriptorStorageBuffers = 0;
    uint32_t maxPerStageDescriptorSampledImages = 0; // texel buffers count
    uint32_t maxPushConstantsSize = 0;               // bytes
    uint32_t subgroupSize = 0;                       // invocations
    FloatModes floatModes;                           // which of them the device offers
    bool failsWithFloatModes = false;                // kernels must do without them
    bool failsWithStorageBuffers = false;            // kernels must read the scene from texel buffers
    bool compilesBranchesSlowly = false;             // see withoutElseBranches and withInitializers

    // Ray queries through the driver's own hierarchy (BoxHierarchy); only some traversals need them.
    std::vector<std::string> missingForRayQuery; // extensions and features; empty: ray queries are available
    uint64_t maxHierarchyBoxes = 0;              // only if ray queries are available
    uint32_t minScratchAlignment = 0;            // bytes; only if ray queries are available

    std::vector<std::string> refusals; // what we need and the device lacks, in words; empty: usable

    bool usable() const { return refusals.empty(); }
    // Returns the driver's version with its name, or the name alone where the driver tells no more.
    const std::string& driverText() const { return driverInfo.empty() ? driver : driverInfo; }
    // Returns true for a software driver, which computes the CPU's bits. Others may divide within 2.5 units
    // in the last place (Vulkan 1.2, "Precision and Operation of SPIR-V Instructions").
    bool keepsBits() const { return type == DeviceType::cpu; }
    // Return true if every kernel fits that reads the scene through storage buffers, or any.
    bool runsWithStorageBuffers() const;
    bool runsEveryKernel() const;
    bool hasRayQuery() const { return missingForRayQuery.empty(); }
};

// The most descriptors of one kernel. Each kernel is there twice: one reads the scene through storage
// buffers, of which Vulkan guarantees fewer; the other through texel buffers, with no more storage buffers
// than Vulkan guarantees.
inline constexpr uint32_t kMostStorageBuffers = 34;
inline constexpr uint32_t kMostTexelBuffers = 19;
inline constexpr uint32_t kLeastStorageBuffers = 8;

// The extensions for ray queries. They are enabled if the device has all of them.
inline constexpr std::array<const char*, 3> kRayQueryExtensions{
    VK_KHR_RAY_QUERY_EXTENSION_NAME, VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME,
    VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME};

// Returns "discrete", "integrated", "virtual", "cpu" or "other".
std::string typeText(DeviceType type);
// Returns a text such as "1.3.230".
std::string versionText(uint32_t apiVersion);

// Derives the refusals from all other members. An empty list means that the device is usable.
std::vector<std::string> refusalsOf(const DeviceReport& report);

// Returns one report per device, in the context's order: for a window with `presents`, for computing alone
// without.
std::vector<DeviceReport> reportDevices(const Context& context, const PresentSupport& presents = {});

} // namespace metamarch::vulkan

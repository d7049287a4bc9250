// SPDX-License-Identifier: MIT
#include "metamarch/vulkan/device_report.h"

#include <fmt/format.h>
#include <vulkan/vulkan_raii.hpp>

#include <algorithm>
#include <cstring>

namespace metamarch::vulkan {
namespace {

// The limits that every kernel may rely on.
constexpr uint32_t kWorkGroupSize = 64;      // invocations, all along x
constexpr uint32_t kPushConstantBytes = 128; // the minimum that Vulkan guarantees

DeviceType typeOf(vk::PhysicalDeviceType type) {
    switch (type) {
    case vk::PhysicalDeviceType::eDiscreteGpu:
        return DeviceType::discrete;
    case vk::PhysicalDeviceType::eIntegratedGpu:
        return DeviceType::integrated;
    case vk::PhysicalDeviceType::eVirtualGpu:
        return DeviceType::virtualGpu;
    case vk::PhysicalDeviceType::eCpu:
        return DeviceType::cpu;
    default:
        return DeviceType::other;
    }
}

void addLimits(DeviceReport& report, const vk::PhysicalDeviceLimits& limits) {
    report.timestampPeriod = limits.timestampPeriod;
    report.maxStorageBufferRange = limits.maxStorageBufferRange;
    report.maxTexelBufferElements = limits.maxTexelBufferElements;
    report.maxComputeWorkGroupCount = limits.maxComputeWorkGroupCount;
    report.maxComputeWorkGroupInvocations = limits.maxComputeWorkGroupInvocations;
    report.maxComputeWorkGroupSizeX = limits.maxComputeWorkGroupSize[0];
    report.maxPerStageDescriptorStorageBuffers = limits.maxPerStageDescriptorStorageBuffers;
    report.maxPerStageDescriptorSampledImages = limits.maxPerStageDescriptorSampledImages;
    report.maxPushConstantsSize = limits.maxPushConstantsSize;
}

// Prefers, without a window, a family without graphics: on GPUs that have one, its work runs beside that of
// the desktop.
void addQueueFamily(DeviceReport& report, const vk::raii::PhysicalDevice& physicalDevice,
                    const PresentSupport& presents) {
    const auto families = physicalDevice.getQueueFamilyProperties();
    for (uint32_t family = 0; family < families.size(); ++family) {
        const vk::QueueFlags flags = families[family].queueFlags;
        if (!(flags & vk::QueueFlagBits::eCompute)) {
            continue;
        }
        const bool computeOnly = !(flags & vk::QueueFlagBits::eGraphics);
        if (report.isForWindow && (computeOnly || !presents(*physicalDevice, family))) {
            continue;
        }
        if (computeOnly || !report.computeQueueFamily) {
            report.computeQueueFamily = family;
            report.timestampValidBits = families[family].timestampValidBits;
        }
        if (computeOnly) {
            return;
        }
    }
}

void addHeap(DeviceReport& report, const vk::raii::PhysicalDevice& physicalDevice) {
    const auto memory = physicalDevice.getMemoryProperties();
    for (uint32_t heap = 0; heap < memory.memoryHeapCount; ++heap) {
        if (memory.memoryHeaps[heap].flags & vk::MemoryHeapFlagBits::eDeviceLocal) {
            report.deviceLocalHeapSize = std::max(report.deviceLocalHeapSize, memory.memoryHeaps[heap].size);
        }
    }
}

// Only a Vulkan 1.2 device has these properties.
void addVersion12Properties(DeviceReport& report, const vk::raii::PhysicalDevice& physicalDevice) {
    const auto chain =
        physicalDevice
            .getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceMaintenance3Properties,
                            vk::PhysicalDeviceSubgroupProperties, vk::PhysicalDeviceDriverProperties,
                            vk::PhysicalDeviceFloatControlsProperties>();
    const auto& driver = chain.get<vk::PhysicalDeviceDriverProperties>();
    report.driver = driver.driverName.data();
    report.driverInfo = driver.driverInfo.data();
    const bool isSwiftShader = driver.driverID == vk::DriverId::eGoogleSwiftshader;
    report.compilesBranchesSlowly = isSwiftShader;
    // It keeps the CPU's bits without modes. With one it forgets the stack of kd_short_stack.
    report.failsWithFloatModes = isSwiftShader;
    // Lanes that have left a loop lose what they have loaded in it (shaders/MEASURED.md).
    report.failsWithStorageBuffers = isSwiftShader;
    report.subgroupSize = chain.get<vk::PhysicalDeviceSubgroupProperties>().subgroupSize;
    report.maxMemoryAllocationSize =
        chain.get<vk::PhysicalDeviceMaintenance3Properties>().maxMemoryAllocationSize;
    const auto& floats = chain.get<vk::PhysicalDeviceFloatControlsProperties>();
    // Where all widths must round alike, a mode for 32 bits alone is not allowed.
    const bool isChosenAlone = floats.roundingModeIndependence != vk::ShaderFloatControlsIndependence::eNone;
    report.floatModes = {isChosenAlone && floats.shaderRoundingModeRTEFloat32,
                         static_cast<bool>(floats.shaderSignedZeroInfNanPreserveFloat32)};
}

bool lists(const std::vector<vk::ExtensionProperties>& extensions, const char* const wanted) {
    return std::ranges::any_of(extensions, [&](const vk::ExtensionProperties& extension) {
        return std::strcmp(extension.extensionName, wanted) == 0;
    });
}

// Check the extensions first: only a device that lists them may be asked for their features and properties.
void addRayQuery(DeviceReport& report, const vk::raii::PhysicalDevice& physicalDevice) {
    const auto extensions = physicalDevice.enumerateDeviceExtensionProperties();
    for (const char* const wanted : kRayQueryExtensions) {
        if (!lists(extensions, wanted)) {
            report.missingForRayQuery.emplace_back(wanted);
        }
    }
    if (report.apiVersion < kApiVersion || !report.hasRayQuery()) {
        return;
    }
    const auto features =
        physicalDevice.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceRayQueryFeaturesKHR,
                                    vk::PhysicalDeviceAccelerationStructureFeaturesKHR,
                                    vk::PhysicalDeviceBufferDeviceAddressFeatures>();
    const auto require = [&](const vk::Bool32 has, const char* const feature) {
        if (!has) {
            report.missingForRayQuery.emplace_back(feature);
        }
    };
    require(features.get<vk::PhysicalDeviceRayQueryFeaturesKHR>().rayQuery, "rayQuery");
    require(features.get<vk::PhysicalDeviceAccelerationStructureFeaturesKHR>().accelerationStructure,
            "accelerationStructure");
    require(features.get<vk::PhysicalDeviceBufferDeviceAddressFeatures>().bufferDeviceAddress,
            "bufferDeviceAddress");
    const auto properties =
        physicalDevice.getProperties2<vk::PhysicalDeviceProperties2,
                                      vk::PhysicalDeviceAccelerationStructurePropertiesKHR>();
    const auto& limits = properties.get<vk::PhysicalDeviceAccelerationStructurePropertiesKHR>();
    report.maxHierarchyBoxes = limits.maxPrimitiveCount;
    report.minScratchAlignment = limits.minAccelerationStructureScratchOffsetAlignment;
}

DeviceReport reportDevice(const vk::raii::PhysicalDevice& physicalDevice, const uint32_t index,
                          const PresentSupport& presents) {
    const vk::PhysicalDeviceProperties properties = physicalDevice.getProperties();
    DeviceReport report;
    report.index = index;
    report.isForWindow = presents != nullptr;
    report.name = properties.deviceName.data();
    report.apiVersion = properties.apiVersion;
    report.type = typeOf(properties.deviceType);
    addLimits(report, properties.limits);
    addQueueFamily(report, physicalDevice, presents);
    addHeap(report, physicalDevice);
    if (properties.apiVersion >= kApiVersion) {
        addVersion12Properties(report, physicalDevice);
    }
    addRayQuery(report, physicalDevice);
    const auto extensions = physicalDevice.enumerateDeviceExtensionProperties();
    report.hasSwapchain = lists(extensions, VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    report.hasMemoryBudget = lists(extensions, VK_EXT_MEMORY_BUDGET_EXTENSION_NAME);
    report.refusals = refusalsOf(report);
    return report;
}

} // namespace

std::string typeText(DeviceType type) {
    switch (type) {
    case DeviceType::discrete:
        return "discrete";
    case DeviceType::integrated:
        return "integrated";
    case DeviceType::virtualGpu:
        return "virtual";
    case DeviceType::cpu:
        return "cpu";
    case DeviceType::other:
        break;
    }
    return "other";
}

std::string versionText(uint32_t apiVersion) {
    return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(apiVersion), VK_API_VERSION_MINOR(apiVersion),
                       VK_API_VERSION_PATCH(apiVersion));
}

bool DeviceReport::runsWithStorageBuffers() const {
    return !failsWithStorageBuffers && maxPerStageDescriptorStorageBuffers >= kMostStorageBuffers;
}

bool DeviceReport::runsEveryKernel() const {
    return runsWithStorageBuffers() || maxPerStageDescriptorSampledImages >= kMostTexelBuffers;
}

std::vector<std::string> refusalsOf(const DeviceReport& report) {
    std::vector<std::string> refusals;
    const auto require = [&refusals](const char* limit, uint32_t has, uint32_t needs) {
        if (has < needs) {
            refusals.push_back(fmt::format("{} {}, needs {}", limit, has, needs));
        }
    };
    if (report.apiVersion < kApiVersion) {
        refusals.push_back(fmt::format("Vulkan {}.{}, needs {}.{}", VK_API_VERSION_MAJOR(report.apiVersion),
                                       VK_API_VERSION_MINOR(report.apiVersion),
                                       VK_API_VERSION_MAJOR(kApiVersion), VK_API_VERSION_MINOR(kApiVersion)));
    }
    if (!report.computeQueueFamily) {
        refusals.emplace_back(report.isForWindow ? "no queue that computes, draws and presents to this window"
                                                 : "no compute queue");
    }
    if (report.isForWindow && !report.hasSwapchain) {
        refusals.emplace_back("no VK_KHR_swapchain, which a window takes");
    }
    require("maxComputeWorkGroupInvocations", report.maxComputeWorkGroupInvocations, kWorkGroupSize);
    require("maxComputeWorkGroupSize[0]", report.maxComputeWorkGroupSizeX, kWorkGroupSize);
    require("maxPerStageDescriptorStorageBuffers", report.maxPerStageDescriptorStorageBuffers,
            kLeastStorageBuffers);
    require("maxPushConstantsSize", report.maxPushConstantsSize, kPushConstantBytes);
    return refusals;
}

std::vector<DeviceReport> reportDevices(const Context& context, const PresentSupport& presents) {
    std::vector<DeviceReport> reports;
    for (const vk::raii::PhysicalDevice& physicalDevice : context.physicalDevices()) {
        reports.push_back(reportDevice(physicalDevice, static_cast<uint32_t>(reports.size()), presents));
    }
    return reports;
}

} // namespace metamarch::vulkan

// SPDX-License-Identifier: MIT
// A Vulkan layer that makes a device worse than it is: smaller limits, other clocks, memory that runs out, a
// device that is lost, windows that change. Tests enable it by VK_INSTANCE_LAYERS=VK_LAYER_METAMARCH_faults
// and say what goes wrong by METAMARCH_FAULTS, a list such as "storageBuffers=8,lostAt=3". An unknown word
// ends the process, so that no test passes because of a typing error.
#include "rough_division.h"

#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

#include <algorithm>
#include <atomic>
#include <cfenv>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace {

// ---------------------------------------------------------------- the faults

constexpr const char* kFaults[] = {
    "storageBuffers",    // maxPerStageDescriptorStorageBuffers
    "sampledImages",     // maxPerStageDescriptorSampledImages, which texel buffers count to
    "storageRange",      // maxStorageBufferRange, bytes
    "texels",            // maxTexelBufferElements
    "workGroups",        // maxComputeWorkGroupCount of each dimension
    "allocation",        // maxMemoryAllocationSize, bytes
    "driver",            // driverID, a number of VkDriverId
    "deviceHeap",        // device-local memory has only so many bytes; host memory lies beside it
    "timestampBits",     // timestampValidBits of every queue family
    "stampsAreEqual",    // 1: all time stamps of a pool are the same
    "stampsWrap",        // 1: the counter passes 2^timestampBits between two stamps
    "lostAt",            // the device is lost at this submission, counted from 1
    "groupMicroseconds", // each workgroup takes so long, and a submission of more than 2 s loses the device
    "fragmentedAbove",   // allocations of more bytes fail
    "memoryEndsAt",      // this allocation and all after it fail, counted from 1
    "acquireTimesOut",   // every nth image of a window comes too late
    "acquireOutOfDate",  // every nth image is of a window that has changed
    "suboptimal",        // 1: every image is shown, but no longer fits
    "noSizeUntil",       // a window has no size at the questions for it from the 3rd to this one
    "tenBitOnly",        // 1: windows take only 10 bits a colour
    "noOpaqueAlpha",     // 1: windows show what lies behind them
    "roughDivision",     // 1: quotients are off by up to 2 ulp, and the device says that it is a discrete one
    "truncation",        // 1: floats are rounded to zero, and the device says that it is a discrete one
};

const std::map<std::string, std::uint64_t>& faults() {
    static const std::map<std::string, std::uint64_t> all = [] {
        std::map<std::string, std::uint64_t> parsed;
        const char* const text = std::getenv("METAMARCH_FAULTS");
        std::istringstream words(text == nullptr ? "" : text);
        for (std::string word; std::getline(words, word, ',');) {
            const std::size_t equals = word.find('=');
            const std::string name = word.substr(0, equals);
            if (equals == std::string::npos ||
                std::ranges::none_of(kFaults, [&](const char* known) { return name == known; })) {
                std::fprintf(stderr, "METAMARCH_FAULTS: unknown fault %s\n", word.c_str());
                std::abort();
            }
            parsed[name] = std::stoull(word.substr(equals + 1));
        }
        return parsed;
    }();
    return all;
}

bool has(const char* const fault) { return faults().contains(fault); }
std::uint64_t valueOf(const char* const fault) { return has(fault) ? faults().at(fault) : 0; }

template <class T>
void limit(const char* const fault, T& value) {
    if (has(fault)) {
        value = static_cast<T>(valueOf(fault));
    }
}

// Returns true for every nth call.
bool isNth(std::atomic<std::uint64_t>& calls, const char* const fault) {
    const std::uint64_t n = valueOf(fault);
    return n > 0 && ++calls % n == 0;
}

std::atomic<bool> isLost = false;

// ---------------------------------------------------------------- what lies below this layer

// Handles of one instance or device, and of what belongs to it, begin with the same pointer.
void* keyOf(const void* const handle) { return *static_cast<void* const*>(handle); }

// The functions of which this layer has its own.
constexpr const char* kOfInstances[] = {"vkGetPhysicalDeviceProperties",
                                        "vkGetPhysicalDeviceProperties2",
                                        "vkGetPhysicalDeviceQueueFamilyProperties",
                                        "vkGetPhysicalDeviceMemoryProperties",
                                        "vkGetPhysicalDeviceMemoryProperties2",
                                        "vkGetPhysicalDeviceSurfaceFormatsKHR",
                                        "vkGetPhysicalDeviceSurfaceCapabilitiesKHR"};
constexpr const char* kOfDevices[] = {
    "vkCreateShaderModule", "vkAllocateMemory", "vkFreeMemory",          "vkGetBufferMemoryRequirements",
    "vkBeginCommandBuffer", "vkCmdDispatch",    "vkQueueSubmit",         "vkWaitForFences",
    "vkDeviceWaitIdle",     "vkQueueWaitIdle",  "vkGetQueryPoolResults", "vkCreateSwapchainKHR",
    "vkAcquireNextImageKHR"};

// What lies below an instance or a device. The functions are asked for while it is made: later the loader may
// answer with those of the topmost layer.
struct Below {
    VkInstance instance = VK_NULL_HANDLE; // of an instance
    PFN_vkGetInstanceProcAddr instanceAddress = nullptr;
    PFN_vkGetDeviceProcAddr deviceAddress = nullptr; // of a device
    std::map<std::string, PFN_vkVoidFunction> functions;
};

std::mutex belowLock;
std::map<void*, Below> belows;

Below below(const void* const handle) {
    const std::lock_guard lock(belowLock);
    return belows.at(keyOf(handle));
}

template <class Function>
Function next(const void* const handle, const char* const name) {
    return reinterpret_cast<Function>(below(handle).functions.at(name));
}

// The link of the chain that the loader gives to this layer.
template <class Link, class Info>
Link* linkOf(const Info* const info, const VkStructureType type) {
    auto* link = static_cast<Link*>(const_cast<void*>(info->pNext));
    while (link != nullptr && !(link->sType == type && link->function == VK_LAYER_LINK_INFO)) {
        link = static_cast<Link*>(const_cast<void*>(link->pNext));
    }
    return link;
}

VKAPI_ATTR VkResult VKAPI_CALL createInstance(const VkInstanceCreateInfo* const info,
                                              const VkAllocationCallbacks* const memory,
                                              VkInstance* const instance) {
    auto* const link = linkOf<VkLayerInstanceCreateInfo>(info, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
    const PFN_vkGetInstanceProcAddr address = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const auto create = reinterpret_cast<PFN_vkCreateInstance>(address(VK_NULL_HANDLE, "vkCreateInstance"));
    const VkResult result = create(info, memory, instance);
    if (result == VK_SUCCESS) {
        Below made{.instance = *instance, .instanceAddress = address, .functions = {}};
        for (const char* const name : kOfInstances) {
            made.functions[name] = address(*instance, name);
        }
        const std::lock_guard lock(belowLock);
        belows[keyOf(*instance)] = made;
    }
    return result;
}

// With the fault truncation the calling thread rounds to zero while this lives. A thread that begins
// meanwhile inherits that for good, and lavapipe begins the threads that run its kernels with the device.
class RoundsToZero {
  public:
    RoundsToZero() {
        if (has("truncation")) {
            std::fesetround(FE_TOWARDZERO);
        }
    }
    ~RoundsToZero() { std::fesetround(before); }
    RoundsToZero(const RoundsToZero&) = delete;
    RoundsToZero& operator=(const RoundsToZero&) = delete;

  private:
    int before = std::fegetround();
};

VKAPI_ATTR VkResult VKAPI_CALL createDevice(const VkPhysicalDevice physical,
                                            const VkDeviceCreateInfo* const info,
                                            const VkAllocationCallbacks* const memory,
                                            VkDevice* const device) {
    auto* const link = linkOf<VkLayerDeviceCreateInfo>(info, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
    const PFN_vkGetInstanceProcAddr address = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    const PFN_vkGetDeviceProcAddr nextOfDevices = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const auto create =
        reinterpret_cast<PFN_vkCreateDevice>(address(below(physical).instance, "vkCreateDevice"));
    const VkResult result = [&] {
        const RoundsToZero truncated;
        return create(physical, info, memory, device);
    }();
    if (result == VK_SUCCESS) {
        Below made{.deviceAddress = nextOfDevices, .functions = {}};
        for (const char* const name : kOfDevices) {
            made.functions[name] = nextOfDevices(*device, name);
        }
        const std::lock_guard lock(belowLock);
        belows[keyOf(*device)] = made;
    }
    return result;
}

// ---------------------------------------------------------------- properties

void worsen(VkPhysicalDeviceProperties& properties) {
    if (has("roughDivision") || has("truncation")) { // a CPU keeps bits
        properties.deviceType = VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU;
    }
    VkPhysicalDeviceLimits& limits = properties.limits;
    limit("storageBuffers", limits.maxPerStageDescriptorStorageBuffers);
    limit("storageBuffers", limits.maxDescriptorSetStorageBuffers);
    limit("sampledImages", limits.maxPerStageDescriptorSampledImages);
    limit("storageRange", limits.maxStorageBufferRange);
    limit("texels", limits.maxTexelBufferElements);
    for (std::uint32_t& count : limits.maxComputeWorkGroupCount) {
        limit("workGroups", count);
    }
}

VKAPI_ATTR void VKAPI_CALL getProperties(const VkPhysicalDevice physical,
                                         VkPhysicalDeviceProperties* const properties) {
    next<PFN_vkGetPhysicalDeviceProperties>(physical, "vkGetPhysicalDeviceProperties")(physical, properties);
    worsen(*properties);
}

VKAPI_ATTR void VKAPI_CALL getProperties2(const VkPhysicalDevice physical,
                                          VkPhysicalDeviceProperties2* const properties) {
    next<PFN_vkGetPhysicalDeviceProperties2>(physical, "vkGetPhysicalDeviceProperties2")(physical,
                                                                                         properties);
    worsen(properties->properties);
    for (auto* part = static_cast<VkBaseOutStructure*>(properties->pNext); part != nullptr;
         part = part->pNext) {
        if (part->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES) {
            limit("allocation",
                  reinterpret_cast<VkPhysicalDeviceMaintenance3Properties*>(part)->maxMemoryAllocationSize);
        } else if (part->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES) {
            limit("allocation",
                  reinterpret_cast<VkPhysicalDeviceVulkan11Properties*>(part)->maxMemoryAllocationSize);
        } else if (part->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES) {
            limit("driver", reinterpret_cast<VkPhysicalDeviceDriverProperties*>(part)->driverID);
        } else if (part->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FLOAT_CONTROLS_PROPERTIES &&
                   has("truncation")) {
            reinterpret_cast<VkPhysicalDeviceFloatControlsProperties*>(part)->shaderRoundingModeRTEFloat32 =
                VK_FALSE;
        }
    }
}

VKAPI_ATTR void VKAPI_CALL getQueueFamilies(const VkPhysicalDevice physical, std::uint32_t* const count,
                                            VkQueueFamilyProperties* const families) {
    next<PFN_vkGetPhysicalDeviceQueueFamilyProperties>(physical, "vkGetPhysicalDeviceQueueFamilyProperties")(
        physical, count, families);
    for (std::uint32_t i = 0; families != nullptr && i < *count; ++i) {
        limit("timestampBits", families[i].timestampValidBits);
    }
}

// ---------------------------------------------------------------- a device with little memory

// With the fault deviceHeap a device has two types of memory in place of its own first one: local memory, and
// host memory with the rest of the heap. Both are allocated from the first type.
constexpr std::uint32_t kLocal = 0;
constexpr std::uint32_t kHost = 1;

struct LocalMemory {
    std::mutex lock;
    std::map<VkDeviceMemory, VkDeviceSize> allocations;
    VkDeviceSize used = 0;
};

LocalMemory& localMemory() {
    static LocalMemory memory;
    return memory;
}

void divide(VkPhysicalDeviceMemoryProperties& memory) {
    if (!has("deviceHeap")) {
        return;
    }
    const VkMemoryHeap whole = memory.memoryHeaps[memory.memoryTypes[0].heapIndex];
    memory = {};
    memory.memoryTypeCount = 2;
    memory.memoryTypes[kLocal] = {VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, kLocal};
    memory.memoryTypes[kHost] = {VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT |
                                     VK_MEMORY_PROPERTY_HOST_CACHED_BIT,
                                 kHost};
    memory.memoryHeapCount = 2;
    memory.memoryHeaps[kLocal] = {valueOf("deviceHeap"), VK_MEMORY_HEAP_DEVICE_LOCAL_BIT};
    memory.memoryHeaps[kHost] = {whole.size, 0};
}

VKAPI_ATTR void VKAPI_CALL getMemory(const VkPhysicalDevice physical,
                                     VkPhysicalDeviceMemoryProperties* const memory) {
    next<PFN_vkGetPhysicalDeviceMemoryProperties>(physical, "vkGetPhysicalDeviceMemoryProperties")(physical,
                                                                                                   memory);
    divide(*memory);
}

VKAPI_ATTR void VKAPI_CALL getMemory2(const VkPhysicalDevice physical,
                                      VkPhysicalDeviceMemoryProperties2* const memory) {
    next<PFN_vkGetPhysicalDeviceMemoryProperties2>(physical, "vkGetPhysicalDeviceMemoryProperties2")(physical,
                                                                                                     memory);
    divide(memory->memoryProperties);
    for (auto* part = static_cast<VkBaseOutStructure*>(memory->pNext); part != nullptr; part = part->pNext) {
        if (has("deviceHeap") &&
            part->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_BUDGET_PROPERTIES_EXT) {
            auto* const budget = reinterpret_cast<VkPhysicalDeviceMemoryBudgetPropertiesEXT*>(part);
            const std::lock_guard lock(localMemory().lock);
            budget->heapBudget[kLocal] = valueOf("deviceHeap");
            budget->heapUsage[kLocal] = localMemory().used;
        }
    }
}

VKAPI_ATTR void VKAPI_CALL getRequirements(const VkDevice device, const VkBuffer buffer,
                                           VkMemoryRequirements* const requirements) {
    next<PFN_vkGetBufferMemoryRequirements>(device, "vkGetBufferMemoryRequirements")(device, buffer,
                                                                                     requirements);
    if (has("deviceHeap")) {
        requirements->memoryTypeBits = 1u << kLocal | 1u << kHost;
    }
}

VkResult allocateDivided(const VkDevice device, VkMemoryAllocateInfo info,
                         const VkAllocationCallbacks* const memory, VkDeviceMemory* const allocated) {
    LocalMemory& local = localMemory();
    const std::lock_guard lock(local.lock);
    const bool isLocal = info.memoryTypeIndex == kLocal;
    if (isLocal && local.used + info.allocationSize > valueOf("deviceHeap")) {
        return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    }
    info.memoryTypeIndex = 0;
    const VkResult result =
        next<PFN_vkAllocateMemory>(device, "vkAllocateMemory")(device, &info, memory, allocated);
    if (isLocal && result == VK_SUCCESS) {
        local.allocations[*allocated] = info.allocationSize;
        local.used += info.allocationSize;
    }
    return result;
}

VKAPI_ATTR void VKAPI_CALL freeMemory(const VkDevice device, const VkDeviceMemory freed,
                                      const VkAllocationCallbacks* const memory) {
    next<PFN_vkFreeMemory>(device, "vkFreeMemory")(device, freed, memory);
    LocalMemory& local = localMemory();
    const std::lock_guard lock(local.lock);
    if (const auto found = local.allocations.find(freed); found != local.allocations.end()) {
        local.used -= found->second;
        local.allocations.erase(found);
    }
}

// ---------------------------------------------------------------- divisions

VKAPI_ATTR VkResult VKAPI_CALL createShaderModule(const VkDevice device,
                                                  const VkShaderModuleCreateInfo* const info,
                                                  const VkAllocationCallbacks* const memory,
                                                  VkShaderModule* const module) {
    const auto create = next<PFN_vkCreateShaderModule>(device, "vkCreateShaderModule");
    if (!has("roughDivision")) {
        return create(device, info, memory, module);
    }
    const std::vector<std::uint32_t> rough =
        withRoughDivision({info->pCode, info->pCode + info->codeSize / sizeof(std::uint32_t)});
    VkShaderModuleCreateInfo changed = *info;
    changed.codeSize = rough.size() * sizeof(std::uint32_t);
    changed.pCode = rough.data();
    return create(device, &changed, memory, module);
}

// ---------------------------------------------------------------- memory, clocks, lost devices

VKAPI_ATTR VkResult VKAPI_CALL allocateMemory(const VkDevice device, const VkMemoryAllocateInfo* const info,
                                              const VkAllocationCallbacks* const memory,
                                              VkDeviceMemory* const allocated) {
    static std::atomic<std::uint64_t> allocations = 0;
    if (has("memoryEndsAt") && ++allocations >= valueOf("memoryEndsAt")) {
        return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    }
    if (has("fragmentedAbove") && info->allocationSize > valueOf("fragmentedAbove")) {
        return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    }
    if (has("deviceHeap")) {
        return allocateDivided(device, *info, memory, allocated);
    }
    return next<PFN_vkAllocateMemory>(device, "vkAllocateMemory")(device, info, memory, allocated);
}

// A device with watchdog, on which time depends on nothing but workgroups.
struct SlowDevice {
    static constexpr std::uint64_t kWatchdogMicroseconds = 2'000'000;

    std::mutex lock;
    std::map<VkCommandBuffer, std::uint64_t> groups;
    std::uint64_t lastMicroseconds = 0; // of the last submission
};

SlowDevice& slowDevice() {
    static SlowDevice device;
    return device;
}

VKAPI_ATTR VkResult VKAPI_CALL beginCommandBuffer(const VkCommandBuffer commands,
                                                  const VkCommandBufferBeginInfo* const info) {
    {
        const std::lock_guard lock(slowDevice().lock);
        slowDevice().groups[commands] = 0;
    }
    return next<PFN_vkBeginCommandBuffer>(commands, "vkBeginCommandBuffer")(commands, info);
}

VKAPI_ATTR void VKAPI_CALL dispatch(const VkCommandBuffer commands, const std::uint32_t x,
                                    const std::uint32_t y, const std::uint32_t z) {
    {
        const std::lock_guard lock(slowDevice().lock);
        slowDevice().groups[commands] += std::uint64_t{x} * y * z;
    }
    next<PFN_vkCmdDispatch>(commands, "vkCmdDispatch")(commands, x, y, z);
}

// Sleeps as long as the submission takes on the slow device, or loses that.
void runSlowly(const std::uint32_t count, const VkSubmitInfo* const submits) {
    SlowDevice& device = slowDevice();
    const std::lock_guard lock(device.lock);
    device.lastMicroseconds = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        for (std::uint32_t k = 0; k < submits[i].commandBufferCount; ++k) {
            device.lastMicroseconds +=
                device.groups[submits[i].pCommandBuffers[k]] * valueOf("groupMicroseconds");
        }
    }
    if (device.lastMicroseconds > SlowDevice::kWatchdogMicroseconds) {
        isLost = true;
    } else {
        std::this_thread::sleep_for(std::chrono::microseconds(device.lastMicroseconds));
    }
}

VKAPI_ATTR VkResult VKAPI_CALL queueSubmit(const VkQueue queue, const std::uint32_t count,
                                           const VkSubmitInfo* const submits, const VkFence fence) {
    static std::atomic<std::uint64_t> submissions = 0;
    if (has("groupMicroseconds")) {
        runSlowly(count, submits);
    }
    if (has("lostAt") && ++submissions >= valueOf("lostAt")) {
        isLost = true;
    }
    return isLost ? VK_ERROR_DEVICE_LOST
                  : next<PFN_vkQueueSubmit>(queue, "vkQueueSubmit")(queue, count, submits, fence);
}

VKAPI_ATTR VkResult VKAPI_CALL waitForFences(const VkDevice device, const std::uint32_t count,
                                             const VkFence* const fences, const VkBool32 all,
                                             const std::uint64_t nanoseconds) {
    return isLost ? VK_ERROR_DEVICE_LOST
                  : next<PFN_vkWaitForFences>(device, "vkWaitForFences")(device, count, fences, all,
                                                                         nanoseconds);
}

VKAPI_ATTR VkResult VKAPI_CALL deviceWaitIdle(const VkDevice device) {
    const VkResult result = next<PFN_vkDeviceWaitIdle>(device, "vkDeviceWaitIdle")(device);
    return isLost ? VK_ERROR_DEVICE_LOST : result;
}

VKAPI_ATTR VkResult VKAPI_CALL queueWaitIdle(const VkQueue queue) {
    const VkResult result = next<PFN_vkQueueWaitIdle>(queue, "vkQueueWaitIdle")(queue);
    return isLost ? VK_ERROR_DEVICE_LOST : result;
}

// The program reads the two 64-bit stamps of a submission.
VKAPI_ATTR VkResult VKAPI_CALL getQueryPoolResults(const VkDevice device, const VkQueryPool pool,
                                                   const std::uint32_t first, const std::uint32_t count,
                                                   const std::size_t size, void* const data,
                                                   const VkDeviceSize stride,
                                                   const VkQueryResultFlags flags) {
    const VkResult result = next<PFN_vkGetQueryPoolResults>(device, "vkGetQueryPoolResults")(
        device, pool, first, count, size, data, stride, flags);
    if (result != VK_SUCCESS || count != 2 || size < 2 * sizeof(std::uint64_t) ||
        stride != sizeof(std::uint64_t)) {
        return result;
    }
    std::uint64_t stamps[2];
    std::memcpy(stamps, data, sizeof(stamps));
    if (has("groupMicroseconds")) { // a tick of lavapipe is a nanosecond
        const std::lock_guard lock(slowDevice().lock);
        stamps[1] += slowDevice().lastMicroseconds * 1000;
    }
    if (has("stampsAreEqual")) {
        stamps[1] = stamps[0];
    } else if (has("stampsWrap")) {
        const std::uint64_t mask = (std::uint64_t{1} << valueOf("timestampBits")) - 1;
        stamps[1] = (stamps[1] - stamps[0] - 1) & mask;
        stamps[0] = mask; // the last value before 0
    }
    std::memcpy(data, stamps, sizeof(stamps));
    return result;
}

// ---------------------------------------------------------------- windows

VKAPI_ATTR VkResult VKAPI_CALL acquireNextImage(const VkDevice device, const VkSwapchainKHR chain,
                                                const std::uint64_t nanoseconds, const VkSemaphore semaphore,
                                                const VkFence fence, std::uint32_t* const image) {
    static std::atomic<std::uint64_t> late = 0;
    static std::atomic<std::uint64_t> outdated = 0;
    if (isNth(late, "acquireTimesOut")) {
        return VK_TIMEOUT;
    }
    if (isNth(outdated, "acquireOutOfDate")) {
        return VK_ERROR_OUT_OF_DATE_KHR;
    }
    const VkResult result = next<PFN_vkAcquireNextImageKHR>(device, "vkAcquireNextImageKHR")(
        device, chain, nanoseconds, semaphore, fence, image);
    return result == VK_SUCCESS && has("suboptimal") ? VK_SUBOPTIMAL_KHR : result;
}

// With the fault noOpaqueAlpha the driver gets what every driver has: SwiftShader's windows take nothing
// else.
VKAPI_ATTR VkResult VKAPI_CALL createSwapchain(const VkDevice device,
                                               const VkSwapchainCreateInfoKHR* const info,
                                               const VkAllocationCallbacks* const memory,
                                               VkSwapchainKHR* const chain) {
    VkSwapchainCreateInfoKHR asked = *info;
    if (has("noOpaqueAlpha")) {
        if (asked.compositeAlpha != VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR) {
            return VK_ERROR_INITIALIZATION_FAILED;
        }
        asked.compositeAlpha = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR;
    }
    return next<PFN_vkCreateSwapchainKHR>(device, "vkCreateSwapchainKHR")(device, &asked, memory, chain);
}

VKAPI_ATTR VkResult VKAPI_CALL getSurfaceFormats(const VkPhysicalDevice physical, const VkSurfaceKHR surface,
                                                 std::uint32_t* const count,
                                                 VkSurfaceFormatKHR* const formats) {
    if (!has("tenBitOnly")) {
        return next<PFN_vkGetPhysicalDeviceSurfaceFormatsKHR>(
            physical, "vkGetPhysicalDeviceSurfaceFormatsKHR")(physical, surface, count, formats);
    }
    if (formats != nullptr && *count > 0) {
        formats[0] = {VK_FORMAT_A2B10G10R10_UNORM_PACK32, VK_COLOR_SPACE_SRGB_NONLINEAR_KHR};
    }
    *count = 1;
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL getSurfaceCapabilities(const VkPhysicalDevice physical,
                                                      const VkSurfaceKHR surface,
                                                      VkSurfaceCapabilitiesKHR* const capabilities) {
    const VkResult result = next<PFN_vkGetPhysicalDeviceSurfaceCapabilitiesKHR>(
        physical, "vkGetPhysicalDeviceSurfaceCapabilitiesKHR")(physical, surface, capabilities);
    static std::atomic<std::uint64_t> questions = 0;
    const std::uint64_t question = ++questions;
    if (question >= 3 && question <= valueOf("noSizeUntil")) {
        capabilities->currentExtent = {0, 0};
    }
    if (has("noOpaqueAlpha")) {
        capabilities->supportedCompositeAlpha = VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR;
    }
    return result;
}

// ---------------------------------------------------------------- how the loader finds all that

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL instanceAddress(VkInstance instance, const char* name);
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL deviceAddress(VkDevice device, const char* name);

struct Entry {
    const char* name;
    PFN_vkVoidFunction function;
};

template <class Function>
Entry entry(const char* const name, Function* const function) {
    return {name, reinterpret_cast<PFN_vkVoidFunction>(function)};
}

PFN_vkVoidFunction find(const char* const name, const bool isOfDevices) {
    static const Entry ofInstances[] = {
        entry("vkGetInstanceProcAddr", instanceAddress),
        entry("vkCreateInstance", createInstance),
        entry("vkCreateDevice", createDevice),
        entry("vkGetPhysicalDeviceProperties", getProperties),
        entry("vkGetPhysicalDeviceProperties2", getProperties2),
        entry("vkGetPhysicalDeviceQueueFamilyProperties", getQueueFamilies),
        entry("vkGetPhysicalDeviceMemoryProperties", getMemory),
        entry("vkGetPhysicalDeviceMemoryProperties2", getMemory2),
        entry("vkGetPhysicalDeviceSurfaceFormatsKHR", getSurfaceFormats),
        entry("vkGetPhysicalDeviceSurfaceCapabilitiesKHR", getSurfaceCapabilities),
    };
    static const Entry ofDevices[] = {
        entry("vkGetDeviceProcAddr", deviceAddress),
        entry("vkCreateShaderModule", createShaderModule),
        entry("vkAllocateMemory", allocateMemory),
        entry("vkFreeMemory", freeMemory),
        entry("vkGetBufferMemoryRequirements", getRequirements),
        entry("vkBeginCommandBuffer", beginCommandBuffer),
        entry("vkCmdDispatch", dispatch),
        entry("vkQueueSubmit", queueSubmit),
        entry("vkWaitForFences", waitForFences),
        entry("vkDeviceWaitIdle", deviceWaitIdle),
        entry("vkQueueWaitIdle", queueWaitIdle),
        entry("vkGetQueryPoolResults", getQueryPoolResults),
        entry("vkCreateSwapchainKHR", createSwapchain),
        entry("vkAcquireNextImageKHR", acquireNextImage),
    };
    for (const Entry& known : ofDevices) {
        if (std::strcmp(known.name, name) == 0) {
            return known.function;
        }
    }
    for (const Entry& known : ofInstances) {
        if (!isOfDevices && std::strcmp(known.name, name) == 0) {
            return known.function;
        }
    }
    return nullptr;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL instanceAddress(const VkInstance instance, const char* const name) {
    if (const PFN_vkVoidFunction own = find(name, false)) {
        return own;
    }
    return instance == VK_NULL_HANDLE ? nullptr : below(instance).instanceAddress(instance, name);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL deviceAddress(const VkDevice device, const char* const name) {
    if (const PFN_vkVoidFunction own = find(name, true)) {
        return own;
    }
    return below(device).deviceAddress(device, name);
}

} // namespace

// Headers of Vulkan 1.4 have no VK_LAYER_EXPORT any more.
extern "C" __attribute__((visibility("default"))) VKAPI_ATTR VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* const version) {
    faults(); // a wrong word ends the process here
    version->loaderLayerInterfaceVersion = 2;
    version->pfnGetInstanceProcAddr = instanceAddress;
    version->pfnGetDeviceProcAddr = deviceAddress;
    version->pfnGetPhysicalDeviceProcAddr = nullptr;
    return VK_SUCCESS;
}

// SPDX-License-Identifier: MIT
#include "metamarch/vulkan/context.h"

#include "metamarch/error/error.h"
#include "metamarch/file/standard_stream.h"
#include "metamarch/vulkan/refusal.h"

#include <fmt/format.h>
#include <vulkan/vulkan_raii.hpp>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

namespace metamarch::vulkan {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

std::atomic<uint32_t> messageCount = 0;

VKAPI_ATTR VkBool32 VKAPI_CALL countMessage(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                            VkDebugUtilsMessageTypeFlagsEXT,
                                            const VkDebugUtilsMessengerCallbackDataEXT* data, void*) {
    ++messageCount;
    std::string line = data->pMessage == nullptr ? "" : data->pMessage;
    std::replace(line.begin(), line.end(), '\n', ' ');
    printError(fmt::format("validation: {}\n", line));
    return VK_FALSE; // lets the call continue
}

// The type "general" is left out, because the loader uses it to report broken drivers of other devices.
vk::DebugUtilsMessengerCreateInfoEXT messengerInfo() {
    using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
    using Type = vk::DebugUtilsMessageTypeFlagBitsEXT;
    // Vulkan-Hpp's own member for the callback has another type from 1.4 on; the C struct's stays.
    VkDebugUtilsMessengerCreateInfoEXT info = vk::DebugUtilsMessengerCreateInfoEXT{}
                                                  .setMessageSeverity(Severity::eWarning | Severity::eError)
                                                  .setMessageType(Type::eValidation | Type::ePerformance);
    info.pfnUserCallback = countMessage;
    return info;
}

bool validationWanted() {
    const char* const value = std::getenv("METAMARCH_VALIDATION");
    return value != nullptr && std::string_view(value) == "1";
}

[[noreturn]] void refuse(const std::string& what) {
    const std::string limit = addressLimitText();
    if (!limit.empty()) { // a driver that is installed may be one that could not be loaded
        throw Error(ErrorKind::outOfMemory, what + limit);
    }
    throw Error(ErrorKind::noDevice,
                what +
                    ": install a Vulkan driver (Debian: mesa-vulkan-drivers, which also runs without a GPU)");
}

vk::raii::Context openLoader() {
    try {
        return vk::raii::Context();
    } catch (const std::runtime_error&) {
        refuse("no Vulkan loader (libvulkan.so)");
    }
}

bool layerPresent(const vk::raii::Context& loader) {
    const auto layers = loader.enumerateInstanceLayerProperties();
    return std::any_of(layers.begin(), layers.end(), [](const vk::LayerProperties& layer) {
        return std::strcmp(layer.layerName, kValidationLayer) == 0;
    });
}

bool extensionPresent(const vk::raii::Context& loader, const char* name) {
    const auto extensions = loader.enumerateInstanceExtensionProperties();
    return std::any_of(extensions.begin(), extensions.end(),
                       [name](const vk::ExtensionProperties& extension) {
                           return std::strcmp(extension.extensionName, name) == 0;
                       });
}

vk::raii::Instance createInstance(const vk::raii::Context& loader,
                                  const std::span<const char* const> wantedExtensions) {
    std::vector<const char*> layers;
    std::vector<const char*> extensions(wantedExtensions.begin(), wantedExtensions.end());
    for (const char* const wanted : wantedExtensions) {
        if (!extensionPresent(loader, wanted)) {
            throw Error(ErrorKind::noDevice,
                        fmt::format("no Vulkan driver has {}, which a window takes", wanted));
        }
    }
    vk::InstanceCreateFlags flags;
    // Without this extension the loader hides drivers that translate to another API (MoltenVK).
    if (extensionPresent(loader, VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME)) {
        extensions.push_back(VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME);
        flags |= vk::InstanceCreateFlagBits::eEnumeratePortabilityKHR;
    }

    const vk::ApplicationInfo application("metamarch", METAMARCH_VERSION, "metamarch", METAMARCH_VERSION,
                                          kApiVersion);
    // A messenger in the pNext chain also hears of the creation and destruction of the instance itself.
    const auto synchronization = vk::ValidationFeatureEnableEXT::eSynchronizationValidation;
    const vk::DebugUtilsMessengerCreateInfoEXT messenger = messengerInfo();
    const vk::ValidationFeaturesEXT features(synchronization, {}, &messenger);
    const void* chain = nullptr;
    if (validationWanted()) {
        if (!layerPresent(loader)) {
            throw Error(ErrorKind::noDevice,
                        fmt::format("METAMARCH_VALIDATION=1, but {} is not installed (Debian: "
                                    "vulkan-validationlayers)",
                                    kValidationLayer));
        }
        layers.push_back(kValidationLayer);
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
        extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
        chain = &features;
    }

    try {
        return {loader, vk::InstanceCreateInfo(flags, &application, layers, extensions, chain)};
    } catch (const vk::IncompatibleDriverError&) {
        refuse("no Vulkan driver");
    } catch (const vk::SystemError& error) {
        throw refusalOf(error, "no Vulkan instance");
    }
}

std::vector<vk::raii::PhysicalDevice> findPhysicalDevices(const vk::raii::Instance& instance) {
    try {
        auto devices = instance.enumeratePhysicalDevices();
        if (!devices.empty()) {
            return devices;
        }
    } catch (const vk::InitializationFailedError&) {
        // Some loaders report in this way that there is no device.
    } catch (const vk::SystemError& error) {
        throw refusalOf(error, "no list of Vulkan devices");
    }
    refuse("no Vulkan device");
}

} // namespace

struct Context::Handles {
    explicit Handles(const std::span<const char* const> instanceExtensions)
        : loader(openLoader()), instance(createInstance(loader, instanceExtensions)),
          messenger(validationWanted() ? vk::raii::DebugUtilsMessengerEXT(instance, messengerInfo())
                                       : nullptr),
          physicalDevices(findPhysicalDevices(instance)) {}

    vk::raii::Context loader;
    vk::raii::Instance instance;
    vk::raii::DebugUtilsMessengerEXT messenger; // destroyed before the instance
    std::vector<vk::raii::PhysicalDevice> physicalDevices;
};

Context::Context(const std::span<const char* const> instanceExtensions)
    : handles_(std::make_unique<Handles>(instanceExtensions)) {}

Context::~Context() = default;

const vk::raii::Instance& Context::instance() const { return handles_->instance; }

const std::vector<vk::raii::PhysicalDevice>& Context::physicalDevices() const {
    return handles_->physicalDevices;
}

uint32_t validationMessages() { return messageCount; }

} // namespace metamarch::vulkan

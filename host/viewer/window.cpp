// SPDX-License-Identifier: MIT
#define GLFW_INCLUDE_NONE
#include "metamarch/viewer/window.h"

#include "metamarch/error/error.h"

#include <fmt/format.h>

#include <GLFW/glfw3.h>
#include <algorithm>
#include <cstdlib>
#include <utility>

namespace metamarch::viewer {
namespace {

std::string lastError() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text == nullptr ? "no reason given" : text;
}

Window& windowOf(GLFWwindow* const window) { return *static_cast<Window*>(glfwGetWindowUserPointer(window)); }

} // namespace

WindowSystem::WindowSystem() {
#ifdef GLFW_PLATFORM // from GLFW 3.4 on
    // Wayland's sockets lie in that folder. Where there is none, GLFW's search for Wayland prints an error.
    if (std::getenv("XDG_RUNTIME_DIR") == nullptr && glfwPlatformSupported(GLFW_PLATFORM_X11) == GLFW_TRUE) {
        glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
    }
#endif
    if (glfwInit() != GLFW_TRUE) {
        throw Error(
            ErrorKind::noDevice,
            fmt::format("no display to open a window on ({}); `metamarch render` needs none", lastError()));
    }
    if (glfwVulkanSupported() != GLFW_TRUE) {
        glfwTerminate();
        throw Error(ErrorKind::noDevice, "this display cannot show what Vulkan draws: no Vulkan loader or no "
                                         "surface extension; `metamarch render` needs none");
    }
}

WindowSystem::~WindowSystem() { glfwTerminate(); }

std::vector<const char*> WindowSystem::instanceExtensions() const {
    uint32_t count = 0;
    const char** const names = glfwGetRequiredInstanceExtensions(&count);
    return {names, names + count};
}

bool WindowSystem::presents(const VkInstance instance, const VkPhysicalDevice device,
                            const std::uint32_t queueFamily) const {
    return glfwGetPhysicalDevicePresentationSupport(instance, device, queueFamily) == GLFW_TRUE;
}

Window::Window(const WindowSystem&, const glm::uvec2 size, const std::string& firstTitle)
    : title(firstTitle) {
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    window =
        glfwCreateWindow(static_cast<int>(size.x), static_cast<int>(size.y), title.c_str(), nullptr, nullptr);
    if (window == nullptr) {
        throw Error(ErrorKind::noDevice, fmt::format("no window ({})", lastError()));
    }
    glfwSetWindowUserPointer(window, this);
    glfwSetKeyCallback(window,
                       [](GLFWwindow* const at, const int key, int, const int action, const int modifiers) {
                           if (action != GLFW_RELEASE) {
                               windowOf(at).input.keys.push_back({key, modifiers, action == GLFW_REPEAT});
                           }
                       });
    glfwSetMouseButtonCallback(
        window, [](GLFWwindow* const at, const int button, const int action, const int modifiers) {
            Window& self = windowOf(at);
            self.input.buttons.push_back({button, modifiers, action == GLFW_PRESS, self.cursor()});
        });
    glfwSetCursorPosCallback(window, [](GLFWwindow* const at, const double x, const double y) {
        windowOf(at).cursorPlace = {x, y};
    });
    glfwSetScrollCallback(window, [](GLFWwindow* const at, double, const double clicks) {
        const bool hasCtrl = glfwGetKey(at, GLFW_KEY_LEFT_CONTROL) == GLFW_PRESS ||
                             glfwGetKey(at, GLFW_KEY_RIGHT_CONTROL) == GLFW_PRESS;
        Input& seen = windowOf(at).input;
        (hasCtrl ? seen.scrollWithCtrl : seen.scroll) += static_cast<float>(clicks);
    });
    glfwSetDropCallback(window, [](GLFWwindow* const at, const int count, const char** const paths) {
        windowOf(at).input.dropped.assign(paths, paths + count);
    });
}

Window::~Window() { glfwDestroyWindow(window); }

VkSurfaceKHR Window::makeSurface(const VkInstance instance) const {
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    if (glfwCreateWindowSurface(instance, window, nullptr, &surface) != VK_SUCCESS) {
        throw Error(ErrorKind::noDevice, fmt::format("no surface for the window ({})", lastError()));
    }
    return surface;
}

Input Window::poll(const double seconds) {
    if (seconds > 0.0) {
        glfwWaitEventsTimeout(seconds);
    } else {
        glfwPollEvents();
    }
    return std::exchange(input, {});
}

bool Window::isClosing() const { return glfwWindowShouldClose(window) == GLFW_TRUE; }

void Window::close() { glfwSetWindowShouldClose(window, GLFW_TRUE); }

glm::uvec2 Window::pixels() const {
    int width = 0;
    int height = 0;
    glfwGetFramebufferSize(window, &width, &height);
    return width > 0 && height > 0 ? glm::uvec2(width, height) : glm::uvec2(0);
}

float Window::contentScale() const {
    float scale = 1.0f;
    glfwGetWindowContentScale(window, &scale, nullptr);
    return scale > 0.0f ? scale : 1.0f;
}

// Converts from the screen's units to pixels.
glm::vec2 Window::cursor() const {
    int width = 1;
    int height = 1;
    glfwGetWindowSize(window, &width, &height);
    const glm::uvec2 size = pixels();
    return {static_cast<float>(cursorPlace.x * size.x / std::max(width, 1)),
            static_cast<float>(cursorPlace.y * size.y / std::max(height, 1))};
}

bool Window::isHeld(const int key) const { return glfwGetKey(window, key) == GLFW_PRESS; }

void Window::setTitle(const std::string& wanted) {
    if (wanted != title) {
        title = wanted;
        glfwSetWindowTitle(window, title.c_str());
    }
}

void Window::copy(const std::string& text) { glfwSetClipboardString(window, text.c_str()); }

} // namespace metamarch::viewer

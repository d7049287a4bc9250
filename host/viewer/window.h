// SPDX-License-Identifier: MIT
// The window, through GLFW: its surface, its size and its input.
#pragma once
#include <glm/glm.hpp>
#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

struct GLFWwindow;

namespace metamarch::viewer {

struct KeyPress {
    int key;       // GLFW_KEY_…
    int modifiers; // GLFW_MOD_…
    bool isRepeat; // the key is held
};

struct ButtonChange {
    int button; // GLFW_MOUSE_BUTTON_…
    int modifiers;
    bool isPressed;
    glm::vec2 place; // pixels of the picture, from its upper left corner
};

// The events since the last Window::poll.
struct Input {
    std::vector<KeyPress> keys;
    std::vector<ButtonChange> buttons;
    std::vector<std::filesystem::path> dropped;
    float scroll = 0.0f;         // clicks of the wheel; positive: away from the user
    float scrollWithCtrl = 0.0f; // the same, while Ctrl was held
};

// Initialises GLFW. At most one may exist at a time.
class WindowSystem {
  public:
    // Throws Error(noDevice) if there is no display, or if Vulkan cannot draw to its windows.
    WindowSystem();
    ~WindowSystem();
    WindowSystem(const WindowSystem&) = delete;
    WindowSystem& operator=(const WindowSystem&) = delete;

    // Returns the extensions that a Vulkan instance needs for windows.
    std::vector<const char*> instanceExtensions() const;

    // Returns true if a queue of this family can present to windows of this system.
    bool presents(VkInstance instance, VkPhysicalDevice device, std::uint32_t queueFamily) const;
};

class Window {
  public:
    // `size` is in the screen's units, which need not be pixels. Throws Error(noDevice).
    Window(const WindowSystem& system, glm::uvec2 size, const std::string& title);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    // Returns a surface, which the caller owns. Throws Error(noDevice).
    VkSurfaceKHR makeSurface(VkInstance instance) const;

    // Returns the events since the last call. If there are none, waits up to `seconds` for one.
    Input poll(double seconds = 0.0);

    bool isClosing() const;
    void close();
    glm::uvec2 pixels() const;  // size in pixels; (0, 0) if the window is minimised
    float contentScale() const; // factor by which text and panels must grow on this monitor
    glm::vec2 cursor() const;   // as ButtonChange::place
    bool isHeld(int key) const; // GLFW_KEY_…
    void setTitle(const std::string& title);
    void copy(const std::string& text); // to the clipboard

    GLFWwindow* handle() const { return window; }

  private:
    GLFWwindow* window;
    std::string title;
    Input input;
    // Where the cursor was at the last event of `input`, in the screen's units. The pointer itself may be far
    // ahead, if events have waited for a slow frame.
    glm::dvec2 cursorPlace{0.0};
};

} // namespace metamarch::viewer

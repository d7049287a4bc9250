// SPDX-License-Identifier: MIT
// The window, through GLFW: its surface, its size, what hands and other programs do to it.
#pragma once
#include <glm/glm.hpp>
#include <vulkan/vulkan_raii.hpp>

#include <filesystem>
#include <string>
#include <vector>

struct GLFWwindow;

namespace metamarch::viewer {

struct KeyPress {
    int key;       // GLFW_KEY_…
    int modifiers; // GLFW_MOD_…
};

struct ButtonChange {
    int button; // GLFW_MOUSE_BUTTON_…
    int modifiers;
    bool isPressed;
    glm::vec2 place; // pixels of the picture, from its upper left corner
};

// What has happened since the last look.
struct Input {
    std::vector<KeyPress> keys;
    std::vector<ButtonChange> buttons;
    std::vector<std::filesystem::path> dropped;
    float scroll = 0.0f; // clicks of the wheel, away from the user
};

// GLFW itself. One at a time.
class WindowSystem {
  public:
    // Throws Error(noDevice) without a display, or where its windows cannot show what Vulkan draws.
    WindowSystem();
    ~WindowSystem();
    WindowSystem(const WindowSystem&) = delete;
    WindowSystem& operator=(const WindowSystem&) = delete;

    // That a Vulkan instance for windows needs.
    std::vector<const char*> instanceExtensions() const;
};

class Window {
  public:
    // `size` in the screen's own units. Throws Error(noDevice).
    Window(const WindowSystem& system, glm::uvec2 size, const std::string& title);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    // Throws Error(noDevice).
    vk::raii::SurfaceKHR makeSurface(const vk::raii::Instance& instance) const;

    // Takes what has happened; with `seconds` above 0 it waits that long for something to happen.
    Input poll(double seconds = 0.0);

    bool isClosing() const;
    void close();
    glm::uvec2 pixels() const;  // 0 in both where it is minimised
    float contentScale() const; // pixels that text takes in place of one
    glm::vec2 cursor() const;   // as ButtonChange::place
    bool isHeld(int key) const; // GLFW_KEY_…
    void setTitle(const std::string& title);
    void copy(const std::string& text); // to the clipboard

    GLFWwindow* handle() const { return window; }

  private:
    GLFWwindow* window;
    std::string title;
    Input input;
    // Where the cursor was when the last of `input` happened, in the window's own units: the pointer may be
    // far ahead of events that have waited for a slow frame.
    glm::dvec2 cursorPlace{0.0};
};

} // namespace metamarch::viewer

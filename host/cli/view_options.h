// The options that say from where and through which lens a picture is taken.
#pragma once
#include "metamarch/shading/view.h"

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

namespace metamarch::cli {

class ViewOptions {
  public:
    void addTo(CLI::App& command);

    // Throws Error(invalidArgument) for values out of range, options that exclude each other, and a lens or
    // filter for `integrator` primary, whose rays go through pixel centres.
    void check(const std::string& integrator) const;

    // The camera asked for, else the scene's first, else one that sees the whole scene. Throws
    // Error(invalidArgument) for a camera that does not exist and a view without direction.
    SceneCamera choose(const Scene& scene, glm::uvec2 size) const;

    CameraOptions parse() const;

    // What was given of it.
    struct Pose {
        glm::vec3 eye;
        glm::vec3 target;
        glm::vec3 up;
    };
    std::optional<Pose> pose() const;
    const std::string& cameraSelection() const { return camera; }
    std::optional<double> verticalFovDegrees() const { return verticalFov; }
    std::optional<float> orthographicHeight() const {
        return verticalExtent ? std::optional(static_cast<float>(*verticalExtent)) : std::nullopt;
    }

  private:
    std::string camera;
    std::string eye;
    std::string target;
    std::string up;
    std::optional<double> verticalFov; // degrees
    std::string filter = "box";
    std::optional<double> verticalExtent; // world units
    double aperture = 0.0;
    std::optional<double> focusDistance;
    bool isPanorama = false;
};

} // namespace metamarch::cli

// What `metamarch render` makes of a scene, whichever integrator draws it.
#pragma once
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/image/image.h"
#include "metamarch/render/scene_buffers.h"
#include "metamarch/scene/scene.h"
#include "metamarch/shared/camera.h"
#include "metamarch/vulkan/device.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace metamarch::cli {

struct RenderJob {
    const Scene& scene;
    const AccelerationStructure& structure;
    const Camera& camera;
    const vulkan::Device* device; // none: on the CPU, by the stack traversal
    std::string traversal;
    bool quiet;
};

struct Rendering {
    Image image;
    std::string device;
    std::string driver;
    std::string traversal;
    nlohmann::ordered_json stats;                      // rays, seconds and the like; not the scene's
    std::string summary;                               // for the last line: what a ray or a sample took
    std::optional<nlohmann::ordered_json> rectilinear; // reportRectilinear of the table that was marched
};

// Notes the device, and of its scene what the traversal walks.
void describeDevice(const RenderJob& job, const render::SceneBuffers& scene, Rendering& rendering);
void describeCpu(Rendering& rendering);

} // namespace metamarch::cli

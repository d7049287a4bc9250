// A scene as it stands on the device.
#pragma once
#include "metamarch/render/scene_buffers.h"
#include "metamarch/render/shading_buffers.h"
#include "metamarch/viewer/scene_loader.h"

#include <memory>
#include <utility>

namespace metamarch::viewer {

struct Stage {
    // Throws Error(outOfMemory) where it does not fit the device.
    Stage(const vulkan::Device& device, std::shared_ptr<const LoadedScene> scene)
        : loaded(std::move(scene)), buffers(device, *loaded->structure, makeShadingData(*loaded->shown)),
          shading(device, loaded->shading) {}

    std::shared_ptr<const LoadedScene> loaded;
    render::SceneBuffers buffers;
    render::ShadingBuffers shading;
};

} // namespace metamarch::viewer

// SPDX-License-Identifier: MIT
#include "metamarch/render/device_scene.h"

#include <utility>

namespace metamarch::render {

DeviceScene::DeviceScene(const vulkan::Device& usedDevice, PreparedScene usedScene)
    : onDevice(usedDevice), prepared(std::move(usedScene)),
      sceneBuffers(usedDevice, *prepared.structure, makeShadingData(*prepared.scene)) {
    if (prepared.shading) {
        shadingBuffers.emplace(usedDevice, *prepared.shading);
    }
    seconds = upload.seconds();
}

std::uint64_t DeviceScene::bytes() const {
    return sceneBuffers.bytes() + (shadingBuffers ? shadingBuffers->bytes() : 0);
}

} // namespace metamarch::render

// SPDX-License-Identifier: MIT
// What the window shows behind the scene in place of its surroundings (shared/backdrop.h).
#pragma once
#include "metamarch/image/tone_mapping.h"
#include "metamarch/shared/camera.h"
#include "metamarch/shared/shading_scene.h"
#include "metamarch/viewer/viewer_settings.h"
#include "metamarch/vulkan/buffer.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>
#include <vector>

namespace metamarch::viewer {

// Returns a scene without surfaces whose surroundings are those of `scene`, blurred.
ShadingScene blurredSurroundings(const ShadingScene& scene);

class Backdrop {
  public:
    explicit Backdrop(const vulkan::Device& device);

    // Brings the backdrop up to date. `scene` lights the picture that `camera` sees.
    void follow(const BackdropChoice& choice, const std::shared_ptr<const ShadingScene>& scene,
                const Camera& camera, const ToneMapping& tone);

    const vulkan::Buffer& texels() const { return buffer_; }
    glm::uvec2 size() const { return size_; } // texels; 0: pictures have their own surroundings

    // Returns a packed pixel of a picture with `picture` pixels over the backdrop, as the window shows it.
    std::uint32_t under(std::uint32_t pixel, glm::uvec2 place, glm::uvec2 picture) const;

  private:
    void set(glm::uvec2 size, std::vector<glm::vec4> texels);

    const vulkan::Device& device_;
    vulkan::Buffer buffer_;
    glm::uvec2 size_{0};
    std::vector<glm::vec4> texels_;             // what the buffer has
    std::shared_ptr<const ShadingScene> scene_; // of blurred_
    ShadingScene blurred_;
};

} // namespace metamarch::viewer

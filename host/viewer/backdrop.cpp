// SPDX-License-Identifier: MIT
#include "metamarch/viewer/backdrop.h"

#include "metamarch/shared/backdrop.h"
#include "metamarch/shared/environment_map.h"
#include "metamarch/shared/scene_light.h"
#include "metamarch/vulkan/transfer.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace metamarch::viewer {
namespace {

constexpr glm::uvec2 kMostTexels(64, 40); // a blurred map shows no more
constexpr glm::uvec2 kBlurredSize(64, 32);
constexpr float kSharpness = 60.0f; // of exp(s * (cosine - 1)): its deviation is 7 degrees

constexpr glm::vec3 kOffColor(0.012f, 0.014f, 0.016f); // linear; the grey of an empty window

glm::vec3 directionOf(const glm::uvec2 texel) {
    return mapDirection((glm::vec2(texel) + 0.5f) / glm::vec2(kBlurredSize));
}

// Returns the mean of the texels of each field of a map of kBlurredSize.
std::vector<glm::vec3> reduced(const ShadingScene& scene) {
    const glm::uvec2 size(scene.settings.environmentWidth, scene.settings.environmentHeight);
    std::vector<glm::vec3> means;
    for (std::uint32_t y = 0; y < kBlurredSize.y; ++y) {
        for (std::uint32_t x = 0; x < kBlurredSize.x; ++x) {
            const glm::uvec2 from = glm::uvec2(x, y) * size / kBlurredSize;
            const glm::uvec2 to = glm::max(glm::uvec2(x + 1, y + 1) * size / kBlurredSize, from + 1u);
            glm::vec3 sum(0.0f);
            for (std::uint32_t row = from.y; row < to.y; ++row) {
                for (std::uint32_t column = from.x; column < to.x; ++column) {
                    sum += glm::vec3(scene.environment[std::size_t{row} * size.x + column]);
                }
            }
            means.push_back(sum / static_cast<float>((to.x - from.x) * (to.y - from.y)));
        }
    }
    return means;
}

// Poses of an animation are scenes of their own under the same map.
bool hasSameSurroundings(const ShadingScene& a, const ShadingScene& b) {
    return &a == &b || (a.settings.environmentWidth == b.settings.environmentWidth &&
                        a.settings.environmentCosine == b.settings.environmentCosine &&
                        a.settings.environmentSine == b.settings.environmentSine &&
                        a.settings.environmentScale == b.settings.environmentScale &&
                        a.settings.background == b.settings.background && a.environment == b.environment);
}

} // namespace

ShadingScene blurredSurroundings(const ShadingScene& scene) {
    ShadingScene blurred;
    blurred.settings = scene.settings;
    blurred.features = scene.features & kFeatureEnvironment;
    if (blurred.features == 0) {
        return blurred;
    }
    blurred.settings.environmentWidth = kBlurredSize.x;
    blurred.settings.environmentHeight = kBlurredSize.y;
    const std::vector<glm::vec3> means = reduced(scene);
    std::vector<glm::vec4> directions; // and the solid angle of each, as a part of the others'
    for (std::uint32_t y = 0; y < kBlurredSize.y; ++y) {
        for (std::uint32_t x = 0; x < kBlurredSize.x; ++x) {
            const glm::vec3 direction = directionOf({x, y});
            directions.emplace_back(direction, std::sqrt(std::max(1.0f - direction.y * direction.y, 0.0f)));
        }
    }
    for (const glm::vec4& here : directions) {
        glm::vec3 sum(0.0f);
        float weights = 0.0f;
        for (std::size_t i = 0; i < directions.size(); ++i) {
            const float cosine = glm::dot(glm::vec3(here), glm::vec3(directions[i]));
            const float weight = directions[i].w * std::exp(kSharpness * (cosine - 1.0f));
            sum += weight * means[i];
            weights += weight;
        }
        blurred.environment.emplace_back(sum / weights, 0.0f);
    }
    return blurred;
}

Backdrop::Backdrop(const vulkan::Device& device)
    : device_(device), buffer_(device, vulkan::BufferUse::storage,
                               std::uint64_t{kMostTexels.x} * kMostTexels.y * sizeof(glm::vec4), "backdrop") {
}

void Backdrop::follow(const BackdropChoice& choice, const std::shared_ptr<const ShadingScene>& scene,
                      const Camera& camera, const ToneMapping& tone) {
    using Kind = BackdropChoice::Kind;
    if (choice.kind == Kind::surroundings) {
        set({0, 0}, {});
    } else if (choice.kind == Kind::off) {
        set({1, 1}, {glm::vec4(kOffColor, 0.0f)});
    } else if (choice.kind == Kind::solid) {
        const glm::vec3 color = choice.color;
        set({1, 1}, {{srgbLinear(color.x), srgbLinear(color.y), srgbLinear(color.z), 0.0f}});
    } else {
        if (!scene_ || !hasSameSurroundings(*scene_, *scene)) {
            blurred_ = blurredSurroundings(*scene);
        }
        scene_ = scene;
        std::vector<glm::vec4> texels;
        const glm::vec2 field = glm::vec2(camera.width, camera.height) / glm::vec2(kMostTexels);
        for (std::uint32_t y = 0; y < kMostTexels.y; ++y) {
            for (std::uint32_t x = 0; x < kMostTexels.x; ++x) {
                const CameraRay view =
                    cameraRayThrough(camera, (glm::vec2(x, y) + 0.5f) * field, glm::vec2(0.0f));
                const glm::vec3 light = environmentLight(blurred_, blurred_.settings, view.dir, 0).radiance;
                texels.emplace_back(clampedColor(toneMapped(tone, light)), 0.0f);
            }
        }
        set(kMostTexels, std::move(texels));
    }
}

void Backdrop::set(const glm::uvec2 size, std::vector<glm::vec4> texels) {
    if (size == size_ && texels == texels_) {
        return;
    }
    size_ = size;
    texels_ = std::move(texels);
    vulkan::write(device_, buffer_, 0, std::as_bytes(std::span(texels_)));
}

std::uint32_t Backdrop::under(const std::uint32_t pixel, const glm::uvec2 place,
                              const glm::uvec2 picture) const {
    const BackdropPlace at = backdropPlace(place.x, place.y, picture.x, picture.y, size_.x, size_.y);
    const glm::vec3 color =
        backdropBetween(glm::vec3(texels_[at.upperLeft]), glm::vec3(texels_[at.upperRight]),
                        glm::vec3(texels_[at.lowerLeft]), glm::vec3(texels_[at.lowerRight]), at);
    return overBackdrop(pixel, color);
}

} // namespace metamarch::viewer

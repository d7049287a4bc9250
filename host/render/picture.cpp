// SPDX-License-Identifier: MIT
#include "metamarch/render/picture.h"

#include "metamarch/image/film_image.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <ctime>
#include <iterator>
#include <vector>

namespace metamarch::render {
namespace {

void addHeader(const RenderResult& result, const PictureOrigin& origin, Image& image) {
    const auto add = [&](const char* const name, std::string value) {
        image.attributes.emplace_back(name, std::move(value));
    };
    const auto point = [](const glm::vec3 v) { return fmt::format("{},{},{}", v.x, v.y, v.z); };
    const RenderSettings& settings = result.settings;
    if (!settings.isPrimary()) {
        add("metamarch/spp", fmt::format("{}", settings.samplesPerPixel));
        add("metamarch/seed", fmt::format("{}", settings.path.seed));
        add("metamarch/maxBounces", fmt::format("{}", settings.path.applied({}).maxBounces));
    }
    add("Software", origin.software);
    add("metamarch/device", result.device);
    add("metamarch/driver", result.driver);
    add("metamarch/traversal", result.traversal);
    add("metamarch/integrator", std::string(nameOf(settings.path.integrator)));
    add("metamarch/scene", origin.sceneFile);
    if (!origin.sceneSha1.empty()) {
        add("metamarch/sceneSha1", origin.sceneSha1);
    }
    if (!origin.options.empty()) {
        add("metamarch/options", origin.options);
    }
    add("metamarch/camera", origin.camera.name);
    add("metamarch/eye", point(origin.camera.eye));
    add("metamarch/forward", point(origin.camera.forward));
    add("metamarch/up", point(origin.camera.up));
    image.attributes.emplace_back("worldtocamera", worldToCamera(origin.camera));
    if (!origin.lens.isPanorama) { // whose projection is no matrix
        const float aspect = static_cast<float>(result.size.x) / static_cast<float>(result.size.y);
        image.attributes.emplace_back("worldtoNDC", worldToNdc(origin.camera, aspect));
        if (origin.camera.projection == SceneCamera::Projection::perspective) {
            image.attributes.emplace_back("metamarch/vfov", glm::degrees(origin.camera.verticalFov));
        } else {
            image.attributes.emplace_back("metamarch/orthographicHeight", origin.camera.verticalExtent);
        }
    }
    if (origin.isStamped) {
        add(kDateTime, fmt::format("{:%Y:%m:%d %H:%M:%S}", fmt::localtime(std::time(nullptr))));
        add("metamarch/seconds", fmt::format("{:.3f}", result.seconds.render));
    }
}

void removeNoise(const RenderResult& result, const Denoiser& denoiser, Image& image) {
    const Aov guideRows[] = {aovNamed("albedo"), aovNamed("Ns")};
    const Image guideImage = filmImage(result.film, {}, image.width, image.height, guideRows);
    const DenoiserGuides guides = denoiser.filterGuides(
        {colorsIn(guideImage, "albedo.R"), colorsIn(guideImage, "Ns.X")}, image.width, image.height);
    for (const Aov& row : noisyAovs(result.settings.aovs())) {
        const std::string noisy = row.channels().front();
        const std::size_t changed = image.findChannel(noisy.substr(kNoisy.size())).value();
        const std::vector<glm::vec3> clean =
            denoiser.filterColor(colorsIn(image, noisy), guides, image.width, image.height);
        for (std::size_t i = 0; i < clean.size(); ++i) {
            std::copy_n(glm::value_ptr(clean[i]), 3, &image.pixels[i * image.channels.size() + changed]);
        }
    }
}

} // namespace

Image imageOf(const RenderResult& result, const Denoiser* const denoiser) {
    std::vector<Aov> aovs = result.settings.aovs();
    if (denoiser != nullptr) {
        std::ranges::copy(noisyAovs(aovs), std::back_inserter(aovs));
    }
    Image image = filmImage(result.film, result.seen, static_cast<int>(result.area.width()),
                            static_cast<int>(result.area.height()), aovs, result.settings.missDepth);
    if (denoiser != nullptr) {
        removeNoise(result, *denoiser, image);
    }
    image.left = static_cast<int>(result.area.left);
    image.top = static_cast<int>(result.area.top);
    image.fullWidth = static_cast<int>(result.size.x);
    image.fullHeight = static_cast<int>(result.size.y);
    for (const CryptomatteLevel& level : result.cryptomatte) {
        addCryptomatte(level, result.film, image);
    }
    return image;
}

Image shownImageOf(const RenderResult& result, const Denoiser* const denoiser) {
    Image image = imageOf(result, denoiser);
    const auto alpha = image.findChannel("A");
    if (alpha && !result.settings.isPrimary() && !result.settings.path.isTransparent) {
        image.channels[*alpha] = "coverage"; // without a channel A a picture is opaque
    }
    return image;
}

glm::mat4 worldToCamera(const SceneCamera& camera) {
    const glm::dvec3 forward = camera.forward;
    const glm::dvec3 up = camera.up;
    const glm::dvec3 right = glm::cross(forward, up);
    const glm::dvec3 eye = camera.eye;
    glm::dmat4 matrix(1.0);
    for (int axis = 0; axis < 3; ++axis) {
        matrix[axis] = glm::dvec4(right[axis], up[axis], forward[axis], 0.0);
    }
    matrix[3] = glm::dvec4(-glm::dot(right, eye), -glm::dot(up, eye), -glm::dot(forward, eye), 1.0);
    return glm::mat4(matrix);
}

glm::mat4 worldToNdc(const SceneCamera& camera, const float aspect) {
    // Columns. A perspective divides by z; its depth, which nobody uses, is 0 at distance 1 and 1 far away,
    // so that the matrix can be inverted.
    glm::dmat4 projection(0.0);
    const bool isPerspective = camera.projection == SceneCamera::Projection::perspective;
    const double height = isPerspective ? 2.0 * std::tan(0.5 * static_cast<double>(camera.verticalFov))
                                        : static_cast<double>(camera.verticalExtent);
    projection[0][0] = 1.0 / (height * static_cast<double>(aspect));
    projection[1][1] = -1.0 / height;
    if (isPerspective) {
        projection[2] = glm::dvec4(0.5, 0.5, 1.0, 1.0);
        projection[3] = glm::dvec4(0.0, 0.0, -1.0, 0.0);
    } else {
        projection[2] = glm::dvec4(0.0, 0.0, 1.0, 0.0);
        projection[3] = glm::dvec4(0.5, 0.5, 0.0, 1.0);
    }
    return glm::mat4(projection * glm::dmat4(worldToCamera(camera)));
}

void writePicture(const RenderResult& result, const PictureOrigin& origin, const PictureTarget& target) {
    const bool isShown = pictureFormatOf(target.path, target.storage) != PictureFormat::exr;
    Image image = isShown ? shownImageOf(result, target.denoiser) : imageOf(result, target.denoiser);
    addHeader(result, origin, image);
    if (target.denoiser != nullptr) {
        image.attributes.emplace_back("metamarch/denoiser", target.denoiser->version());
    }
    writeImage(image, target.path, target.toneMapping, target.storage);
}

} // namespace metamarch::render

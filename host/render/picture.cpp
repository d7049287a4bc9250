// SPDX-License-Identifier: MIT
#include "metamarch/render/picture.h"

#include "metamarch/image/film_image.h"
#include "metamarch/image/image_file.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>

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
    if (!origin.options.empty()) {
        add("metamarch/options", origin.options);
    }
    add("metamarch/camera", origin.camera.name);
    add("metamarch/eye", point(origin.camera.eye));
    add("metamarch/forward", point(origin.camera.forward));
    add("metamarch/up", point(origin.camera.up));
    if (origin.isStamped) {
        add(kDateTime, fmt::format("{:%Y:%m:%d %H:%M:%S}", fmt::localtime(std::time(nullptr))));
        add("metamarch/seconds", fmt::format("{:.3f}", result.seconds.render));
    }
}

// writeImage makes an opaque PNG if there is no channel A.
void renameAlpha(Image& image) {
    if (const auto alpha = image.findChannel("A")) {
        image.channels[*alpha] = "coverage";
    }
}

} // namespace

Image imageOf(const RenderResult& result) {
    const auto width = static_cast<int>(result.size.x);
    const auto height = static_cast<int>(result.size.y);
    return filmImage(
        result.film.pixels, width, height,
        aovsOf(result.settings.isPrimary() ? AovWriter::everyIntegrator : AovWriter::pathTracer));
}

void writePicture(const RenderResult& result, const PictureOrigin& origin, const std::filesystem::path& path,
                  const ToneMapping& toneMapping) {
    Image image = imageOf(result);
    addHeader(result, origin, image);
    if (!result.settings.isPrimary() && pictureFormatOf(path) == PictureFormat::png) {
        renameAlpha(image);
    }
    writeImage(image, path, toneMapping);
}

} // namespace metamarch::render

// SPDX-License-Identifier: MIT
#include "metamarch/viewer/picture_saver.h"

#include "metamarch/error/error.h"
#include "metamarch/image/image_file.h"
#include "metamarch/render/picture.h"
#include "metamarch/shared/backdrop.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <utility>

namespace metamarch::viewer {
namespace {

std::string freeName(const std::string& stem, const std::string& ending) {
    for (int number = 1;; ++number) {
        std::string name = fmt::format("{}_{:03}{}", stem, number, ending);
        if (!std::filesystem::exists(name)) {
            return name;
        }
    }
}

std::string fullPath(const std::string& name) { return std::filesystem::absolute(name).string(); }

// Inverts the sRGB curve, so that writeImage turns the result back into exactly this byte.
float lightOf(const std::uint32_t byte) {
    const double coded = byte / 255.0;
    return static_cast<float>(coded <= 0.04045 ? coded / 12.92 : std::pow((coded + 0.055) / 1.055, 2.4));
}

Image imageOf(const std::vector<std::uint32_t>& packed, const glm::uvec2 size) {
    Image image(static_cast<int>(size.x), static_cast<int>(size.y), {"R", "G", "B"});
    for (std::size_t i = 0; i < packed.size(); ++i) {
        for (unsigned channel = 0; channel < 3; ++channel) {
            image.pixels[3 * i + channel] = lightOf((packed[i] >> (8 * channel)) & 255u);
        }
    }
    return image;
}

// Returns packed pixels.
std::vector<std::uint32_t> overBackdrop(const render::RenderResult& result, const Denoiser* const denoiser,
                                        const ToneMapping& tone, const Backdrop& backdrop) {
    const std::vector<glm::vec3> colors = colorsIn(render::imageOf(result, denoiser), "R");
    std::vector<std::uint32_t> pixels(colors.size());
    for (std::uint32_t i = 0; i < pixels.size(); ++i) {
        const std::uint32_t own =
            withCoverage(packedLinear(toneMapped(tone, colors[i])), coverage(result.film.pixels[i]));
        pixels[i] = backdrop.under(own, {i % result.size.x, i / result.size.x}, result.size);
    }
    return pixels;
}

} // namespace

PictureSaver::PictureSaver(std::string usedSoftware, const vulkan::Device& usedDevice)
    : software(std::move(usedSoftware)), device(usedDevice) {}

std::string PictureSaver::save(const ProgressiveImage& progressive, const RenderRequest& request,
                               const std::string& traversal, const ViewerState& state,
                               const std::string& ending, const Denoiser* const denoiser,
                               const Backdrop& backdrop) const {
    if (!progressive.isWhole()) {
        throw Error(ErrorKind::invalidArgument, "parts of the picture are still empty: save it in a moment");
    }
    const std::filesystem::path& file = state.scene->request.file;
    const std::string name = freeName(file.stem().string(), ending);
    if (request.view || (!state.settings.channel.empty() && ending == ".png")) {
        if (ending != ".png") {
            throw Error(ErrorKind::invalidArgument,
                        "a view has no film to save: choose the picture, or a screenshot");
        }
        writeImage(imageOf(progressive.shownPixels(), progressive.size()), name);
        return "saved " + fullPath(name);
    }
    render::RenderResult result;
    result.settings.path = state.settings.path;
    result.settings.samplesPerPixel = progressive.wholeSamples(); // some tiles may have more
    result.size = progressive.size();
    result.area = {0, 0, result.size.x, result.size.y};
    result.film = progressive.film();
    result.device = device.name();
    result.driver = device.report().driverText();
    result.traversal = traversal;
    result.seconds.render = progressive.seconds();
    const auto saved = [&] { // only once it is there: the folder may be gone
        return fmt::format("saved {}, {} samples a pixel", fullPath(name), result.settings.samplesPerPixel);
    };
    using Kind = BackdropChoice::Kind;
    const Kind behind = state.settings.backdrop.kind;
    if (ending == ".png" && (behind == Kind::solid || behind == Kind::blurred)) {
        writeImage(imageOf(overBackdrop(result, denoiser, state.settings.tone, backdrop), result.size), name);
        return saved();
    }
    const render::PictureOrigin origin{
        .software = software, .sceneFile = file.string(), .camera = request.camera, .lens = request.lens};
    render::writePicture(result, origin,
                         {.path = name, .toneMapping = state.settings.tone, .denoiser = denoiser});
    return saved();
}

std::string PictureSaver::saveWindow(const std::vector<std::uint32_t>& pixels, const glm::uvec2 size,
                                     const std::string& stem) const {
    const std::string name = freeName(stem, ".png");
    writeImage(imageOf(pixels, size), name);
    return fullPath(name);
}

} // namespace metamarch::viewer

// SPDX-License-Identifier: MIT
#include "metamarch/viewer/progressive_image.h"

#include "metamarch/render/seen_points.h"
#include "metamarch/shared/tile_order.h"
#include "metamarch/viewer/channel_picture.h"
#include "metamarch/vulkan/transfer.h"

#include <algorithm>
#include <span>

namespace metamarch::viewer {
namespace {

// With few samples at a time the picture changes soon and often, which matters at first. With many a sample
// costs less.
std::uint32_t samplesAtOnce(const std::uint32_t taken) { return std::clamp(taken / 4, 1u, kBlockSamples); }

} // namespace

ProgressiveImage::ProgressiveImage(const vulkan::Device& usedDevice, const render::DeviceScene& usedScene,
                                   const std::string& usedTraversal, const glm::uvec2 usedMost,
                                   const ShaderOverrides& usedShaders)
    : device(usedDevice), scene(usedScene), traversal(usedTraversal), most(usedMost), shaders(usedShaders) {}

void ProgressiveImage::start(const RenderRequest& wanted, const glm::uvec2 size) {
    request = wanted;
    pictureSize = size;
    isToClear = true;
    unresolved.clear();
    denoised.clear();
    channelSamples = 0;
    dropFiltered();
    if (request.view) {
        const Camera camera = makeCamera(request.camera, size.x, size.y, request.lens);
        if (!inspector) {
            inspector.emplace(device, scene.buffers(), scene.shading(), traversal, most.x * most.y,
                              shaders.find("inspect", traversal), shaders.find("cells", ""));
        }
        inspector->start(camera, *request.view, request.scaleMax, request.scaleMin);
    } else if (path) {
        startPath();
    }
}

void ProgressiveImage::startPath() {
    const Camera camera = makeCamera(request.camera, pictureSize.x, pictureSize.y, request.lens);
    secondsBefore = path->tracer.counters().deviceSeconds;
    path->tracer.start(camera, request.settings, {0, render::Tiling(camera).count});
}

bool ProgressiveImage::advance(const double seconds) {
    if (request.view) {
        if (inspector->isWhole()) {
            return false;
        }
        clear();
        inspector->advance(seconds);
        return true;
    }
    if (!path) {
        const std::uint32_t tiles = render::Tiling(PixelRect{0, 0, most.x, most.y}).count;
        const Camera camera = makeCamera(request.camera, pictureSize.x, pictureSize.y, request.lens);
        path.emplace(device, scene, traversal, camera, tiles, most.x * most.y,
                     shaders.find("path", traversal));
        startPath();
    }
    if (isFinished()) {
        return false;
    }
    if (isFiltered() && advanceFilter(seconds)) {
        return true;
    }
    render::PathTracer& tracer = path->tracer;
    unresolved.push_back(tracer.advance(request.endSample, samplesAtOnce(tracer.samples()), seconds));
    if (filteredSamples > 0 && !isFiltered()) { // there are samples enough
        dropFiltered();
        showAgain();
    }
    return true;
}

bool ProgressiveImage::isFiltered() const {
    return hasFilter && filterRefusal().empty() && denoiser == nullptr && channel.empty() && !request.view &&
           wholeSamples() > 0 && wholeSamples() < render::DisplayFilter::kEnough && !isFinished();
}

std::string_view ProgressiveImage::filterRefusal() const {
    return !render::DisplayFilter::fits(device, std::uint64_t{most.x} * most.y)
               ? "the device does not bind a kernel as much memory as so many pixels take"
           : hasRoomForFilter ? ""
                              : "the device lacks the memory for so many pixels";
}

// Filters the film each time that its samples have doubled. Returns false, and submits nothing, if there is
// nothing to do.
bool ProgressiveImage::advanceFilter(const double seconds) {
    if (!filter) {
        try {
            filter.emplace(device, path->tracer, path->resolver.picture(), most.x * most.y);
        } catch (const Error& error) {
            if (error.kind != ErrorKind::outOfMemory) {
                throw;
            }
            hasRoomForFilter = false;
            return false;
        }
    }
    if (!filter->isWorking()) {
        if (wholeSamples() < std::max(2 * filteredSamples, 1u)) {
            return false;
        }
        filter->start(pictureSize, wholeSamples());
        return true;
    }
    if (filter->advance(seconds)) {
        filteredSamples = wholeSamples();
        isFilterShown = false;
    }
    return true;
}

// The inspector draws into the buffer that the window shows, so the old picture must be cleared first.
void ProgressiveImage::clear() {
    if (isToClear) {
        vulkan::Submission(device).run([&](vulkan::Commands& commands) { commands.fill(picture(), 0); });
        isToClear = false;
    }
}

bool ProgressiveImage::isWhole() const { return request.view ? inspector->isWhole() : wholeSamples() > 0; }

double ProgressiveImage::samples() const { return request.view || !path ? 0.0 : path->tracer.meanSamples(); }

double ProgressiveImage::seconds() const {
    return request.view ? inspector->deviceSeconds()
           : path       ? path->tracer.counters().deviceSeconds - secondsBefore
                        : 0.0;
}

void ProgressiveImage::setTone(const ToneMapping& toneMapping) {
    if (tone == toneMapping) {
        return;
    }
    tone = toneMapping;
    showAgain();
}

void ProgressiveImage::showAgain() {
    if (showsDenoised()) {
        writeDenoised();
    } else if (showsChannel()) {
        writeChannel();
    } else if (showsFiltered()) {
        isFilterShown = false;
    } else if (path && !request.view) {
        unresolved = {path->tracer.begunTiles()};
    }
}

void ProgressiveImage::setChannel(const std::string& name) {
    if (channel != name) {
        channel = name;
        channelSamples = 0;
        dropFiltered();
        showAgain();
    }
}

void ProgressiveImage::setFilter(const bool isWanted) {
    if (hasFilter == isWanted) {
        return;
    }
    hasFilter = isWanted;
    dropFiltered();
    showAgain();
}

void ProgressiveImage::dropFiltered() {
    filteredSamples = 0;
    if (filter) {
        filter->stop();
    }
}

void ProgressiveImage::setDenoiser(const Denoiser* const usedDenoiser) {
    if (denoiser == usedDenoiser) {
        return;
    }
    denoiser = usedDenoiser;
    denoised.clear();
    dropFiltered();
    showAgain();
}

void ProgressiveImage::update() {
    if (request.view || !path) {
        return;
    }
    const std::uint32_t samples = wholeSamples();
    if (!channel.empty() && samples > channelSamples && (samples >= 2 * channelSamples || isFinished())) {
        channelSamples = samples;
        writeChannel();
    }
    if (denoised.take() && showsDenoised()) {
        writeDenoised();
    }
    if (denoiser != nullptr && channel.empty() && denoised.wants(wholeSamples(), isFinished())) {
        denoised.begin(*denoiser, film(), pictureSize, wholeSamples());
    }
}

void ProgressiveImage::show(const std::vector<std::uint32_t>& pixels) {
    vulkan::write(device, picture(), 0, std::as_bytes(std::span(pixels)));
    isToClear = false; // no pixel of the picture before is left
}

void ProgressiveImage::writeDenoised() { show(denoised.pixels(tone)); }

void ProgressiveImage::writeChannel() {
    const Aov& row = aovNamed(channel);
    const FilmData taken = film();
    std::vector<SeenPoint> seen;
    if (row.isOfSeenPoint) {
        const Camera camera = makeCamera(request.camera, pictureSize.x, pictureSize.y, request.lens);
        seen = render::seenPoints(scene.scene(), camera, {0, 0, pictureSize.x, pictureSize.y},
                                  &request.settings, taken.pixels);
    }
    show(channelPixels(row, taken, seen, tone));
}

bool ProgressiveImage::isFinished() const { return path->tracer.samples() >= request.endSample; }

void ProgressiveImage::record(vulkan::Commands& commands) {
    if (!hasPicture()) {
        return;
    }
    if (isToClear) {
        commands.fill(picture(), 0);
        isToClear = false;
    }
    if (showsDenoised() || showsChannel() || showsFiltered()) {
        unresolved.clear();
    }
    if (showsFiltered() && !isFilterShown) {
        if (request.settings.strategies & kHideSurroundings) { // the filter leaves alpha as it is
            path->resolver.resolve(commands, path->tracer.begunTiles(), pictureSize, tone);
        }
        filter->show(commands, tone);
        isFilterShown = true;
    }
    for (const render::TileRange& tiles : unresolved) {
        path->resolver.resolve(commands, tiles, pictureSize, tone);
    }
    unresolved.clear();
}

const vulkan::Buffer& ProgressiveImage::picture() const {
    return request.view ? inspector->picture() : path->resolver.picture();
}

std::vector<std::uint32_t> ProgressiveImage::shownPixels() const {
    std::vector<std::uint32_t> pixels(std::size_t{pictureSize.x} * pictureSize.y);
    vulkan::read(device, picture(), 0, std::as_writable_bytes(std::span(pixels)));
    for (std::uint32_t& pixel : pixels) {
        pixel |= 0xff000000u;
    }
    return pixels;
}

FilmPixel ProgressiveImage::filmPixel(const glm::uvec2 place) const {
    return request.view || !path ? emptyPixel() : path->tracer.pixel(place.x, place.y);
}

FilmData ProgressiveImage::film() const {
    FilmData film(std::size_t{pictureSize.x} * pictureSize.y, 0);
    path->tracer.download(film);
    return film;
}

} // namespace metamarch::viewer

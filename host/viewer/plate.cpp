#include "metamarch/viewer/plate.h"

#include "metamarch/shared/primary.h"

#include <algorithm>

namespace metamarch::viewer {
namespace {

// The picture changes soon and often at first, and costs less of it later.
std::uint32_t samplesAtOnce(const std::uint32_t taken) {
    return std::clamp(taken / 4, 1u, render::PathTracer::kSamplesAtOnce);
}

} // namespace

Plate::Plate(const vulkan::Device& usedDevice, const render::DeviceScene& usedScene,
             const std::string& usedTraversal, const glm::uvec2 usedMost, const ShaderOverrides& usedShaders)
    : device(usedDevice), scene(usedScene), traversal(usedTraversal), most(usedMost), shaders(usedShaders) {}

void Plate::start(const Shot& wanted, const glm::uvec2 size) {
    shot = wanted;
    pictureSize = size;
    isToClear = true;
    unresolved.clear();
    const Camera camera = makeCamera(shot.camera, size.x, size.y, shot.lens);
    if (shot.view) {
        if (!inspector) {
            inspector.emplace(device, scene.buffers(), scene.shading(), traversal, most.x * most.y,
                              shaders.find("inspect", traversal), shaders.find("cells", ""));
        }
        inspector->start(camera, *shot.view, shot.scaleMax);
        return;
    }
    if (!path) {
        const std::uint32_t tiles =
            ((most.x + kTileSide - 1) / kTileSide) * ((most.y + kTileSide - 1) / kTileSide);
        path.emplace(device, scene, traversal, tiles, most.x * most.y, shaders.find("path", traversal));
    }
    secondsBefore = path->tracer.counters().deviceSeconds;
    path->tracer.start(camera, shot.settings, {0, render::Tiling(camera).count});
}

bool Plate::advance(const double seconds) {
    if (shot.view) {
        if (inspector->isWhole()) {
            return false;
        }
        clear();
        inspector->advance(seconds);
        return true;
    }
    render::PathTracer& tracer = path->tracer;
    if (tracer.samples() >= shot.endSample) {
        return false;
    }
    unresolved.push_back(tracer.advance(shot.endSample, samplesAtOnce(tracer.samples()), seconds));
    return true;
}

// The views are drawn where they are seen: what was there before must go first.
void Plate::clear() {
    if (isToClear) {
        vulkan::Submission(device).run([&](vulkan::Commands& commands) { commands.fill(picture(), 0); });
        isToClear = false;
    }
}

bool Plate::isWhole() const { return shot.view ? inspector->isWhole() : path->tracer.samples() > 0; }

double Plate::samples() const { return shot.view ? 0.0 : path->tracer.meanSamples(); }

double Plate::seconds() const {
    return shot.view ? inspector->deviceSeconds() : path->tracer.counters().deviceSeconds - secondsBefore;
}

void Plate::setTone(const ToneMapping& toneMapping) {
    if (tone == toneMapping) {
        return;
    }
    tone = toneMapping;
    if (path && !shot.view) {
        unresolved = {path->tracer.begunTiles()};
    }
}

void Plate::record(vulkan::Commands& commands) {
    if (isToClear) {
        commands.fill(picture(), 0);
        isToClear = false;
    }
    for (const render::TileRange& tiles : unresolved) {
        path->resolver.resolve(commands, tiles, pictureSize, tone);
    }
    unresolved.clear();
}

const vulkan::Buffer& Plate::picture() const {
    return shot.view ? inspector->picture() : path->resolver.picture();
}

std::vector<FilmPixel> Plate::film() const {
    std::vector<FilmPixel> pixels(std::size_t{pictureSize.x} * pictureSize.y);
    path->tracer.download(pixels);
    return pixels;
}

} // namespace metamarch::viewer

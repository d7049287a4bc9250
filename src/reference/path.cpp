// SPDX-License-Identifier: MIT
#include "metamarch/reference/path.h"

#include "metamarch/reference/trace.h"
#include "metamarch/shared/path.h"
#include "metamarch/shared/primary.h"

#include <algorithm>

namespace metamarch {
namespace {

struct Render {
    const AccelerationStructure& structure;
    const ShadingScene& scene;
    const PathSettings& settings;
    const Camera& camera;
};

struct Found {
    TraceResult trace; // of the closest triangle that is there for the path; steps and tests of the whole ray
    InWay inWay;
};

// Finds the closest triangle that is there for this path, or any such triangle, and what is in the way.
// kernels/path.glsl has another loop, because of llvmpipe.
Found traceOpaque(const Render& render, const Ray& given, const HitQuery query, const PixelSample at,
                  const uint dimension, const Passing passed) {
    Found found{{}, nothingInWay()};
    if (!hasFeature(render.scene, kFeatureAlpha | kFeatureCatcher) && !passed.isThroughPanes) {
        found.trace = traceKdStack(render.structure, given, query);
        found.inWay.first = found.trace.hit.triangleId == kNoTriangle ? kNothing : kObject;
        return found;
    }
    Ray ray = given;
    while (true) {
        const TraceResult next = traceKdStack(render.structure, ray, HitQuery::closest);
        const uint steps = found.trace.steps + next.steps;
        const uint tests = found.trace.tests + next.tests;
        if (found.inWay.first == kNothing) {
            found.trace = next;
        }
        found.trace.steps = steps;
        found.trace.tests = tests;
        if (next.hit.triangleId == kNoTriangle) {
            return found;
        }
        found.inWay = meetInWay(render.scene, found.inWay, ray, render.structure.triangles[next.recordIndex],
                                at, dimension, passed);
        const uint kind = found.inWay.last;
        if (passed.isToLamps ? kind == kLamp : kind != kNothing) {
            return found;
        }
        ray = rayBehind(ray, next.hit.t);
    }
}

void count(PathSample& taken, const TraceResult& trace) {
    taken.steps += static_cast<float>(trace.steps);
    taken.tests += static_cast<float>(trace.tests);
}

// Takes one sample of a pixel. kernels/path.glsl shares the code of a turn (shared/path.h), but its loop
// goes through all samples of a block, and no invocation leaves it before its neighbours.
PathSample takeSample(const Render& render, const uint x, const uint y, const uint index) {
    PathSample taken = startSample(render.camera, render.settings, x, y, index);
    while (taken.path.isAlive) {
        const Path path = taken.path;
        const Ray ray = makeRay(render.structure.lattice, path.origin, 0.0f, path.dir, kFarthest);
        const auto [trace, inWay] =
            traceOpaque(render, ray, HitQuery::closest, taken.at, bounceDimension(path.bounce, kBounceAlpha),
                        passing(render.scene, render.settings, path));
        count(taken, trace);
        ++taken.rays;
        if (trace.hit.triangleId == kNoTriangle) {
            return afterLeaving(taken, leaveScene(render.scene, render.settings, path));
        }
        const TriangleRecord& triangle = render.structure.triangles[trace.recordIndex];
        const float t = hitDistance(ray, trace.hit);
        const PathStep step =
            meetSurface(render.scene, render.settings, path, ray, t, triangle, inWay, taken.at);
        taken = afterStep(render.camera, taken, step, t, trace.hit.triangleId);
        if (step.shadow.isNeeded) {
            const Ray toLight = makeRay(render.structure.lattice, step.shadow.origin, 0.0f, step.shadow.dir,
                                        step.shadow.tMax);
            const auto [blocker, ofLight] = traceOpaque(
                render, toLight, HitQuery::any, taken.at, bounceDimension(path.bounce, kBounceLightAlpha),
                shadowPassing(render.scene, render.settings, step.path));
            count(taken, blocker);
            ++taken.shadowRays;
            taken = afterShadow(taken, step.shadow.gain, ofLight);
        }
    }
    return taken;
}

} // namespace

bool takeBlockByJudge(const AccelerationStructure& structure, const ShadingScene& scene,
                      const PathSettings& settings, const Camera& camera, const PixelRect& area,
                      const std::uint32_t firstSample, const std::uint32_t samples,
                      const FilmRequest& request, FilmData& block, const OnProgress& onProgress) {
    const Render render{structure, scene, settings, camera};
    const uint tilesPerRow = (area.width() + kTileSide - 1) / kTileSide;
    const uint tiles = tilesPerRow * ((area.height() + kTileSide - 1) / kTileSide);
    // Calls `visit` with each pixel of the area that is in the tile.
    const auto forEachPixel = [&](const uint tile, const auto& visit) {
        const uint left = tile % tilesPerRow * kTileSide;
        const uint top = tile / tilesPerRow * kTileSide;
        for (uint y = top; y < std::min(top + kTileSide, area.height()); ++y) {
            for (uint x = left; x < std::min(left + kTileSide, area.width()); ++x) {
                visit(x, y, std::size_t{y} * area.width() + x);
            }
        }
    };
    std::vector<uint> missing;
    for (uint tile = 0; tile < tiles; ++tile) {
        bool isWhole = true;
        forEachPixel(tile, [&](uint, uint, const std::size_t index) {
            isWhole = isWhole && block.pixels[index].samples >= samples;
        });
        if (!isWhole) {
            missing.push_back(tile);
        }
    }
    const auto takeSamples = [&](const uint x, const uint y, const std::size_t index) {
        FilmPixel& pixel = block.pixels[index];
        while (pixel.samples < samples) {
            const PathSample taken =
                takeSample(render, area.left + x, area.top + y, firstSample + pixel.samples);
            if (!block.light.empty()) {
                block.light[index] = endSampleLight(block.light[index], taken);
            }
            if (!block.hits.empty() && taken.first.triangleId != kNoTriangle) {
                block.addHit(index, request.groups[taken.first.triangleId]);
            }
            pixel = endSample(pixel, taken);
        }
    };
    const auto whole = static_cast<double>(tiles - missing.size());
    const auto onPart = [&](const double part) {
        return !onProgress || onProgress((whole + part * static_cast<double>(missing.size())) / tiles);
    };
    return forEachPiece(
        static_cast<unsigned>(missing.size()),
        [&](const unsigned piece) { forEachPixel(missing[piece], takeSamples); }, onPart);
}

FilmData renderPathsByJudge(const AccelerationStructure& structure, const ShadingScene& scene,
                            const PathSettings& settings, const Camera& camera, const std::uint32_t samples,
                            const FilmRequest& request) {
    const PixelRect area{0, 0, camera.width, camera.height};
    FilmData film(area.pixelCount(), request.parts);
    for (std::uint32_t first = 0; first < samples; first += kBlockSamples) {
        FilmData block(area.pixelCount(), request.parts);
        takeBlockByJudge(structure, scene, settings, camera, area, first,
                         std::min(kBlockSamples, samples - first), request, block);
        addBlock(film, block);
    }
    return film;
}

} // namespace metamarch

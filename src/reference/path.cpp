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

// Finds the closest triangle that is opaque for this path, or any such triangle. kernels/path.glsl has
// another loop, because of llvmpipe.
TraceResult traceOpaque(const Render& render, const Ray& given, const HitQuery query, const PixelSample at,
                        const uint dimension, const uint passed) {
    if (!hasFeature(render.scene, kFeatureAlpha | kFeatureCatcher)) {
        return traceKdStack(render.structure, given, query);
    }
    Ray ray = given;
    TraceResult result;
    while (true) {
        TraceResult next = traceKdStack(render.structure, ray, HitQuery::closest);
        next.steps += result.steps;
        next.tests += result.tests;
        result = next;
        if (result.hit.triangleId == kNoTriangle ||
            isThere(render.scene, ray, render.structure.triangles[result.recordIndex], at, dimension,
                    passed)) {
            return result;
        }
        ray.tMin = result.hit.t;
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
        const TraceResult trace =
            traceOpaque(render, ray, HitQuery::closest, taken.at, bounceDimension(path.bounce, kBounceAlpha),
                        passedMaterial(render.settings, path));
        count(taken, trace);
        ++taken.rays;
        if (trace.hit.triangleId == kNoTriangle) {
            return afterLeaving(taken, leaveScene(render.scene, render.settings, path));
        }
        const TriangleRecord& triangle = render.structure.triangles[trace.recordIndex];
        const float t = ray.shift + trace.hit.t;
        const PathStep step = meetSurface(render.scene, render.settings, path, ray, t, triangle, taken.at);
        taken = afterStep(render.camera, taken, step, t, trace.hit.triangleId);
        if (step.shadow.isNeeded) {
            const Ray toLight = makeRay(render.structure.lattice, step.shadow.origin, 0.0f, step.shadow.dir,
                                        step.shadow.tMax);
            const TraceResult blocker = traceOpaque(render, toLight, HitQuery::any, taken.at,
                                                    bounceDimension(path.bounce, kBounceLightAlpha),
                                                    passedMaterial(render.settings, step.path));
            count(taken, blocker);
            ++taken.shadowRays;
            if (blocker.hit.triangleId == kNoTriangle) {
                taken = afterShadow(taken, path.bounce, step.shadow.gain);
            }
        }
    }
    return taken;
}

} // namespace

bool takeBlockOnCpu(const AccelerationStructure& structure, const ShadingScene& scene,
                    const PathSettings& settings, const Camera& camera, const PixelRect& area,
                    const std::uint32_t firstSample, const std::uint32_t samples, const FilmRequest& request,
                    FilmData& block, const OnProgress& onProgress) {
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

FilmData renderPathsOnCpu(const AccelerationStructure& structure, const ShadingScene& scene,
                          const PathSettings& settings, const Camera& camera, const std::uint32_t samples,
                          const FilmRequest& request) {
    const PixelRect area{0, 0, camera.width, camera.height};
    FilmData film(area.pixelCount(), request.parts);
    for (std::uint32_t first = 0; first < samples; first += kBlockSamples) {
        FilmData block(area.pixelCount(), request.parts);
        takeBlockOnCpu(structure, scene, settings, camera, area, first,
                       std::min(kBlockSamples, samples - first), request, block);
        addBlock(film, block);
    }
    return film;
}

} // namespace metamarch

// SPDX-License-Identifier: MIT
#include "metamarch/reference/path.h"

#include "metamarch/reference/trace.h"
#include "metamarch/shared/path.h"

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
TraceResult traceAlphaTested(const Render& render, const Ray& given, const HitQuery query,
                             const PixelSample at, const uint dimension) {
    if (!hasFeature(render.scene, kFeatureAlpha)) {
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
            isThere(render.scene, ray, render.structure.triangles[result.recordIndex], at, dimension)) {
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
        const TraceResult trace = traceAlphaTested(render, ray, HitQuery::closest, taken.at,
                                                   bounceDimension(path.bounce, kBounceAlpha));
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
            const TraceResult blocker = traceAlphaTested(render, toLight, HitQuery::any, taken.at,
                                                         bounceDimension(path.bounce, kBounceLightAlpha));
            count(taken, blocker);
            ++taken.shadowRays;
            if (blocker.hit.triangleId == kNoTriangle) {
                taken = afterShadow(taken, path.bounce, step.shadow.gain);
            }
        }
    }
    return taken;
}

// Adds the block of samples [first, end) of the pixel with this index to the film.
void addBlock(const Render& render, const FilmRequest& request, const uint index, const uint first,
              const uint end, FilmData& film) {
    FilmPixel block = emptyPixel();
    LightParts light = noLight();
    for (uint sample = first; sample < end; ++sample) {
        const PathSample taken =
            takeSample(render, index % render.camera.width, index / render.camera.width, sample);
        if (!film.hits.empty() && taken.first.triangleId != kNoTriangle) {
            film.addHit(index, request.groups[taken.first.triangleId]);
        }
        light = endSampleLight(light, taken);
        block = endSample(block, taken);
    }
    FilmPixel& pixel = film.pixels[index];
    if (!film.light.empty()) {
        film.light[index] = addPixelLight(pixel, film.light[index], light);
    }
    pixel = addPixel(pixel, block);
}

} // namespace

FilmData renderPathsOnCpu(const AccelerationStructure& structure, const ShadingScene& scene,
                          const PathSettings& settings, const Camera& camera, const std::uint32_t samples,
                          const FilmRequest& request, const OnProgress& onProgress) {
    FilmData film(std::size_t{camera.width} * camera.height, request.parts);
    const Render render{structure, scene, settings, camera};
    const auto renderRow = [&](const uint y) {
        for (uint x = 0; x < camera.width; ++x) {
            for (uint first = 0; first < samples; first += kBlockSamples) {
                addBlock(render, request, y * camera.width + x, first,
                         std::min(first + kBlockSamples, samples), film);
            }
        }
    };
    forEachRow(camera.height, renderRow, onProgress);
    return film;
}

} // namespace metamarch

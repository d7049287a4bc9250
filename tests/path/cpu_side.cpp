// SPDX-License-Identifier: MIT
#include "path/cpu_side.h"

#include "metamarch/reference/eye_media.h"
#include "metamarch/reference/path.h"

#include <cstring>

namespace metamarch::tests {

CpuSide::CpuSide(const PathScene& given, const Picture size)
    : made(given), structure(buildAccelerationStructure(made.scene, {})), shading(shadingOf(made)),
      camera(makeCamera(made.view, size.width, size.height, made.camera)) {}

render::PathWork CpuSide::ofSampler(const PathWork& work) const {
    PathSettings settings = settingsOf(shading, work);
    settings.eyeMedia = mediaAt(structure, shading, camera.eye);
    return {
        settings, camera, {0, 0, camera.width, camera.height}, {work.filmParts, made.scene.triangleMaterial}};
}

FilmData CpuSide::filmByJudge(const PathWork& work) const {
    const render::PathWork given = ofSampler(work);
    return renderPathsByJudge(structure, shading, given.settings, camera, work.samples, given.request);
}

std::vector<ProcessorKernel> CpuSide::kernels() const {
    return pathKernels(shading.features | cameraFeatures(camera));
}

FilmData CpuSide::filmOnCpu(const PathWork& work, const Kernel kernel) const {
    render::CpuPathSampler sampler(structure, shading, ofSampler(work), kernel);
    return render::takeSamples(sampler, work.samples);
}

bool isSamePixel(const FilmPixel& a, const FilmPixel& b) {
    return std::memcmp(&a, &b, offsetof(FilmPixel, steps)) == 0;
}

} // namespace metamarch::tests

// The path tracer for `metamarch render`.
#pragma once
#include "metamarch/cli/rendering.h"
#include "metamarch/shared/shading_scene.h"

namespace metamarch::cli {

Rendering renderPaths(const RenderJob& job, const ShadingScene& shading, const PathSettings& settings,
                      std::uint32_t samples);

} // namespace metamarch::cli

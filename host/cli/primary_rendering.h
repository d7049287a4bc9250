// The `primary` integrator for `metamarch render`.
#pragma once
#include "metamarch/cli/rendering.h"

namespace metamarch::cli {

Rendering renderPrimary(const RenderJob& job);

} // namespace metamarch::cli

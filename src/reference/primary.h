// The `primary` integrator on the CPU, over the stack traversal.
#pragma once
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/shared/primary.h"

#include <atomic>
#include <functional>
#include <span>
#include <vector>

namespace metamarch {

// One pixel for each of camera.width * camera.height, in rows from the top. Multi-threaded; `onRows` is told
// of finished rows, from any thread.
std::vector<FilmPixel> renderPrimary(const AccelerationStructure& structure,
                                        std::span<const ShadingMaterial> materials,
                                        std::span<const std::uint32_t> materialOfTriangle,
                                        const Camera& camera,
                                        const std::function<void(unsigned rows)>& onRows);

} // namespace metamarch

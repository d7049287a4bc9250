// SPDX-License-Identifier: MIT
// What the path tracer reads besides the structure, as arrays for the bindings of its kernel.
#pragma once
#include "metamarch/shared/shading_scene.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace metamarch::render {

struct ShadingArray {
    std::uint32_t binding;
    const char* name;
    std::span<const std::byte> data;
};

// Refers to the scene, which must outlive it.
class ShadingArrays {
  public:
    explicit ShadingArrays(const ShadingScene& scene);
    ShadingArrays(const ShadingArrays&) = delete;
    ShadingArrays& operator=(const ShadingArrays&) = delete;

    // None is empty: what the scene lacks has an entry of zeros.
    const std::vector<ShadingArray>& arrays() const { return arrays_; }

  private:
    std::vector<std::byte> lights_;
    std::vector<ShadingArray> arrays_;
};

} // namespace metamarch::render

// SPDX-License-Identifier: MIT
// The views of inspect_view.h: their names in menus and on command lines, and what they need.
#pragma once
#include "metamarch/shared/inspect_view.h"

#include <array>
#include <cstdint>
#include <string_view>

namespace metamarch::render {

// The data that a view's kernel reads. Each kind has a pipeline of its own, because drivers that run both
// sides of a branch would look up textures for views that need none.
enum class ViewReads { hits, materials, parameters, cells };

// The meaning of InspectPush::scaleMax for a view.
enum class ViewScale { none, count, distance };

struct ViewName {
    std::string_view name;
    std::uint32_t view; // kView…
    ViewReads reads;
    ViewScale scale = ViewScale::none;
};

// The order is that of the numbers, so kViewNames[view] is the view's row. Menus show the same order.
inline constexpr auto kViewNames = std::to_array<ViewName>({
    {"steps", kViewSteps, ViewReads::hits, ViewScale::count},
    {"tests", kViewTests, ViewReads::hits, ViewScale::count},
    {"depth", kViewDepth, ViewReads::hits, ViewScale::distance},
    {"normals", kViewNormals, ViewReads::hits},
    {"shading normals", kViewShadingNormals, ViewReads::materials},
    {"uvs", kViewUvs, ViewReads::hits},
    {"albedo", kViewAlbedo, ViewReads::materials},
    {"metallic", kViewMetallic, ViewReads::parameters},
    {"roughness", kViewRoughness, ViewReads::parameters},
    {"emissive", kViewEmissive, ViewReads::parameters},
    {"transmission", kViewTransmission, ViewReads::parameters},
    {"triangle id", kViewTriangleId, ViewReads::hits},
    {"material id", kViewMaterialId, ViewReads::hits},
    {"leaf id", kViewLeafId, ViewReads::cells},
    {"cell borders", kViewCellBorders, ViewReads::cells},
    {"exit boxes", kViewExitBoxes, ViewReads::cells},
    {"headlight", kViewHeadlight, ViewReads::materials},
});

} // namespace metamarch::render

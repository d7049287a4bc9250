// SPDX-License-Identifier: MIT
// The views of inspect_view.h: how menus and command lines name them, and what they want.
#pragma once
#include "metamarch/shared/inspect_view.h"

#include <array>
#include <cstdint>
#include <string_view>

namespace metamarch::render {

// What a view's kernel reads. Drivers that run both sides of a branch would look textures up for the views
// that want none.
enum class ViewReads { hits, materials, cells };

// What InspectPush::scaleMax is to a view.
enum class ViewScale { none, count, distance };

struct ViewName {
    std::string_view name;
    std::uint32_t view; // kView…
    ViewReads reads;
    ViewScale scale = ViewScale::none;
};

// In the order of menus, which is that of the numbers: kViewNames[view] is the view's row.
inline constexpr auto kViewNames = std::to_array<ViewName>({
    {"steps", kViewSteps, ViewReads::hits, ViewScale::count},
    {"tests", kViewTests, ViewReads::hits, ViewScale::count},
    {"depth", kViewDepth, ViewReads::hits, ViewScale::distance},
    {"normals", kViewNormals, ViewReads::hits},
    {"shading normals", kViewShadingNormals, ViewReads::materials},
    {"uvs", kViewUvs, ViewReads::hits},
    {"albedo", kViewAlbedo, ViewReads::materials},
    {"triangle id", kViewTriangleId, ViewReads::hits},
    {"material id", kViewMaterialId, ViewReads::hits},
    {"leaf id", kViewLeafId, ViewReads::cells},
    {"cell borders", kViewCellBorders, ViewReads::cells},
    {"exit boxes", kViewExitBoxes, ViewReads::cells},
});

} // namespace metamarch::render

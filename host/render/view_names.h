// The views of inspect_view.h as menus and command lines name them.
#pragma once
#include "metamarch/shared/inspect_view.h"

#include <array>
#include <cstdint>
#include <string_view>

namespace metamarch::render {

struct ViewName {
    std::string_view name;
    std::uint32_t view; // kView…
    bool isScaled;      // scaleMax matters
};

inline constexpr std::array<ViewName, kInspectViews> kViewNames = {{
    {"steps", kViewSteps, true},
    {"tests", kViewTests, true},
    {"depth", kViewDepth, true},
    {"normals", kViewNormals, false},
    {"shading normals", kViewShadingNormals, false},
    {"uvs", kViewUvs, false},
    {"albedo", kViewAlbedo, false},
    {"triangle id", kViewTriangleId, false},
    {"material id", kViewMaterialId, false},
    {"leaf id", kViewLeafId, false},
    {"cell borders", kViewCellBorders, false},
    {"exit boxes", kViewExitBoxes, false},
}};

} // namespace metamarch::render

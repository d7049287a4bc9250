// SPDX-License-Identifier: MIT
// Lists for `info` what a scene holds that a user can choose or look for by name.
#pragma once
#include "metamarch/scene/scene.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace metamarch::cli {

// Lists, in the order of the indices that options take: scenes (names), cameras (name projection eye forward
// up, and verticalFov in degrees or height), animations (name seconds), variants (names), lights (name type
// color intensity, and position or direction), materials (name triangles).
nlohmann::ordered_json reportContents(const Scene& scene);

// The same as text, a line for each element and none for an empty list.
std::string contentsText(const Scene& scene);

} // namespace metamarch::cli

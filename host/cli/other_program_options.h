// SPDX-License-Identifier: MIT
// Knows the options of other programs, and what this program calls them.
#pragma once
#include <string>
#include <string_view>

namespace metamarch::cli {

// Returns this program's name of an option of F3D, Blender, Mitsuba, pbrt and others: "`--spp`" for
// "--samples". An answer that begins with "`--" names an option, which a sub-command may lack; the other
// answers are sentences. Returns "" for an unknown word.
std::string_view answerTo(std::string_view option);

} // namespace metamarch::cli

// SPDX-License-Identifier: MIT
// What the options of other programs are called here.
#pragma once
#include <string>
#include <string_view>

namespace metamarch::cli {

// What an option of F3D, Blender, Mitsuba, pbrt and their kin is called here: "`--spp`" for "--samples". An
// answer that begins with "`--" names an option, which a sub-command may lack; others are whole sentences.
// Empty where the word is not known.
std::string_view answerTo(std::string_view option);

} // namespace metamarch::cli

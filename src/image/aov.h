// SPDX-License-Identifier: MIT
// What a picture can say of a pixel: the list of all channels (AOVs, arbitrary output variables).
#pragma once
#include "metamarch/shared/film.h"

#include <glm/glm.hpp>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace metamarch {

enum class AovWriter { everyIntegrator, pathTracer }; // pathTracer: path, direct and ao
enum class AovKind { picture, work }; // work: what a traversal did, which no comparison judges

struct Aov {
    std::string_view names;   // as EXR wants them, with a space between: "albedo.R albedo.G albedo.B"
    std::string_view meaning; // with its unit
    glm::vec3 (*value)(const FilmPixel& pixel); // as many numbers of it as there are names
    AovWriter writer = AovWriter::everyIntegrator;
    AovKind kind = AovKind::picture;

    std::vector<std::string> channels() const; // the names, one by one
};

// The table, in the order of a picture's channels.
std::span<const Aov> aovs();

// Those that `render --integrator` writes: of "primary", or of the path tracer's.
std::vector<Aov> aovsOf(std::string_view integrator);

// The list for people, a line each.
std::string aovText();

} // namespace metamarch

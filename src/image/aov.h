// SPDX-License-Identifier: MIT
// The table of all channels of a picture (AOVs, arbitrary output variables).
#pragma once
#include "metamarch/shared/film.h"

#include <glm/glm.hpp>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace metamarch {

enum class AovWriter { everyIntegrator, pathTracer }; // pathTracer: path, direct and ao
enum class AovKind { picture, work }; // work: counts of a traversal, which comparisons do not judge

struct Aov {
    std::string_view names;   // EXR names, separated by spaces: "albedo.R albedo.G albedo.B"
    std::string_view meaning; // with its unit
    glm::vec3 (*value)(const FilmPixel& pixel); // one component for each name; further ones are ignored
    AovWriter writer = AovWriter::everyIntegrator;
    AovKind kind = AovKind::picture;

    std::vector<std::string> channels() const; // the single names
};

// Returns the table in the order of a picture's channels.
std::span<const Aov> aovs();

// Returns what the primary integrator writes (everyIntegrator), or what the path tracer writes: everything.
std::vector<Aov> aovsOf(AovWriter writer);

// Returns the table as text, one line per row.
std::string aovText();

} // namespace metamarch

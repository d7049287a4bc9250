// SPDX-License-Identifier: MIT
// Reports what rendering took, for --stats and for the last line.
#pragma once
#include "metamarch/render/render.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace metamarch::cli {

// Keys: device driver traversal integrator size seconds.render stepsPerRay testsPerRay mraysPerSecond; on a
// device also seconds.upload seconds.firstSubmission seconds.device. Of `primary`: rays hits. Of the others:
// samplesPerPixel rejectedSamples rays shadowRays msamplesPerSecond, on a device also submissions. A dot
// opens an object.
nlohmann::ordered_json reportRender(const render::RenderResult& result);

// Returns in words what a ray or a sample took.
std::string summaryOf(const render::RenderResult& result);

} // namespace metamarch::cli

// SPDX-License-Identifier: MIT
// A box of the scene with filled faces, of which surfaces that lie before them hide parts.
#pragma once
#include "metamarch/shared/camera.h"
#include "metamarch/viewer/scene_loader.h"

#include <glm/glm.hpp>

#include <array>
#include <vector>

namespace metamarch::viewer {

// A point of a face, in pixels of the picture.
struct SolidPoint {
    glm::vec2 place;
    bool isSeen; // no surface lies before it
};

struct SolidPart {
    std::array<SolidPoint, 4> corners; // around it
    float light;                       // from 0 to 1: that of a lamp at the eye
};

// A part of an edge of the box.
struct SolidEdge {
    std::array<glm::vec2, 2> ends;
    bool isSeen;
};

struct SolidBox {
    std::vector<SolidPart> parts; // of the faces that face the eye
    std::vector<SolidEdge> edges;
};

// Returns nothing for panoramas. It traces a ray for each point of a
// grid, on the CPU, so keep the result while camera and box stay.
SolidBox solidBox(const LoadedScene& scene, const Camera& camera, const Bounds& box);

} // namespace metamarch::viewer

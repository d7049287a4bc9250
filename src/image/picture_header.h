// What the header of a picture says of how it was made.
#pragma once
#include "metamarch/image/image.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <string>

namespace metamarch {

struct PictureOrigin {
    std::string software; // with its version
    std::string device;
    std::string driver;
    std::string traversal;
    std::string integrator;
    std::string scene;  // file
    double seconds;     // that rendering took
    std::string camera; // its name
    glm::vec3 eye;
    glm::vec3 forward;
    glm::vec3 up;
};

void addHeader(Image& image, const PictureOrigin& origin);

// What a path tracer was asked for besides.
void addSampling(Image& image, std::uint32_t samples, std::uint32_t seed, std::uint32_t maxBounces);

// A PNG knows no light beside its alpha, and a background belongs to what a path tracer draws: nothing may
// show through it. Renames the alpha.
void makeOpaque(Image& image);

} // namespace metamarch

// SPDX-License-Identifier: MIT
// Ray cones: the footprint of a ray in the scene. T. Akenine-Moeller, C. Crassin, J. Boksansky, L. Belcour,
// A. Panteleev, O. Wright, "Improved Shader and Texture Level of Detail Using Ray Cones", JCGT 10(1), 2021.
// The paper uses the longer axis of the ellipse in which a cone cuts a surface; we use the area of the
// ellipse: see seenPart.
#ifndef METAMARCH_SHARED_RAY_CONE_H
#define METAMARCH_SHARED_RAY_CONE_H
#include "camera.h"
#include "triangle.h"

SHARED_BEGIN

// The cross-section is a square: its area is the square of the width.
struct RayCone {
    float width;  // at the ray's origin, world units
    float spread; // increase of the width per unit of length
};

// Returns the cone of a pixel for a camera ray in direction `dir`. A lens does not widen it: samples alone
// blur what is out of focus.
SHARED_FN RayCone cameraCone(const Camera camera, const vec3 dir) {
    const float pixels = float(camera.width) * float(camera.height);
    if (isPanorama(camera)) {
        const float up = dotProduct(dir, camera.dirDown);
        const float sine = sqrt(max(1.0f - up * up, 0.0f));
        return RayCone(0.0f, sqrt(kMapArea * sine / pixels));
    }
    // The steps span half the picture, hence the factors 4. A pixel has the solid angle `angle / pixels` at
    // unit depth; away from the axis it is farther away by 1 / cosine and tilted by the cosine.
    const float area = 4.0f * abs(dotProduct(crossProduct(camera.eyeRight, camera.eyeDown), camera.forward));
    const float angle = 4.0f * abs(dotProduct(crossProduct(camera.dirRight, camera.dirDown), camera.forward));
    const float cosine = max(dotProduct(dir, camera.forward), 0.0f);
    return RayCone(sqrt(area / pixels), sqrt(angle / pixels * cosine) * cosine);
}

SHARED_FN float widthAt(const RayCone cone, const float t) { return cone.width + cone.spread * t; }

// Fraction of the solid angle 1 / pdf of a sampled direction that the cone covers.
const float kScatteredPart = 0.25f;

// Returns the cone of the ray that leaves a surface at which the incoming cone has this width.
SHARED_FN RayCone scatteredCone(const RayCone cone, const float width, const float pdf) {
    return RayCone(width, sqrt(cone.spread * cone.spread + kScatteredPart / pdf));
}

// Returns the area of a cone's cut through the triangle's plane, as a fraction of twice the triangle's area,
// for sample `index`, from 0, of a pixel. The more samples a pixel has, the less the mip levels need to
// smooth: the side of the footprint falls with the power 3/4 of their number, like the error of stratified
// samples. So the first sample has the least noise, and many samples are as sharp as without mip levels.
SHARED_FN float seenPart(const TriangleRecord triangle, const vec3 dir, const float width, const uint index) {
    const float across = abs(dotProduct(scaledNormal(triangle.v0, triangle.v1, triangle.v2), dir));
    const float count = float(index + 1u);
    return width * width / (across * (count * sqrt(count)));
}

SHARED_END
#endif

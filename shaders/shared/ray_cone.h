// Ray cones: how wide a part of the scene a ray stands for.
// T. Akenine-Moeller, C. Crassin, J. Boksansky, L. Belcour, A. Panteleev, O. Wright, "Improved Shader and
// Texture Level of Detail Using Ray Cones", JCGT 10(1), 2021. In place of the longer axis of the ellipse that
// a cone cuts out of a surface stands its area: see seenPart.
#ifndef METAMARCH_SHARED_RAY_CONE_H
#define METAMARCH_SHARED_RAY_CONE_H
#include "camera.h"
#include "triangle.h"

SHARED_BEGIN

// Square: the area across the ray is that of its width, times itself.
struct RayCone {
    float width;  // at the ray's origin, in world units
    float spread; // what it gains per unit of length
};

// Of a pixel, for a ray of it in direction `dir`. A lens does not widen it: what is out of focus is blurred
// by samples alone.
SHARED_FN RayCone cameraCone(const Camera camera, const vec3 dir) {
    const float pixels = float(camera.width) * float(camera.height);
    if (camera.projection == kProjectionPanorama) {
        const float up = dotProduct(dir, camera.dirDown);
        const float sine = sqrt(max(1.0f - up * up, 0.0f));
        return RayCone(0.0f, sqrt(kMapArea * sine / pixels));
    }
    // The steps lead half across the picture. A pixel has `angle` at unit depth; aside that lies farther away
    // by 1 / cosine, and leans by it.
    const float area = 4.0f * abs(dotProduct(crossProduct(camera.eyeRight, camera.eyeDown), camera.forward));
    const float angle = 4.0f * abs(dotProduct(crossProduct(camera.dirRight, camera.dirDown), camera.forward));
    const float cosine = max(dotProduct(dir, camera.forward), 0.0f);
    return RayCone(sqrt(area / pixels), sqrt(angle / pixels * cosine) * cosine);
}

SHARED_FN float widthAt(const RayCone cone, const float t) { return cone.width + cone.spread * t; }

// What a sampled direction stands for, of the solid angle 1 / pdf that it is drawn for.
const float kScatteredPart = 0.25f;

// Of the ray that leaves a surface which the cone meets with this width.
SHARED_FN RayCone scatteredCone(const RayCone cone, const float width, const float pdf) {
    return RayCone(width, sqrt(cone.spread * cone.spread + kScatteredPart / pdf));
}

// The area that a cone of this width cuts out of the triangle's plane, of twice the triangle's, for sample
// number `index`, from 0, of a pixel. The more samples went before, the less is left for levels to smooth:
// the side falls with the power 3/4 of their number, as the error of stratified samples does. So the first
// sample has the least noise, and many are as sharp as without levels.
SHARED_FN float seenPart(const TriangleRecord triangle, const vec3 dir, const float width, const uint index) {
    const float across = abs(dotProduct(scaledNormal(triangle.v0, triangle.v1, triangle.v2), dir));
    const float count = float(index + 1u);
    return width * width / (across * (count * sqrt(count)));
}

SHARED_END
#endif

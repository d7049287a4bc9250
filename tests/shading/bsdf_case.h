// SPDX-License-Identifier: MIT
// Evaluates and samples a BSDF once, on CPU and device.
#ifndef METAMARCH_TESTS_SHADING_BSDF_CASE_H
#define METAMARCH_TESTS_SHADING_BSDF_CASE_H
#include "metamarch/shared/bsdf.h"

SHARED_BEGIN

struct BsdfCase {
    SurfaceMaterial material;
    vec3 geometricNormal;
    float uLobe;
    vec3 shadingNormal;
    float uDirectionX;
    vec3 coatNormal;
    float uDirectionY;
    vec3 tangent;
    uint padding0;
    vec3 wo;
    uint padding1;
    vec3 wi;
    uint padding2;
};

struct BsdfAnswer {
    vec3 value;
    float pdf;
    vec3 sampleWi;
    float samplePdf;
    vec3 sampleWeight;
    uint sampleFlags;
    vec3 albedo;
    float emissionScale;
};

SHARED_FN BsdfAnswer answer(const BsdfCase asked) {
    const SurfaceFrame frame = makeSurfaceFrame(asked.geometricNormal, asked.shadingNormal, asked.coatNormal,
                                                asked.tangent, asked.wo);
    const Bsdf bsdf = makeBsdf(asked.material, frame, asked.wo);
    const BsdfValue found = evalBsdf(bsdf, asked.wi);
    const BsdfSample drawn = sampleBsdf(bsdf, asked.uLobe, vec2(asked.uDirectionX, asked.uDirectionY));
    return BsdfAnswer(found.value, found.pdf, drawn.wi, drawn.pdf, drawn.weight, drawn.flags, bsdf.albedo,
                      bsdf.emissionScale);
}

SHARED_ASSERT_SIZE(BsdfCase, 208)
SHARED_ASSERT_SIZE(BsdfAnswer, 64)

SHARED_END
#endif

// SPDX-License-Identifier: MIT
// Directional albedos: the fraction of the light from one direction that a lobe scatters, over all
// directions. Cosines are positive.
//
// tools/fit_albedo fits these polynomials to numerical integrals. The numbers below are those of an older
// fit, whose script was not kept; they stay because pictures depend on their bits. A new fit gives other
// numbers with similar errors, smaller ones for glass of an ior near 1.05. Each comment names the largest
// errors over the whole domain, and `tools/fit_albedo --check` fails where one is above that. tests/shading
// holds the BSDF made of the fits to its furnace.
#ifndef METAMARCH_SHARED_ALBEDO_H
#define METAMARCH_SHARED_ALBEDO_H
#include "math.h"

SHARED_BEGIN

// 0 at grazing, 1 at normal incidence. The albedos of microfacets depend, for small alpha, on cosine / alpha.
SHARED_FN float facetSlope(const float cosine, const float alpha) {
    return cosine * (1.0f + alpha) / (cosine + alpha);
}

// A factor for each direction that gives single-scatter microfacets f that reflect all light (Fresnel term 1)
// the energy back that other facets shadow: the integral over wi of balance(wo) f balance(wi) cos is 1 for
// every wo, and the product stays reciprocal. It is the one scaling of that kind: R. Sinkhorn, "Diagonal
// Equivalence to Matrices with Prescribed Row and Column Sums", 1967. The relative error is
// at most 0.14 %.
SHARED_FN float facetBalance(const float cosine, const float alpha) {
    const float x = facetSlope(cosine, alpha);
    const float c0 =
        0.96809044f +
        alpha * (0.025552463f + alpha * (-0.8538071f + alpha * (0.83431207f + alpha * -0.26652086f)));
    const float c1 = 0.22183423f +
                     alpha * (-1.6131915f + alpha * (10.915851f + alpha * (-14.82749f + alpha * 6.5301359f)));
    const float c2 =
        0.019092581f + alpha * (21.42101f + alpha * (-116.493f + alpha * (171.05629f + alpha * -79.466683f)));
    const float c3 = -1.0088791f +
                     alpha * (-120.22602f + alpha * (651.75559f + alpha * (-976.10014f + alpha * 462.2095f)));
    const float c4 =
        10.62028f + alpha * (294.80657f + alpha * (-1733.5373f + alpha * (2681.8327f + alpha * -1294.2058f)));
    const float c5 = -30.469009f +
                     alpha * (-326.57037f + alpha * (2278.0726f + alpha * (-3690.6123f + alpha * 1824.335f)));
    const float c6 =
        32.044199f +
        alpha * (149.92185f + alpha * (-1420.5838f + alpha * (2446.2102f + alpha * -1245.3629f)));
    const float c7 = -11.396781f +
                     alpha * (-17.715866f + alpha * (330.7138f + alpha * (-616.37607f + alpha * 325.22626f)));
    const float balance = c0 + x * (c1 + x * (c2 + x * (c3 + x * (c4 + x * (c5 + x * (c6 + x * c7))))));
    return balance;
}

struct FacetAlbedo {
    float whole;   // for the Fresnel term 1
    float grazing; // for Schlick's weight; for f0 and f90 it is f0 * (whole - grazing) + f90 * grazing
};

// The albedo of single-scatter microfacets. The error of `whole` is at most 0.4 %, that of `grazing` 0.6 %.
SHARED_FN FacetAlbedo facetAlbedo(const float cosine, const float alpha) {
    const float x = facetSlope(cosine, alpha);
    const float c0 =
        1.0032524f +
        alpha * (-0.052035878f + alpha * (0.14121674f + alpha * (-0.15002628f + alpha * 0.054515797f)));
    const float c1 =
        -0.42163384f +
        alpha * (2.5720385f + alpha * (-11.745003f + alpha * (12.432942f + alpha * -5.0098519f)));
    const float c2 =
        2.4493422f + alpha * (-27.55071f + alpha * (105.05584f + alpha * (-132.27692f + alpha * 60.274518f)));
    const float c3 = -11.828256f +
                     alpha * (129.16613f + alpha * (-475.11929f + alpha * (629.3374f + alpha * -294.97188f)));
    const float c4 = 24.100381f + alpha * (-273.57609f +
                                           alpha * (1005.3535f + alpha * (-1366.6382f + alpha * 648.51528f)));
    const float c5 =
        -20.384134f +
        alpha * (256.63636f + alpha * (-965.88143f + alpha * (1342.8983f + alpha * -643.45922f)));
    const float c6 = 6.0776311f + alpha * (-87.036477f +
                                           alpha * (339.70364f + alpha * (-483.44942f + alpha * 234.08856f)));
    const float whole = c0 + x * (c1 + x * (c2 + x * (c3 + x * (c4 + x * (c5 + x * c6)))));
    // The cube root of grazing / whole; at alpha 0 it would be (1 - cosine)^(5/3).
    const float l = sqrt(cosine * cosine + alpha * alpha);
    const float above = 0.99907504f + alpha * (-26.915747f + alpha * 181.21411f) +
                        l * (94.287472f + alpha * -124.05168f) +
                        cosine * (-59.136874f + alpha * 164.25073f + l * -399.54137f + cosine * 355.96074f);
    const float below = 1.0f + alpha * (-25.341781f + alpha * 515.50252f) +
                        l * (100.71807f + alpha * -238.39926f) +
                        cosine * (-64.099613f + alpha * 238.2512f + l * -727.4905f + cosine * 747.33358f);
    const float root = max(above / below, 0.0f);
    return FacetAlbedo(whole, whole * (root * root * root));
}

// The mean of facetAlbedo over the directions of a uniformly lit surface. The errors are at most
// 0.2 % and 0.1 %.
SHARED_FN FacetAlbedo meanFacetAlbedo(const float alpha) {
    const float whole =
        1.0016757f +
        alpha * (-0.14232282f + alpha * (-1.8047481f + alpha * (2.1653074f + alpha * -0.81243459f)));
    const float grazing =
        0.048514185f + alpha * (-0.16363778f + alpha * (0.20859986f + alpha * -0.090660828f));
    return FacetAlbedo(whole, grazing);
}

// Returns the fraction of the light that a single-scatter interface between air and glass reflects or
// transmits, for light that arrives in air, or in the glass if `isInside`. The fit is for cosines of at least
// 0.02 and an ior from 1.05 to 2.5; other values are clamped to these ranges. From air the relative error is
// at most 2 %, and 6 % for an ior below 1.1. From inside it is at most 6 %, and 13 % for an ior below 1.1.
SHARED_FN float glassAlbedo(const float cosine, const float alpha, const float ior, const bool isInside) {
    const float x = facetSlope(max(cosine, 0.02f), alpha);
    const float f = min(max(1.0f / ior, 0.4f), 0.95f);
    const float c0 =
        (0.89868755f +
         f * (0.38170369f + f * (-2.0149763f + f * (4.2701508f + f * (-3.3716438f + f * 0.91584919f))))) +
        alpha *
            ((0.51919421f + f * (0.28287183f + f * (0.26637633f + f * (-0.73366377f + f * -0.56052633f)))) +
             alpha * ((-1.885696f + f * (-0.78965978f + f * (-0.71708171f + f * 1.3230918f))) +
                      alpha * ((3.5722489f + f * (1.0073784f + f * 0.0029528208f)) +
                               alpha * ((-3.1498877f + f * -0.53432893f) + alpha * 1.0529108f))));
    const float c1 =
        (0.10986953f + f * (1.119284f + f * (-3.3953396f + f * (0.97467793f + f * 0.29750852f)))) +
        alpha * ((-1.5122683f + f * (-0.99071932f + f * (0.7049521f + f * 1.4024019f))) +
                 alpha * ((-1.5870919f + f * (2.7206471f + f * -2.1933796f)) +
                          alpha * ((0.11097087f + f * -0.16363314f) + alpha * 0.60470435f)));
    const float c2 = (-0.96836929f + f * (1.1247591f + f * (3.3468132f + f * -1.1222306f))) +
                     alpha * ((5.9208822f + f * (-0.13204666f + f * -0.88627271f)) +
                              alpha * ((1.1041852f + f * -0.032638762f) + alpha * -1.4083439f));
    const float c3 = (-0.58864233f + f * (-3.1088493f + f * -0.70964039f)) +
                     alpha * ((-7.749262f + f * 0.79107593f) + alpha * 0.79257177f);
    const float c4 = (3.5815772f + f * 1.3966633f) + alpha * 2.8485953f;
    const float c5 = -2.1425074f;
    const float d0 =
        (0.7379034f +
         f * (3.9847599f + f * (-23.360028f + f * (52.515352f + f * (-48.048733f + f * 14.887022f))))) +
        alpha * ((0.23852491f + f * (5.0280561f + f * (-2.3906118f + f * (-14.955723f + f * 9.8904355f)))) +
                 alpha * ((-1.5014672f + f * (-13.05745f + f * (18.086702f + f * -2.2372852f))) +
                          alpha * ((5.1799573f + f * (3.9100011f + f * -6.4689157f)) +
                                   alpha * ((-4.4165887f + f * 1.048701f) + alpha * 1.0993827f))));
    const float d1 =
        (-2.7783713f + f * (19.151775f + f * (-45.778767f + f * (37.110857f + f * -6.9514607f)))) +
        alpha * ((-2.0989621f + f * (-7.4113142f + f * (19.44967f + f * -9.2419863f))) +
                 alpha * ((3.0659121f + f * (4.6156276f + f * -4.8946909f)) +
                          alpha * ((-3.6467536f + f * 0.41882368f) + alpha * 0.86400059f)));
    const float d2 = (0.51316424f + f * (2.8497811f + f * (6.0995945f + f * -10.037269f))) +
                     alpha * ((2.2868437f + f * (-6.2252788f + f * 3.851826f)) +
                              alpha * ((-1.0932529f + f * -1.6828996f) + alpha * 1.6363347f));
    const float d3 = (-3.5838732f + f * (-5.0574313f + f * 7.0594005f)) +
                     alpha * ((1.2994894f + f * 1.0558588f) + alpha * -0.85070744f);
    const float d4 = (4.8359718f + f * -1.9294079f) + alpha * -0.84496381f;
    const float d5 = -1.1799649f;
    const float fromAir = c0 + x * (c1 + x * (c2 + x * (c3 + x * (c4 + x * c5))));
    const float fromWithin = d0 + x * (d1 + x * (d2 + x * (d3 + x * (d4 + x * d5))));
    return min(max(isInside ? fromWithin : fromAir, 0.1f), 1.0f);
}

// Returns the albedo of the sheen lobe of sheen.h with a white colour. The fit is raised by its error of 0.9
// %: the layer below receives one minus this albedo, and together they must not create energy. Smaller
// cosines are clamped to 0.01, which makes the albedo at most 0.014 too low.
SHARED_FN float sheenAlbedo(const float cosine, const float roughness) {
    const float x = sqrt(max(cosine, 0.01f));
    const float c0 =
        2.3357641f + roughness * (-7.1691108f + roughness * (10.937602f + roughness * -5.1053865f));
    const float c1 =
        -4.3929594f + roughness * (18.841603f + roughness * (-26.921573f + roughness * 12.113202f));
    const float c2 =
        -6.2313899f + roughness * (10.609937f + roughness * (-13.271061f + roughness * 6.3394459f));
    const float c3 =
        16.716797f + roughness * (-51.15591f + roughness * (71.272625f + roughness * -33.202763f));
    const float c4 =
        -8.3658196f + roughness * (28.330186f + roughness * (-40.814461f + roughness * 19.288508f));
    const float albedo = c0 + x * (c1 + x * (c2 + x * (c3 + x * c4)));
    return min(max(albedo + 0.009f, 0.0f), 1.0f);
}

SHARED_END
#endif

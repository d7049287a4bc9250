// Directional albedos: the part of the light from one direction that a lobe scatters in all. Fitted to
// integrals by VNDF quadrature; the largest error over the whole domain stands at each fit, and tests/shading
// holds the BSDF made of them to its furnace. Cosines are positive.
#ifndef METAMARCH_SHARED_ALBEDO_H
#define METAMARCH_SHARED_ALBEDO_H
#include "shared/math.h"

SHARED_BEGIN

// 0 at grazing, 1 at normal incidence. The albedos of microfacets depend, for small alpha, on cosine / alpha.
SHARED_FN float facetSlope(const float cosine, const float alpha) {
    return cosine * (1.0f + alpha) / (cosine + alpha);
}

// A factor for each direction that gives single-scatter microfacets f that reflect all light (Fresnel term 1)
// the energy back that other facets shadow: the integral over wi of balance(wo) f balance(wi) cos is 1 for
// every wo, and the product stays reciprocal. It is the one scaling of that kind: R. Sinkhorn, "Diagonal
// Equivalence to Matrices with Prescribed Row and Column Sums", 1967. Relative error 0.12 %.
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

// Of single-scatter microfacets. Errors 0.4 % for both.
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

// The mean of facetAlbedo over the directions of a uniformly lit surface. Errors 0.2 % and 0.1 %.
SHARED_FN FacetAlbedo meanFacetAlbedo(const float alpha) {
    const float whole =
        1.0016757f +
        alpha * (-0.14232282f + alpha * (-1.8047481f + alpha * (2.1653074f + alpha * -0.81243459f)));
    const float grazing =
        0.048514185f + alpha * (-0.16363778f + alpha * (0.20859986f + alpha * -0.090660828f));
    return FacetAlbedo(whole, grazing);
}

// What a single-scatter interface between air and glass reflects and transmits, seen from air (`isInside`
// false) or from within. Error 1.5 % from air and 2.7 % from within for a cosine above 0.02 and an ior
// from 1.05 to 2.5; beyond, the ends of these ranges stand in.
SHARED_FN float glassAlbedo(const float cosine, const float alpha, const float ior, const bool isInside) {
    const float x = facetSlope(max(cosine, 0.02f), alpha);
    const float f = min(max(1.0f / ior, 0.4f), 0.95f);
    const float c0 = (1.2645132f + f * (-1.729201f + f * (3.891471f + f * (-3.1812182f + f * 0.83951783f)))) +
                     alpha * ((0.4242047f + f * (0.24773221f + f * (-1.0077129f + f * -0.10963252f))) +
                              alpha * ((-1.4639989f + f * (0.041601823f + f * 0.66650803f)) +
                                       alpha * ((1.5977967f + f * -0.17212577f) + alpha * -0.60025459f)));
    const float c1 = (-0.45385048f + f * (0.16154351f + f * (-1.7567327f + f * 1.1942403f))) +
                     alpha * ((-0.77334685f + f * (0.87778658f + f * 0.3866481f)) +
                              alpha * ((-0.060401199f + f * -0.45610814f) + alpha * -0.14716421f));
    const float c2 = (0.68730726f + f * (1.2032711f + f * -0.3892439f)) +
                     alpha * ((0.57488429f + f * -0.054267541f) + alpha * 0.49613979f);
    const float c3 = (-0.64763967f + f * -0.3271878f) + alpha * -0.4874791f;
    const float c4 = 0.26612395f;
    const float d0 =
        (0.45592326f + f * (0.68149622f + f * (1.2278593f + f * (-2.0058277f + f * 0.56313362f)))) +
        alpha * ((2.4695249f + f * (-2.3308926f + f * (-4.4525936f + f * 1.9215617f))) +
                 alpha * ((-4.1687575f + f * (5.1497511f + f * 1.1664606f)) +
                          alpha * ((2.3380074f + f * -2.5612394f) + alpha * -0.36223738f)));
    const float d1 = (1.5932746f + f * (-3.1363601f + f * (1.5199049f + f * 0.25464535f))) +
                     alpha * ((-4.6087765f + f * (4.426387f + f * 1.3319444f)) +
                              alpha * ((2.3894291f + f * -2.7541255f) + alpha * 0.37724675f));
    const float d2 = (-1.9160541f + f * (1.0843579f + f * -0.64631447f)) +
                     alpha * ((2.7232626f + f * -0.98775396f) + alpha * -1.3828149f);
    const float d3 = (1.7519019f + f * 0.3144749f) + alpha * -0.67717743f;
    const float d4 = -0.70298755f;
    const float fromAir = c0 + x * (c1 + x * (c2 + x * (c3 + x * c4)));
    const float fromWithin = d0 + x * (d1 + x * (d2 + x * (d3 + x * d4)));
    return min(max(isInside ? fromWithin : fromAir, 0.1f), 1.0f);
}

// Of the sheen lobe of sheen.h with a white colour, rounded up by its error of 0.9 %, so that no energy is
// made where a layer below is given the rest.
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

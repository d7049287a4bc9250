// SPDX-License-Identifier: MIT
// What of the material model and of the light's transport a scene uses.
//
// A driver that runs both sides of a branch pays for what a scene does not use. A kernel may define
// SHADING_FEATURES as a specialization constant; what is missing from it then counts as absent, which must
// not change a bit of the result for a scene that does not use it.
#ifndef METAMARCH_SHARED_FEATURES_H
#define METAMARCH_SHARED_FEATURES_H
#include "interop.h"

SHARED_BEGIN

// The BSDF's.
const uint kFeatureCoat = 1u << 0u;
const uint kFeatureSheen = 1u << 1u;
const uint kFeatureTransmission = 1u << 2u;
const uint kFeatureVolume = 1u << 3u; // refraction; wants kFeatureTransmission
const uint kFeatureIridescence = 1u << 4u;
const uint kFeatureDiffuseTransmission = 1u << 5u;
const uint kBsdfFeatures = kFeatureCoat | kFeatureSheen | kFeatureTransmission | kFeatureVolume |
                           kFeatureIridescence | kFeatureDiffuseTransmission;

const uint kFeatureTextures = 1u << 6u;
const uint kFeatureDeepTextures = 1u << 7u; // of more than 8 bits a channel
const uint kFeatureNormalMaps = 1u << 8u;   // the coat's, too
const uint kFeatureAnisotropy = 1u << 9u;
const uint kFeatureColors = 1u << 10u; // of vertices
const uint kFeatureAlpha = 1u << 11u;  // materials with holes
const uint kFeatureDispersion = 1u << 12u;
const uint kFeatureSpecular = 1u << 13u;
const uint kFeatureUnlit = 1u << 14u;
const uint kFeatureEmission = 1u << 15u;
const uint kFeatureLights = 1u << 16u;      // something that light sampling can find
const uint kFeatureEnvironment = 1u << 17u; // a map, and not only a constant colour
const uint kFeatureFacets = 1u << 18u;      // the base reflects or refracts, or there is sheen
const uint kFeatureMipmaps = 1u << 19u;     // textures whose filter asks how large a texel is seen
const uint kFirstFreeFeature = 1u << 20u;
const uint kAllFeatures = kFirstFreeFeature - 1u;

#ifndef SHADING_FEATURES
#define SHADING_FEATURES kAllFeatures
#endif

SHARED_FN bool hasFeature(const uint feature) { return (SHADING_FEATURES & feature) != 0u; }

SHARED_END
#endif

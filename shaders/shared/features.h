// What of the material model and of the light's transport a scene uses.
//
// A driver that runs both sides of a branch pays for what a scene does not use. A kernel may define
// SHADING_FEATURES as a specialization constant; what is missing from it then counts as absent, which must
// not change a bit of the result for a scene that does not use it.
#ifndef METAMARCH_SHARED_FEATURES_H
#define METAMARCH_SHARED_FEATURES_H
#include "interop.h"

SHARED_BEGIN

const uint kFeatureCoat = 1u;
const uint kFeatureSheen = 2u;
const uint kFeatureTransmission = 4u;
const uint kFeatureVolume = 8u; // refraction; wants kFeatureTransmission
const uint kFeatureIridescence = 16u;
const uint kFeatureDiffuseTransmission = 32u;
const uint kBsdfFeatures = 63u; // those above: the BSDF's
const uint kFeatureTextures = 64u;
const uint kFeatureDeepTextures = 128u; // of more than 8 bits a channel
const uint kFeatureNormalMaps = 256u;   // the coat's, too
const uint kFeatureAnisotropy = 512u;
const uint kFeatureColors = 1024u; // of vertices
const uint kFeatureAlpha = 2048u;  // materials with holes
const uint kFeatureDispersion = 4096u;
const uint kFeatureSpecular = 8192u;
const uint kFeatureUnlit = 16384u;
const uint kFeatureEmission = 32768u;
const uint kFeatureLights = 65536u;       // something that light sampling can find
const uint kFeatureEnvironment = 131072u; // a map, and not only a constant colour
const uint kFeatureFacets =
    262144u; // the base reflects or refracts, or there is sheen: all but diffuse scenes
const uint kFeatureMipmaps = 524288u; // textures whose filter asks how large a texel is seen
const uint kAllFeatures = 1048575u;

#ifndef SHADING_FEATURES
#define SHADING_FEATURES kAllFeatures
#endif

SHARED_FN bool hasFeature(const uint feature) { return (SHADING_FEATURES & feature) != 0u; }

SHARED_END
#endif

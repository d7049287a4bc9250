// SPDX-License-Identifier: MIT
// The parts of the material model, of light transport and of the camera that a picture uses.
//
// On a driver that executes both sides of a branch, unused parts cost time. A kernel may therefore define
// SHADING_FEATURES as a specialization constant and so remove the features that are not set in it. That must
// not change a bit of the result for a picture that does not use them.
#ifndef METAMARCH_SHARED_FEATURES_H
#define METAMARCH_SHARED_FEATURES_H
#include "interop.h"

SHARED_BEGIN

// The parts of the BSDF.
const uint kFeatureCoat = 1u << 0u;
const uint kFeatureSheen = 1u << 1u;
const uint kFeatureTransmission = 1u << 2u;
const uint kFeatureVolume = 1u << 3u; // refraction; needs kFeatureTransmission
const uint kFeatureIridescence = 1u << 4u;
const uint kFeatureDiffuseTransmission = 1u << 5u;
const uint kBsdfFeatures = kFeatureCoat | kFeatureSheen | kFeatureTransmission | kFeatureVolume |
                           kFeatureIridescence | kFeatureDiffuseTransmission;

const uint kFeatureTextures = 1u << 6u;
const uint kFeatureDeepTextures = 1u << 7u; // textures with more than 8 bits per channel
const uint kFeatureNormalMaps = 1u << 8u;   // of the base or the coat
const uint kFeatureAnisotropy = 1u << 9u;
const uint kFeatureColors = 1u << 10u; // vertex colours
const uint kFeatureAlpha = 1u << 11u;  // materials with alpha mode mask or blend
const uint kFeatureDispersion = 1u << 12u;
const uint kFeatureSpecular = 1u << 13u;
const uint kFeatureUnlit = 1u << 14u;
const uint kFeatureEmission = 1u << 15u;
const uint kFeatureLights = 1u << 16u;      // something that light sampling can find
const uint kFeatureEnvironment = 1u << 17u; // an environment map, not only a constant colour
const uint kFeatureFacets = 1u << 18u;      // the base reflects or refracts, or there is sheen
const uint kFeatureMipmaps = 1u << 19u;     // textures whose filter depends on the size of a pixel in texels
const uint kFeatureFurtherSets = 1u << 20u; // more than two sets of texture coordinates
const uint kFeatureNormals = 1u << 21u;     // vertices with normals
const uint kFeatureCatcher = 1u << 22u;     // a shadow catcher
const uint kFeatureLightTree = 1u << 23u;   // so many lights that a tree chooses among those nearby

// The parts of camera.h.
const uint kFeatureLens = 1u << 24u;       // a lens with a radius
const uint kFeaturePanorama = 1u << 25u;   // kProjectionPanorama
const uint kFeatureWideFilter = 1u << 26u; // a filter other than the box
const uint kCameraFeatures = kFeatureLens | kFeaturePanorama | kFeatureWideFilter;

// Smooth glass without a volume, through which light goes straight.
const uint kFeatureThinGlass = 1u << 27u;

const uint kFirstFreeFeature = 1u << 28u;
const uint kAllFeatures = kFirstFreeFeature - 1u;

#ifndef SHADING_FEATURES
#define SHADING_FEATURES kAllFeatures
#endif

// In GLSL it is a macro, so that a branch on it is a branch on a specialization constant, which
// host/vulkan/dead_branches removes.
#ifdef __cplusplus
inline bool hasFeature(const uint feature) { return (SHADING_FEATURES & feature) != 0u; }
#else
#define hasFeature(feature) ((SHADING_FEATURES & (feature)) != 0u)
#endif

// Returns whether to compute a part of the model that this material needs or not. The CPU has no
// specialization and skips what a material lacks, and so do kernels that the processor executes
// (shaders/processor). Other kernels compute it for all lanes, because llvmpipe executes both sides of a
// branch. The result is the same to the bit.
SHARED_FN bool isComputed(const bool isNeeded) {
#if defined(__cplusplus) || defined(METAMARCH_PROCESSOR)
    return isNeeded;
#else
    return true;
#endif
}

SHARED_END
#endif

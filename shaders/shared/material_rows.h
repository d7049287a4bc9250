// SPDX-License-Identifier: MIT
// What the path tracer knows of a material: the one declaration of every parameter and every texture.
//
// The file is included once for each thing that is made of the list, with PARAMETER and TEXTURE defined as
// what an entry becomes there: the struct (shading_layout.h), the device's loader (lib/shading.glsl), the
// host's packing (src/shading/shading_builder.cpp) and tests. It undefines them at its end.
//
//   PARAMETER(type, name, value)  a float, a uint or a vec3
//   TEXTURE(name, value)          a uint: the index of a TextureRecord, or kNoTextureRecord
//   MATERIAL_ROW(condition, four entries of one word)
//   MATERIAL_VECTOR_ROW(condition, a vec3, an entry of one word)
//
// `value` is what the host stores, made of the Material `m` and the ShadingOptions `options`. A row has 16
// bytes, which the device loads at once, and only for scenes for which `condition` holds; without it the
// row's parameters are 0 and its textures none.
//
// To add an entry, take a spare word of a row that has the same condition, or add a row.
#ifndef MATERIAL_ROW
#define MATERIAL_ROW(condition, X, Y, Z, W) X Y Z W
#endif
#ifndef MATERIAL_VECTOR_ROW
#define MATERIAL_VECTOR_ROW(condition, XYZ, W) XYZ W
#endif

// clang-format off
MATERIAL_VECTOR_ROW(true,
    PARAMETER(vec3, baseColor, glm::vec3(m.baseColorFactor)),
    PARAMETER(float, alpha, m.baseColorFactor.a))

MATERIAL_VECTOR_ROW(hasFeature(kFeatureEmission),
    PARAMETER(vec3, emission, m.emissiveFactor * m.emissiveStrength), // radiance
    // Of light sampling, per area of emitter; 0: it does not know this material. addLights sets it.
    PARAMETER(float, emissionDensity, 0.0f))

MATERIAL_ROW(true,
    PARAMETER(float, metallic, m.metallicFactor),
    PARAMETER(float, roughness, m.roughnessFactor),
    PARAMETER(float, ior, m.ior),
    PARAMETER(uint, flags, flagsOf(m, options))) // kSurface… and kMaterial…

MATERIAL_ROW(hasFeature(kFeatureTextures),
    TEXTURE(baseColorTexture, m.baseColorTexture),
    TEXTURE(metallicRoughnessTexture, m.metallicRoughnessTexture),
    TEXTURE(normalTexture, m.normalTexture),
    TEXTURE(emissionTexture, m.emissiveTexture))

MATERIAL_ROW(hasFeature(kFeatureNormalMaps | kFeatureAlpha | kFeatureTransmission | kFeatureDispersion),
    PARAMETER(float, normalScale, m.normalScale),
    PARAMETER(float, alphaCutoff, m.alphaCutoff),
    PARAMETER(float, transmission, m.transmissionFactor),
    PARAMETER(float, dispersion, m.dispersion))

MATERIAL_VECTOR_ROW(hasFeature(kFeatureTransmission),
    PARAMETER(vec3, absorption, absorptionOf(m)), // per world unit, inside a volume
    TEXTURE(transmissionTexture, m.transmissionTexture))

MATERIAL_VECTOR_ROW(hasFeature(kFeatureSpecular),
    PARAMETER(vec3, specularColor, m.specularColorFactor),
    PARAMETER(float, specular, m.specularFactor))

MATERIAL_VECTOR_ROW(hasFeature(kFeatureSheen),
    PARAMETER(vec3, sheenColor, m.sheenColorFactor),
    PARAMETER(float, sheenRoughness, m.sheenRoughnessFactor))

MATERIAL_VECTOR_ROW(hasFeature(kFeatureDiffuseTransmission),
    PARAMETER(vec3, diffuseTransmissionColor, m.diffuseTransmissionColorFactor),
    PARAMETER(float, diffuseTransmission, m.diffuseTransmissionFactor))

MATERIAL_ROW(hasFeature(kFeatureCoat | kFeatureAnisotropy),
    PARAMETER(float, coat, m.clearcoatFactor),
    PARAMETER(float, coatRoughness, m.clearcoatRoughnessFactor),
    PARAMETER(float, coatNormalScale, m.clearcoatNormalScale),
    PARAMETER(float, anisotropy, m.anisotropyStrength))

MATERIAL_ROW(hasFeature(kFeatureIridescence),
    PARAMETER(float, iridescence, m.iridescenceFactor),
    PARAMETER(float, iridescenceIor, m.iridescenceIor),
    PARAMETER(float, iridescenceThicknessMinimum, m.iridescenceThicknessMinimum), // nanometres
    PARAMETER(float, iridescenceThicknessMaximum, m.iridescenceThicknessMaximum))

MATERIAL_ROW(hasFeature(kFeatureAnisotropy) ||
             (hasFeature(kFeatureTextures) && hasFeature(kFeatureDiffuseTransmission)),
    PARAMETER(float, anisotropyCosine, std::cos(m.anisotropyRotation)),
    PARAMETER(float, anisotropySine, std::sin(m.anisotropyRotation)),
    TEXTURE(diffuseTransmissionTexture, m.diffuseTransmissionTexture),
    TEXTURE(diffuseTransmissionColorTexture, m.diffuseTransmissionColorTexture))

MATERIAL_ROW(hasFeature(kFeatureTextures) && hasFeature(kFeatureSpecular | kFeatureSheen),
    TEXTURE(specularTexture, m.specularTexture),
    TEXTURE(specularColorTexture, m.specularColorTexture),
    TEXTURE(sheenColorTexture, m.sheenColorTexture),
    TEXTURE(sheenRoughnessTexture, m.sheenRoughnessTexture))

MATERIAL_ROW(hasFeature(kFeatureTextures) && hasFeature(kFeatureCoat | kFeatureAnisotropy),
    TEXTURE(coatTexture, m.clearcoatTexture),
    TEXTURE(coatRoughnessTexture, m.clearcoatRoughnessTexture),
    TEXTURE(coatNormalTexture, m.clearcoatNormalTexture),
    TEXTURE(anisotropyTexture, m.anisotropyTexture))

MATERIAL_ROW(hasFeature(kFeatureTextures) && hasFeature(kFeatureIridescence),
    TEXTURE(iridescenceTexture, m.iridescenceTexture),
    TEXTURE(iridescenceThicknessTexture, m.iridescenceThicknessTexture),
    PARAMETER(uint, spare0, 0u),
    PARAMETER(uint, spare1, 0u))
// clang-format on

#undef PARAMETER
#undef TEXTURE
#undef MATERIAL_ROW
#undef MATERIAL_VECTOR_ROW

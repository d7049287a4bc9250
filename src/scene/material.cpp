// SPDX-License-Identifier: MIT
#include "metamarch/scene/material.h"

namespace metamarch {

std::array<TextureRef*, kTexturesOfMaterial> texturesOf(Material& m) {
    return {&m.baseColorTexture,
            &m.metallicRoughnessTexture,
            &m.normalTexture,
            &m.emissiveTexture,
            &m.transmissionTexture,
            &m.diffuseTransmissionTexture,
            &m.diffuseTransmissionColorTexture,
            &m.thicknessTexture,
            &m.specularTexture,
            &m.specularColorTexture,
            &m.clearcoatTexture,
            &m.clearcoatRoughnessTexture,
            &m.clearcoatNormalTexture,
            &m.sheenColorTexture,
            &m.sheenRoughnessTexture,
            &m.anisotropyTexture,
            &m.iridescenceTexture,
            &m.iridescenceThicknessTexture};
}

bool needsTangents(const Material& material) {
    return material.normalTexture.texture != kNoTexture ||
           material.clearcoatNormalTexture.texture != kNoTexture ||
           material.anisotropyTexture.texture != kNoTexture || material.anisotropyStrength > 0.0f;
}

std::uint32_t texCoordOfTangents(const Material& material) {
    for (const TextureRef* ref :
         {&material.normalTexture, &material.clearcoatNormalTexture, &material.anisotropyTexture}) {
        if (ref->texture != kNoTexture) {
            return ref->texCoord;
        }
    }
    return 0;
}

} // namespace metamarch

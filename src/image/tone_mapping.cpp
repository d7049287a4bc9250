// SPDX-License-Identifier: MIT
#include "metamarch/image/tone_mapping.h"

#include <cmath>

namespace metamarch {

float exposureScale(const ToneMapping& mapping) { return std::exp2(mapping.exposure); }

glm::vec3 toneMapped(const ToneMapping& mapping, const glm::vec3 radiance) {
    return toneMapped(mapping.toneOperator, exposureScale(mapping), radiance);
}

} // namespace metamarch

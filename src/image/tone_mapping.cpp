// SPDX-License-Identifier: MIT
#include "metamarch/image/tone_mapping.h"

#include <cmath>

namespace metamarch {

float exposureScale(const ToneMapping& mapping) {
    return static_cast<float>(std::exp2(static_cast<double>(mapping.exposure)));
}

glm::vec3 toneMapped(const ToneMapping& mapping, const glm::vec3 radiance) {
    return toneMapped(mapping.toneOperator, exposureScale(mapping), radiance);
}

} // namespace metamarch

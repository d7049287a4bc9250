#include "image/tone_mapping.h"

#include <algorithm>
#include <cmath>

namespace metamarch {
namespace {

// White for every operator; its square is finite.
constexpr float kBrightest = 1e10f;

glm::vec3 clamped(glm::vec3 color) { return glm::clamp(color, 0.0f, 1.0f); }

float largestOf(glm::vec3 color) { return std::max({color.r, color.g, color.b}); }
float smallestOf(glm::vec3 color) { return std::min({color.r, color.g, color.b}); }

glm::vec3 neutral(glm::vec3 color) {
    constexpr float kReflected = 0.04f; // by a dielectric, straight on
    constexpr float kCompressionStart = 0.8f - kReflected;
    constexpr float kDesaturation = 0.15f;
    const float least = smallestOf(color);
    // Less where little light can have been reflected; both meet at 0.08 with the same slope.
    const float offset = least < 2.0f * kReflected ? least - least * least / (4.0f * kReflected) : kReflected;
    color -= offset;
    const float peak = largestOf(color);
    if (peak < kCompressionStart)
        return color;
    const float room = 1.0f - kCompressionStart;
    const float newPeak = 1.0f - room * room / (peak + room - kCompressionStart);
    const float whiteness = 1.0f - 1.0f / (kDesaturation * (peak - newPeak) + 1.0f);
    return glm::mix(color * (newPeak / peak), glm::vec3(newPeak), whiteness);
}

// The matrices are columns of rows: transposed, they read as they are printed.
glm::vec3 aces(glm::vec3 color) {
    // sRGB to ACEScg, and the desaturation of the rendering transform.
    const glm::mat3 into = glm::transpose(
        glm::mat3(0.59719f, 0.35458f, 0.04823f, 0.07600f, 0.90834f, 0.01566f, 0.02840f, 0.13383f, 0.83777f));
    // The output transform's desaturation, and back to sRGB.
    const glm::mat3 back = glm::transpose(glm::mat3(1.60475f, -0.53108f, -0.07367f, -0.10208f, 1.10813f,
                                                    -0.00605f, -0.00327f, -0.07276f, 1.07602f));
    const glm::vec3 v = into * color;
    const glm::vec3 fitted =
        (v * (v + 0.0245786f) - 0.000090537f) / (v * (0.983729f * v + 0.4329510f) + 0.238081f);
    return clamped(back * fitted);
}

glm::vec3 agx(glm::vec3 color) {
    const glm::mat3 inset(0.842479062253094f, 0.0423282422610123f, 0.0423756549057051f, 0.0784335999999992f,
                          0.878468636469772f, 0.0784336f, 0.0792237451477643f, 0.0791661274605434f,
                          0.879142973793104f);
    const glm::mat3 outset(1.19687900512017f, -0.0528968517574562f, -0.0529716355144438f,
                           -0.0980208811401368f, 1.15190312990417f, -0.0980434501171241f,
                           -0.0990297440797205f, -0.0989611768448433f, 1.15107367264116f);
    constexpr float kDarkest = -12.47393f; // stops
    constexpr float kLightest = 4.026069f;
    const glm::vec3 stops = glm::log2(glm::max(inset * color, 1e-10f));
    const glm::vec3 x = clamped((stops - kDarkest) / (kLightest - kDarkest));
    const glm::vec3 x2 = x * x;
    const glm::vec3 x4 = x2 * x2;
    const glm::vec3 contrast = 15.5f * x4 * x2 - 40.14f * x4 * x + 31.96f * x4 - 6.868f * x2 * x +
                               0.4298f * x2 + 0.1191f * x - 0.00232f;
    return glm::pow(clamped(outset * contrast), glm::vec3(2.2f));
}

} // namespace

glm::vec3 toneMapped(const ToneMapping& mapping, const glm::vec3 radiance) {
    glm::vec3 color = radiance * std::exp2(mapping.exposure);
    for (int channel = 0; channel < 3; ++channel)
        color[channel] = color[channel] > 0.0f ? std::min(color[channel], kBrightest) : 0.0f; // NaN: 0
    switch (mapping.toneOperator) {
    case ToneOperator::none:
        break;
    case ToneOperator::neutral:
        return clamped(neutral(color));
    case ToneOperator::aces:
        return aces(color);
    case ToneOperator::agx:
        return agx(color);
    }
    return clamped(color);
}

std::uint8_t toLinear8(float value) {
    if (!(value > 0.0f)) // NaN too
        return 0;
    if (value >= 1.0f)
        return 255;
    return static_cast<std::uint8_t>(std::lround(value * 255.0f));
}

std::uint8_t toSrgb8(float linear) {
    if (!(linear > 0.0f))
        return 0;
    if (linear >= 1.0f)
        return 255;
    const float encoded =
        linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
    return toLinear8(encoded);
}

} // namespace metamarch

// SPDX-License-Identifier: MIT
#include "metamarch/settings/render_settings.h"

namespace metamarch {

void declareTone(SettingList& list, ToneMapping& tone) {
    constexpr double kMostStops = 100.0; // more stops leave nothing of a float
    list.beginGroup("Tones of a PNG (EXR stays linear)");
    list.choice(
        "tone-map", tone.toneOperator, kToneOperators,
        "neutral: Khronos PBR Neutral (default, but for --integrator ao and primary); aces; agx; none: cut "
        "off at 1");
    list.number("exposure", tone.exposure, {-kMostStops, kMostStops, "stops from -100 to 100"},
                "Double the light this often before that")
        .withValueName("STOPS")
        .slides({-10.0, 10.0, "%.2f stops"});
}

void chooseTone(const SettingList& list, const Integrator integrator, ToneMapping& tone) {
    if (!list.at("tone-map").isGiven()) {
        const bool isShownAsIs = integrator == Integrator::primary || integrator == Integrator::ao;
        tone.toneOperator = isShownAsIs ? kToneNone : kToneNeutral;
    }
}

} // namespace metamarch

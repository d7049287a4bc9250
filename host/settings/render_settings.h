// SPDX-License-Identifier: MIT
// The settings of a picture, family by family: each function declares how its struct is set.
#pragma once
#include "metamarch/accel/options.h"
#include "metamarch/image/tone_mapping.h"
#include "metamarch/scene/import.h"
#include "metamarch/settings/setting.h"
#include "metamarch/shading/light_choice.h"
#include "metamarch/shading/path_choice.h"
#include "metamarch/shading/view.h"

#include <cstdint>
#include <string>
#include <vector>

namespace metamarch {

// The first three of kIntegrators have a film that gains samples; `primary` has none.
inline constexpr std::size_t kFilmIntegrators = 3;

void declareCamera(SettingList& list, ViewChoice& view);
void declareTone(SettingList& list, ToneMapping& tone);
// The integrators that the list offers are the first `integrators` of kIntegrators.
void declareIntegrator(SettingList& list, PathChoice& path, std::size_t integrators);
void declarePath(SettingList& list, PathChoice& path, std::uint32_t& samplesPerPixel);
void declareLight(SettingList& list, LightChoice& light);
void declareImport(SettingList& list, ImportOptions& options);
void declareStructure(SettingList& list, AccelerationOptions& options);

// Where no tone operator is given: the integrator's own. ambient occlusion and `primary` are shown as they
// are.
void chooseTone(const SettingList& list, Integrator integrator, ToneMapping& tone);

// Throw Error(invalidArgument) for values that are each in range and do not go together.
void checkView(const ViewChoice& view, Integrator integrator);
void checkStructure(const AccelerationOptions& options);

} // namespace metamarch

// SPDX-License-Identifier: MIT
// Declares the settings of a picture, a function for each struct of the libraries.
#pragma once
#include "metamarch/accel/options.h"
#include "metamarch/image/image_file.h"
#include "metamarch/image/tone_mapping.h"
#include "metamarch/scene/import.h"
#include "metamarch/settings/setting.h"
#include "metamarch/shading/light_choice.h"
#include "metamarch/shading/path_choice.h"
#include "metamarch/shading/shadow_catcher.h"
#include "metamarch/shading/view.h"

#include <cstdint>
#include <string>
#include <vector>

namespace metamarch {

// The first three of kIntegrators have a film that gains samples; `primary` has none.
inline constexpr std::size_t kFilmIntegrators = 3;

void declareCamera(SettingList& list, ViewChoice& view);
void declareTone(SettingList& list, ToneMapping& tone);
// `names` is for chooseAovs; empty: nobody chooses.
void declareChannels(SettingList& list, std::vector<std::string>& names, float& missDepth);
void declareStorage(SettingList& list, PictureStorage& storage);
// The integrators that the list offers are the first `integrators` of kIntegrators.
void declareIntegrator(SettingList& list, PathChoice& path, std::size_t integrators);
void declarePath(SettingList& list, PathChoice& path, std::uint32_t& samplesPerPixel);
void declareCatcher(SettingList& list, CatcherChoice& catcher, PathChoice& path);
void declareLight(SettingList& list, LightChoice& light);
void declareImport(SettingList& list, ImportOptions& options);
void declareStructure(SettingList& list, AccelerationOptions& options);

// Chooses the tone operator by the integrator if the user gives none. `ao` and `primary` are shown without
// one.
void chooseTone(const SettingList& list, Integrator integrator, ToneMapping& tone);

// Throw Error(invalidArgument) for values that are in range, but exclude each other.
void checkView(const ViewChoice& view, Integrator integrator);
void checkStructure(const AccelerationOptions& options);

} // namespace metamarch

// SPDX-License-Identifier: MIT
// What checkpoints and parts know of the command that made them, to refuse sums of another picture and to
// write the picture that the undivided command would have written.
#pragma once
#include "metamarch/render/film_file.h"
#include "metamarch/render/prepared_scene.h"
#include "metamarch/render/render.h"
#include "metamarch/settings/setting.h"

#include <span>
#include <string>
#include <string_view>

namespace metamarch::cli {

// Settings that change neither the samples of a picture nor its file: where it goes, what is told about it,
// and how the work is divided.
std::span<const std::string_view> settingsOfTheRun();

// Sums with the same facts belong to the same picture.
render::FilmFacts factsOf(const render::PreparedScene& scene, const SceneCamera& camera,
                          const render::RenderPlace& place, const SettingList& given);

// Gives the settings the values that the facts name. Throws Error(inputRefused), beginning with `file`, for a
// setting that does not exist or has no such value.
void applyFacts(const render::FilmFacts& facts, const std::string& file, SettingList& settings);

// The camera and the place that are in the facts. Throw Error(inputRefused) likewise.
SceneCamera cameraIn(const render::FilmFacts& facts, const std::string& file);
render::RenderPlace placeIn(const render::FilmFacts& facts);

} // namespace metamarch::cli

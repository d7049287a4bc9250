// SPDX-License-Identifier: MIT
// Writes what a render has taken, with the header of the command that these options are. So the program and
// the Python module write the same bytes.
#pragma once
#include "metamarch/cli/render_options.h"
#include "metamarch/image/denoiser.h"

#include <string>

namespace metamarch::cli {

// `given` are the settings that declareRender has declared for `options`. `denoiser` may be null. Throws what
// writePicture throws.
void writeRenderedPicture(const render::RenderResult& result, RenderOptions& options,
                          const SettingList& given, const SceneCamera& camera, const std::string& sceneSha1,
                          const Denoiser* denoiser);

} // namespace metamarch::cli

// SPDX-License-Identifier: MIT
#include "metamarch/cli/rendered_picture.h"

#include "metamarch/cli/film_facts.h"
#include "metamarch/cli/version.h"
#include "metamarch/render/picture.h"

#include <utility>

namespace metamarch::cli {

void writeRenderedPicture(const render::RenderResult& result, RenderOptions& options,
                          const SettingList& given, const SceneCamera& camera, const std::string& sceneSha1,
                          const Denoiser* const denoiser) {
    // The header says what the picture has: it is that of a command for as many samples.
    const std::uint32_t wanted = std::exchange(options.samplesPerPixel, result.settings.samplesPerPixel);
    const std::string changed = given.changedText(settingsOfTheRun());
    options.samplesPerPixel = wanted;
    render::writePicture(result,
                         {.software = programVersion(),
                          .sceneFile = options.scenePath,
                          .camera = camera,
                          .options = changed,
                          .isStamped = options.isStamped,
                          .sceneSha1 = sceneSha1,
                          .lens = options.view.lens},
                         {options.outputPath, options.tone, options.storage, denoiser});
}

} // namespace metamarch::cli

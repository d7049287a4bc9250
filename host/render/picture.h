// SPDX-License-Identifier: MIT
// From what was rendered to a picture and its file.
#pragma once
#include "metamarch/image/image.h"
#include "metamarch/image/tone_mapping.h"
#include "metamarch/render/render.h"
#include "metamarch/scene/scene.h"

#include <filesystem>
#include <string>

namespace metamarch::render {

// With the integrator's channels (aovsOf).
Image imageOf(const RenderResult& result);

// What the header says besides what is in the RenderResult.
struct PictureOrigin {
    std::string software;  // with its version
    std::string sceneFile; // as the user calls it
    SceneCamera camera;
    std::string options{}; // what differs from the defaults, as the command line takes it
};

// Writes imageOf(result), with a header that says how it was made. The PNG of a path tracer is opaque: the
// background is part of what it draws. Throws what writeImage throws.
void writePicture(const RenderResult& result, const PictureOrigin& origin, const std::filesystem::path& path,
                  const ToneMapping& toneMapping = {});

} // namespace metamarch::render

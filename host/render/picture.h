// SPDX-License-Identifier: MIT
// Turns the result of a render into a picture and writes it to a file.
#pragma once
#include "metamarch/image/image.h"
#include "metamarch/image/tone_mapping.h"
#include "metamarch/render/render.h"
#include "metamarch/scene/scene.h"

#include <filesystem>
#include <string>

namespace metamarch::render {

// Returns an image with the channels that the integrator writes (aovsOf).
Image imageOf(const RenderResult& result);

// Facts for the header of the file that RenderResult does not have.
struct PictureOrigin {
    std::string software;  // name and version
    std::string sceneFile; // as the user spells it
    SceneCamera camera;
    std::string options{};  // the settings that are not the default, as command line options
    bool isStamped = false; // the header also says when the picture was made and how long that took
};

// Writes imageOf(result) with a header that says how the picture was made. Unless it is stamped, nothing in
// the file depends on the clock. The path tracer's PNG is opaque, because the path tracer draws the
// background too. Throws what writeImage throws.
void writePicture(const RenderResult& result, const PictureOrigin& origin, const std::filesystem::path& path,
                  const ToneMapping& toneMapping = {});

} // namespace metamarch::render

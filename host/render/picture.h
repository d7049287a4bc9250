// SPDX-License-Identifier: MIT
// Turns the result of a render into a picture and writes it to a file.
#pragma once
#include "metamarch/image/denoiser.h"
#include "metamarch/image/image.h"
#include "metamarch/image/image_file.h"
#include "metamarch/image/tone_mapping.h"
#include "metamarch/render/render.h"
#include "metamarch/scene/scene.h"
#include "metamarch/shading/view.h"

#include <filesystem>
#include <string>

namespace metamarch::render {

// Returns an image with the channels of RenderSettings::aovs(). A denoiser removes the noise of R G B, direct
// and indirect; what they were is in the channels noisyAovs() then. Throws what Denoiser throws.
Image imageOf(const RenderResult& result, const Denoiser* denoiser = nullptr);

// The same for a format for people. The path tracer's pictures are opaque there, because it draws the
// background too, unless PathChoice::isTransparent.
Image shownImageOf(const RenderResult& result, const Denoiser* denoiser = nullptr);

// Facts for the header of the file that RenderResult does not have.
struct PictureOrigin {
    std::string software;  // name and version
    std::string sceneFile; // as the user spells it
    SceneCamera camera;
    std::string options{};   // the settings that are not the default, as command line options
    bool isStamped = false;  // the header also says when the picture was made and how long that took
    std::string sceneSha1{}; // of the bytes of sceneFile, as hexadecimal digits; empty: unknown
    CameraOptions lens{};
};

// Returns the matrices that an EXR's header gives, as OpenEXR defines them, for column vectors. The camera's
// space is left-handed, with x to the right, y up and z ahead; normalized device coordinates are (0, 0) at
// the upper left corner of the picture and (1, 1) at the lower right one. `aspect` is width / height.
glm::mat4 worldToCamera(const SceneCamera& camera);
glm::mat4 worldToNdc(const SceneCamera& camera, float aspect);

// Where and how a picture is written.
struct PictureTarget {
    std::filesystem::path path;
    ToneMapping toneMapping{};
    PictureStorage storage{};
    const Denoiser* denoiser = nullptr; // none: the picture stays as it is
};

// Writes imageOf(result) with a header that says how the picture was made. Unless it is stamped, nothing in
// the file depends on the clock. Pictures but EXR are shownImageOf(result). Throws what writeImage and
// imageOf throw.
void writePicture(const RenderResult& result, const PictureOrigin& origin, const PictureTarget& target);

} // namespace metamarch::render

// SPDX-License-Identifier: MIT
// Loads the textures of a scene from where its file says they are.
#pragma once
#include "metamarch/file/input_file.h"
#include "metamarch/scene/scene.h"

#include <functional>
#include <string>
#include <vector>

namespace metamarch {

// An image as a file has it.
struct EncodedImage {
    std::string name;   // "texture 'wood.png'", for messages
    std::string ending; // ".png", in lower case; empty if there is none
    // Returns the encoded image. Throws TextureFailure. May be called on any thread. Null means a white
    // texel.
    std::function<std::vector<unsigned char>()> read;
};

// Replaces a channel of another image by one of this image. The smaller image is enlarged without filtering.
struct TextureOverlay {
    static constexpr int kAlphaOrRed = -1; // alpha or, if the image has none, red
    static constexpr int kLuminance = 4;

    EncodedImage image;
    int channel;
    int from = kAlphaOrRed; // 0 to 3, or one of these
};

// An image that textures may use.
struct TextureSource {
    EncodedImage image;
    std::vector<TextureOverlay> overlays{};    // applied in order
    std::function<void(TextureImage&)> edit{}; // applied after the overlays; may be null
};

// Before the call, scene.textures holds every texture of the file, each `image` is an index into `sources`,
// and every material has its references. After it, the scene holds only textures and images of materials that
// triangles use, each decoded once; other materials have no textures. An image that cannot be read is refused
// by name; with `allowMissing` there is a warning and its references are removed.
void loadTextures(Scene& scene, InputFile& file, const std::vector<TextureSource>& sources,
                  bool allowMissing);

// Returns an image file, and adds it to the files of the scene. Its name is relative to the
// scene file's folder.
EncodedImage imageFile(InputFile& file, const std::string& nameInFile);

} // namespace metamarch

// The textures of a scene, read from where its file says they are.
#pragma once
#include "metamarch/file/input_file.h"
#include "metamarch/scene/scene.h"

#include <functional>
#include <string>
#include <vector>

namespace metamarch {

struct TextureOverlay;

// An image that textures may use.
struct TextureSource {
    std::string name;   // "texture 'wood.png'", for messages
    std::string ending; // ".png", in lower case; empty when there is none
    // Encoded. Throws TextureFailure; called on any thread. Null stands for a white texel.
    std::function<std::vector<unsigned char>()> read;
    std::vector<TextureOverlay> overlays{}; // in order
};

// Replaces a channel of another image by what this one shows: its alpha where it has any, else its red. The
// smaller of the two is enlarged without a filter.
struct TextureOverlay {
    TextureSource source; // its own overlays are not looked at
    int channel;
};

// Before: scene.textures holds every texture of the file, their `image` into `sources`, and every material
// its references. After: textures and images are those that a triangle's material uses, decoded once each,
// and all other materials have none. An image that cannot be read is refused by name; with `allowMissing` it
// is warned of, and its uses are gone.
void loadTextures(Scene& scene, InputFile& file, const std::vector<TextureSource>& sources,
                  bool allowMissing);

// A source beside the scene's file; `name` relative to its folder.
TextureSource fileSource(const InputFile& file, const std::string& name);

} // namespace metamarch

// SPDX-License-Identifier: MIT
#include "metamarch/scene/texture/texture_loader.h"

#include "metamarch/scene/texture/texture_decoder.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>

namespace metamarch {
namespace {

constexpr std::uint32_t kUnused = 0xffffffffu;

struct Loaded {
    DecodedTexture texture;
    std::string failure; // empty if there is a texture
    std::string flaw;    // for a warning; empty if there is none
};

std::size_t texelCount(const TextureImage& image) {
    return static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
}

// Returns the texel of `image`, in [0, 1], that corresponds to texel `i` of `like`.
glm::vec4 texelOf(const TextureImage& image, const TextureImage& like, std::size_t i) {
    const std::size_t x = i % like.width * image.width / like.width;
    const std::size_t y = i / like.width * image.height / like.height;
    const std::size_t texel = y * image.width + x;
    return image.floats.empty() ? glm::vec4(image.bytes[texel]) / 255.0f : image.floats[texel];
}

bool hasAlpha(const TextureImage& image) {
    return std::ranges::any_of(image.bytes, [](const glm::u8vec4& texel) { return texel.a < 255; }) ||
           std::ranges::any_of(image.floats, [](const glm::vec4& texel) { return texel.a < 1.0f; });
}

// Enlarges `image` to the size of `other` if `other` has more texels.
void enlarge(TextureImage& image, const TextureImage& other) {
    if (texelCount(image) >= texelCount(other)) {
        return;
    }
    TextureImage larger;
    larger.width = other.width;
    larger.height = other.height;
    for (std::size_t i = 0; i < texelCount(other); ++i) {
        const glm::vec4 texel = texelOf(image, other, i);
        if (image.floats.empty()) {
            larger.bytes.emplace_back(glm::round(255.0f * texel));
        } else {
            larger.floats.push_back(texel);
        }
    }
    image = std::move(larger);
}

float valueOf(const glm::vec4& texel, int from) {
    constexpr glm::vec3 kWeights(0.2126f, 0.7152f, 0.0722f); // ITU-R BT.709
    return from == TextureOverlay::kLuminance ? glm::dot(glm::vec3(texel), kWeights) : texel[from];
}

void overlay(TextureImage& image, const TextureImage& over, int channel, int from) {
    enlarge(image, over);
    if (from == TextureOverlay::kAlphaOrRed) {
        from = hasAlpha(over) ? 3 : 0;
    }
    for (std::size_t i = 0; i < texelCount(image); ++i) {
        const float value = valueOf(texelOf(over, image, i), from);
        if (image.floats.empty()) {
            image.bytes[i][channel] =
                static_cast<glm::u8>(std::lround(255.0f * std::clamp(value, 0.0f, 1.0f)));
        } else {
            image.floats[i][channel] = value;
        }
    }
}

DecodedTexture whiteTexel() {
    DecodedTexture white;
    white.image.width = 1;
    white.image.height = 1;
    white.image.bytes = {glm::u8vec4(255)};
    return white;
}

DecodedTexture decode(const EncodedImage& image) {
    try {
        return image.read == nullptr ? whiteTexel() : decodeTexture(image.read(), image.ending);
    } catch (const TextureFailure& failure) {
        throw TextureFailure(image.name + ' ' + failure.what());
    }
}

std::string flawOf(const EncodedImage& image, const DecodedTexture& texture) {
    return texture.flaw.empty() ? "" : image.name + ' ' + texture.flaw;
}

Loaded load(const TextureSource& source) {
    try {
        DecodedTexture texture = decode(source.image);
        std::string flaw = flawOf(source.image, texture);
        for (const TextureOverlay& over : source.overlays) {
            const DecodedTexture upper = decode(over.image);
            overlay(texture.image, upper.image, over.channel, over.from);
            flaw = flaw.empty() ? flawOf(over.image, upper) : flaw;
        }
        if (source.edit != nullptr) {
            source.edit(texture.image);
        }
        return {std::move(texture), "", std::move(flaw)};
    } catch (const TextureFailure& failure) {
        return {{}, failure.what(), ""};
    }
}

class TextureLoader {
  public:
    TextureLoader(Scene& scene, InputFile& file, const std::vector<TextureSource>& sources)
        : scene_(scene), file_(file), sources_(sources), newImage_(sources.size(), kUnused),
          isLinear_(sources.size(), false) {}

    void load(bool allowMissing) {
        dropUnusedMaterials();
        loadImages(allowMissing);
        keepTextures();
    }

  private:
    void dropUnusedMaterials() {
        std::vector<bool> used(scene_.materials.size(), false);
        for (const std::uint32_t material : scene_.triangleMaterial) {
            if (material != kNoMaterial) {
                used[material] = true;
            }
        }
        for (std::size_t i = 0; i < used.size(); ++i) {
            for (TextureRef* ref : texturesOf(scene_.materials[i])) {
                if (!used[i]) {
                    *ref = TextureRef();
                } else if (ref->texture != kNoTexture) {
                    refs_.push_back(ref);
                }
            }
        }
    }

    void loadImages(bool allowMissing) {
        std::vector<std::uint32_t> wanted;
        wanted.reserve(refs_.size());
        for (const TextureRef* ref : refs_) {
            wanted.push_back(scene_.textures[ref->texture].image);
        }
        std::ranges::sort(wanted);
        wanted.erase(std::ranges::unique(wanted).begin(), wanted.end());

        std::vector<Loaded> loaded(wanted.size());
        tbb::parallel_for(std::size_t{0}, wanted.size(),
                          [&](std::size_t i) { loaded[i] = metamarch::load(sources_[wanted[i]]); });
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            if (!loaded[i].failure.empty() && !allowMissing) {
                file_.refuse(loaded[i].failure, {"allowMissingTextures"});
            }
            if (!loaded[i].failure.empty()) {
                file_.warn(loaded[i].failure + "; its uses are left out");
                continue;
            }
            if (!loaded[i].flaw.empty()) {
                file_.warn(loaded[i].flaw);
            }
            newImage_[wanted[i]] = static_cast<std::uint32_t>(scene_.images.size());
            isLinear_[wanted[i]] = loaded[i].texture.isLinear;
            scene_.images.push_back(std::move(loaded[i].texture.image));
            scene_.images.back().name = sources_[wanted[i]].image.name;
        }
    }

    void keepTextures() {
        std::vector<std::uint32_t> newTexture(scene_.textures.size(), kUnused);
        std::vector<Texture> kept;
        for (TextureRef* ref : refs_) {
            const Texture& texture = scene_.textures[ref->texture];
            if (newImage_[texture.image] == kUnused) {
                *ref = TextureRef();
                continue;
            }
            std::uint32_t& index = newTexture[ref->texture];
            if (index == kUnused) {
                index = static_cast<std::uint32_t>(kept.size());
                kept.push_back(texture);
                kept.back().image = newImage_[texture.image];
            }
            ref->isSrgb = ref->isSrgb && !isLinear_[texture.image];
            ref->texture = index;
        }
        scene_.textures = std::move(kept);
    }

    Scene& scene_;
    InputFile& file_;
    const std::vector<TextureSource>& sources_;
    std::vector<TextureRef*> refs_;       // of the materials in use
    std::vector<std::uint32_t> newImage_; // indexed by source; an index into scene_.images, or kUnused
    std::vector<bool> isLinear_;          // indexed by source
};

} // namespace

void loadTextures(Scene& scene, InputFile& file, const std::vector<TextureSource>& sources,
                  bool allowMissing) {
    TextureLoader(scene, file, sources).load(allowMissing);
}

EncodedImage imageFile(InputFile& file, const std::string& nameInFile) {
    const std::string name = file.portableName(nameInFile);
    file.addCompanion(name);
    const auto read = [&file, name] {
        if (const std::string reason = file.whyNotReadable(name); !reason.empty()) {
            throw TextureFailure(reason);
        }
        std::optional<std::vector<unsigned char>> bytes = readBytes(file.companion(name));
        if (!bytes) {
            throw TextureFailure(std::string("cannot be read: ") + std::strerror(errno));
        }
        return std::move(*bytes);
    };
    return {"texture '" + name + "'", lowerCaseEnding(name), read};
}

} // namespace metamarch

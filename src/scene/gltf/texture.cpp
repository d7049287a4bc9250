// SPDX-License-Identifier: MIT
#include "metamarch/scene/gltf/texture.h"

#include "metamarch/scene/gltf/buffer.h"
#include "metamarch/scene/gltf/extension.h"
#include "metamarch/scene/gltf/uri.h"
#include "metamarch/scene/texture/texture_decoder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace metamarch {
namespace {

TextureWrap readWrap(const GltfElement& sampler, const char* key) {
    switch (sampler.integer(key).value_or(TINYGLTF_TEXTURE_WRAP_REPEAT)) {
    case TINYGLTF_TEXTURE_WRAP_REPEAT:
        return TextureWrap::repeat;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
        return TextureWrap::mirroredRepeat;
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
        return TextureWrap::clampToEdge;
    default:
        sampler.refuse(std::string(key) + " is not a wrap mode of glTF 2.0");
    }
}

TextureFilter readFilter(const GltfElement& sampler, const char* key, TextureFilter fallback) {
    const std::optional<int> filter = sampler.integer(key);
    if (!filter) {
        return fallback;
    }
    switch (*filter) {
    case TINYGLTF_TEXTURE_FILTER_NEAREST:
        return TextureFilter::nearest;
    case TINYGLTF_TEXTURE_FILTER_LINEAR:
        return TextureFilter::linear;
    case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST:
        return TextureFilter::nearestMipmapNearest;
    case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_NEAREST:
        return TextureFilter::linearMipmapNearest;
    case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR:
        return TextureFilter::nearestMipmapLinear;
    case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR:
        return TextureFilter::linearMipmapLinear;
    default:
        sampler.refuse(std::string(key) + " is not a filter of glTF 2.0");
    }
}

Texture readSampler(const GltfElement& sampler) {
    Texture texture;
    texture.wrapS = readWrap(sampler, "wrapS");
    texture.wrapT = readWrap(sampler, "wrapT");
    texture.magFilter = readFilter(sampler, "magFilter", texture.magFilter);
    texture.minFilter = readFilter(sampler, "minFilter", texture.minFilter);
    if (texture.magFilter > TextureFilter::linear) {
        sampler.refuse("magFilter is a filter for minification");
    }
    return texture;
}

EncodedImage readImage(const GltfDocument& document, InputFile& file, const GltfElement& image) {
    const std::string uri = image.text("uri");
    if (!uri.empty() && !isDataUri(uri)) {
        return imageFile(file, fileNameOfUri(uri));
    }
    const std::optional<int> view = image.integer("bufferView");
    const std::string& label = image.label();
    if (uri.empty() && !view) {
        image.refuse("has neither uri nor bufferView");
    }
    const auto readUri = [uri] {
        std::optional<std::vector<unsigned char>> bytes = bytesOfDataUri(uri);
        if (!bytes) {
            throw TextureFailure("has a data URI that is not base64");
        }
        return std::move(*bytes);
    };
    const auto readView = [&document, &file, label, view] {
        const std::span<const unsigned char> bytes = bytesOfView(document.model, file, label, *view);
        return std::vector<unsigned char>(bytes.begin(), bytes.end());
    };
    if (!uri.empty()) {
        return {label, "", readUri};
    }
    return {label, "", readView};
}

// Returns the image of a texture. The image of an extension that is read is preferred to the fallback for
// readers without the extension.
std::optional<int> sourceOf(const GltfElement& texture, std::size_t images) {
    const std::optional<GltfElement> webp = texture.extension("EXT_texture_webp");
    if (webp && isSupportedExtension("EXT_texture_webp")) {
        if (const std::optional<int> source = webp->index("source", "image", images)) {
            return source;
        }
    }
    return texture.index("source", "image", images);
}

// Returns an image whose failure names the extensions that have the texture's image.
EncodedImage noImage(const GltfElement& texture) {
    std::vector<std::string> extensions;
    for (const char* name : undecodedImageExtensions()) {
        if (texture.extension(name)) {
            extensions.emplace_back(name);
        }
    }
    const std::string reason =
        extensions.empty()
            ? "has no image of a known format"
            : fmt::format("has only an image of {}, which is not decoded", fmt::join(extensions, " and of "));
    return {texture.label(), "", [reason]() -> std::vector<unsigned char> { throw TextureFailure(reason); }};
}

// Returns the specification's translation * rotation * scale. Positive angles rotate the visible image
// clockwise.
glm::mat3x2 readTransform(const GltfElement& transform) {
    const glm::dvec2 offset = transform.vector<2>("offset", glm::dvec2(0.0));
    const glm::dvec2 scale = transform.vector<2>("scale", glm::dvec2(1.0));
    const double rotation = transform.number("rotation", 0.0);
    const double sine = std::sin(rotation);
    const double cosine = std::cos(rotation);
    return glm::mat3x2(glm::dvec2(cosine, -sine) * scale.x, glm::dvec2(sine, cosine) * scale.y, offset);
}

void glossinessToRoughness(TextureImage& image, float glossiness) {
    for (glm::u8vec4& texel : image.bytes) {
        texel.g = static_cast<glm::u8>(std::lround(255.0f - glossiness * static_cast<float>(texel.a)));
    }
    for (glm::vec4& texel : image.floats) {
        texel.g = 1.0f - glossiness * texel.a;
    }
}

} // namespace

GltfTextures::GltfTextures(const GltfDocument& document, InputFile& file) {
    const GltfElement root(file, "", &document.json);
    for (const GltfElement& image : root.objects("images", "image")) {
        sources_.push_back({readImage(document, file, image)});
    }
    const std::size_t images = sources_.size();
    const std::vector<GltfElement> samplers = root.objects("samplers", "sampler");
    for (const GltfElement& source : root.objects("textures", "texture")) {
        Texture texture;
        if (const std::optional<int> sampler = source.index("sampler", "sampler", samplers.size())) {
            texture = readSampler(samplers[static_cast<std::size_t>(*sampler)]);
        }
        const std::optional<int> image = sourceOf(source, images);
        texture.image =
            static_cast<std::uint32_t>(image ? static_cast<std::size_t>(*image) : sources_.size());
        if (!image) {
            sources_.push_back({noImage(source)});
        }
        textures_.push_back(texture);
    }
    texturesOfFile_ = textures_.size();
}

TextureRef GltfTextures::ref(const GltfElement& material, const char* key, bool isSrgb) const {
    if (!material.has(key)) {
        return {};
    }
    const GltfElement info = material.object(key);
    const std::optional<int> texture = info.index("index", "texture", texturesOfFile_);
    if (!texture) {
        info.refuse("has no index");
    }
    TextureRef ref;
    ref.texture = static_cast<std::uint32_t>(*texture);
    ref.texCoord = static_cast<std::uint32_t>(info.integer("texCoord").value_or(0));
    ref.isSrgb = isSrgb;
    if (const std::optional<GltfElement> transform = info.extension("KHR_texture_transform")) {
        ref.transform = readTransform(*transform);
        if (const std::optional<int> texCoord = transform->integer("texCoord")) {
            ref.texCoord = static_cast<std::uint32_t>(*texCoord);
        }
    }
    return ref;
}

TextureRef GltfTextures::roughnessRef(const GltfElement& material, const char* key, float glossiness) {
    TextureRef result = ref(material, key, false);
    if (result.texture == kNoTexture) {
        return result;
    }
    const auto next = static_cast<std::uint32_t>(textures_.size());
    const auto [made, isNew] = roughness_.try_emplace({result.texture, glossiness}, next);
    if (isNew) {
        Texture texture = textures_[result.texture];
        TextureSource source = sources_[texture.image];
        source.edit = [glossiness](TextureImage& image) { glossinessToRoughness(image, glossiness); };
        texture.image = static_cast<std::uint32_t>(sources_.size());
        sources_.push_back(std::move(source));
        textures_.push_back(texture);
    }
    result.texture = made->second;
    return result;
}

} // namespace metamarch

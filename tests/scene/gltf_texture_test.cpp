// SPDX-License-Identifier: MIT
// Textures of glTF: images, samplers, transforms, texture coordinates, and missing or broken files.
#include "fixtures/expect_error.h"
#include "metamarch/error/error.h"
#include "scene/gltf_file.h"
#include "scene/picture_file.h"

#include <gtest/gtest.h>

namespace metamarch {
namespace {

using Json = nlohmann::json;

// A triangle with a texture whose image is wood.png.
class PaintedFile : public TriangleFile {
  public:
    PaintedFile() {
        root["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
        primitive()["material"] = 0;
        root["textures"] = {{{"source", 0}}};
        root["images"] = {{{"uri", "wood.png"}}};
        writeFile(folder / "wood.png", kPng);
    }

    Json& info() { return root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]; }

    static TextureRef ref(const Scene& scene) { return scene.materials.at(0).baseColorTexture; }

    const std::string kPng = onePixelPng({1, 2, 3, 4});
};

glm::vec2 lookUp(const TextureRef& ref, const glm::vec2 texCoord) {
    return ref.transform * glm::vec3(texCoord, 1.0f);
}

void expectNear(const glm::vec2 a, const glm::vec2 b) { EXPECT_LT(glm::distance(a, b), 1e-6f); }

TEST(GltfTexture, SamplersOfEveryKind) {
    PaintedFile file;
    file.root["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}, {"minFilter", 9987}}};
    file.root["textures"][0]["sampler"] = 0;
    const Texture texture = file.load().textures.at(0);
    EXPECT_EQ(texture.wrapS, TextureWrap::clampToEdge);
    EXPECT_EQ(texture.wrapT, TextureWrap::mirroredRepeat);
    EXPECT_EQ(texture.magFilter, TextureFilter::nearest);
    EXPECT_EQ(texture.minFilter, TextureFilter::linearMipmapLinear);
    constexpr TextureFilter kFilters[] = {TextureFilter::nearestMipmapNearest,
                                          TextureFilter::linearMipmapNearest,
                                          TextureFilter::nearestMipmapLinear};
    for (int i = 0; i < 3; ++i) {
        file.root["samplers"][0]["minFilter"] = 9984 + i;
        EXPECT_EQ(file.load().textures.at(0).minFilter, kFilters[i]);
    }
    file.root["samplers"][0] = Json::object();
    EXPECT_EQ(file.load().textures.at(0).wrapS, TextureWrap::repeat);
    EXPECT_EQ(file.load().textures.at(0).magFilter, TextureFilter::linear);

    file.root["samplers"][0]["magFilter"] = 9987;
    EXPECT_EQ(file.refusal(), "sampler 0: magFilter is a filter for minification");
    file.root["samplers"][0] = {{"wrapS", 1}};
    EXPECT_EQ(file.refusal(), "sampler 0: wrapS is not a wrap mode of glTF 2.0");
    file.root["textures"][0]["sampler"] = 1;
    EXPECT_EQ(file.refusal(), "texture 0: sampler 1 does not exist, there are 1");
    file.root["textures"][0] = {{"source", 7}};
    EXPECT_EQ(file.refusal(), "texture 0: image 7 does not exist, there are 1");
}

// Rotates (0.25, 0.5) by 90 degrees. The visible image turns clockwise, so the look-up turns the other way;
// with v downwards it maps (u, v) to (v, -u).
TEST(GltfTexture, TransformScalesThenTurnsThenMoves) {
    PaintedFile file;
    expectNear(lookUp(PaintedFile::ref(file.load()), {0.25f, 0.5f}), {0.25f, 0.5f});
    const auto transformed = [&](const Json& transform) {
        file.info()["extensions"]["KHR_texture_transform"] = transform;
        return lookUp(PaintedFile::ref(file.load()), {0.25f, 0.5f});
    };
    expectNear(transformed({{"offset", {1, 2}}}), {1.25f, 2.5f});
    expectNear(transformed({{"scale", {2, 4}}}), {0.5f, 2.0f});
    expectNear(transformed({{"rotation", 1.5707963267948966}}), {0.5f, -0.25f});
    expectNear(transformed({{"offset", {1, 2}}, {"scale", {2, 4}}, {"rotation", 1.5707963267948966}}),
               {1.0f + 2.0f, 2.0f - 0.5f});
}

class TwoSetsFile : public PaintedFile {
  public:
    TwoSetsFile() {
        for (int set = 0; set < 4; ++set) {
            const auto value = static_cast<float>(set);
            primitive()["attributes"]["TEXCOORD_" + std::to_string(set)] =
                addFloats("VEC2", 2, {value, 0, value, 1, value, 2});
        }
    }
};

TEST(GltfTexture, SetsZeroAndOneKeepTheirNumbers) {
    TwoSetsFile file;
    file.info()["texCoord"] = 1;
    const Scene scene = file.load();
    EXPECT_EQ(PaintedFile::ref(scene).texCoord, 1u);
    EXPECT_EQ(scene.texCoords, std::vector<glm::vec2>({{0, 0}, {0, 1}, {0, 2}}));
    EXPECT_EQ(scene.texCoords1, std::vector<glm::vec2>({{1, 0}, {1, 1}, {1, 2}}));
}

TEST(GltfTexture, AnyTwoSetsAreRead) {
    TwoSetsFile file;
    file.info()["texCoord"] = 3;
    file.root["materials"][0]["emissiveTexture"] = {{"index", 0}, {"texCoord", 1}};
    const Scene scene = file.load();
    EXPECT_EQ(scene.materials[0].emissiveTexture.texCoord, 0u);
    EXPECT_EQ(scene.materials[0].baseColorTexture.texCoord, 1u);
    EXPECT_EQ(scene.texCoords[0].x, 1.0f);
    EXPECT_EQ(scene.texCoords1[0].x, 3.0f);
}

// A material that uses sets 0, 2, 3 and 7 gets them as its sets 0 to 3; a fifth is one too many.
TEST(GltfTexture, UpToFourSetsAreRead) {
    TwoSetsFile file;
    file.primitive()["attributes"]["TEXCOORD_7"] = file.addFloats("VEC2", 2, {7, 0, 7, 1, 7, 2});
    Json& material = file.root["materials"][0];
    file.info()["texCoord"] = 3;
    material["emissiveTexture"] = {{"index", 0}, {"texCoord", 0}};
    material["normalTexture"] = {{"index", 0}, {"texCoord", 7}};
    Scene scene = file.load();
    EXPECT_EQ(scene.materials[0].emissiveTexture.texCoord, 0u);
    EXPECT_EQ(scene.materials[0].baseColorTexture.texCoord, 1u);
    EXPECT_EQ(scene.materials[0].normalTexture.texCoord, 2u);
    EXPECT_EQ(scene.texCoords1[0], glm::vec2(3, 0));
    EXPECT_EQ(scene.texCoords2[1], glm::vec2(7, 1));
    EXPECT_TRUE(scene.texCoords3.empty());
    const auto metallicRoughness = [&](int set) {
        material["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {{"index", 0}, {"texCoord", set}};
    };
    metallicRoughness(2);
    scene = file.load();
    EXPECT_EQ(scene.materials[0].normalTexture.texCoord, 3u);
    EXPECT_EQ(scene.texCoords3[1], glm::vec2(7, 1));
    material["extensions"]["KHR_materials_transmission"]["transmissionTexture"] = {{"index", 0},
                                                                                   {"texCoord", 1}};
    EXPECT_EQ(file.refusal(), "material 0: uses 5 sets of texture coordinates, the limit is 4");
}

TEST(GltfTexture, TransformMayNameTheSet) {
    TwoSetsFile file;
    file.info()["texCoord"] = 0;
    file.info()["extensions"]["KHR_texture_transform"] = {{"texCoord", 1}};
    EXPECT_EQ(PaintedFile::ref(file.load()).texCoord, 1u);
}

TEST(GltfTexture, DataUriAndBufferView) {
    PaintedFile file;
    file.root["images"][0] = {{"uri", "data:image/png;base64," + base64(file.kPng)}};
    EXPECT_EQ(file.load().images.at(0).bytes.at(0), glm::u8vec4(1, 2, 3, 4));
    const int view = file.addView(std::vector<char>(file.kPng.begin(), file.kPng.end()));
    file.root["images"][0] = {{"bufferView", view}, {"mimeType", "image/png"}};
    EXPECT_EQ(file.load().images.at(0).bytes.at(0), glm::u8vec4(1, 2, 3, 4));
    file.root["images"][0]["bufferView"] = 9;
    EXPECT_EQ(file.refusal(), "image 0: buffer view 9 does not exist, there are 2");
    file.root["bufferViews"][1]["byteLength"] = 1 << 20;
    file.root["images"][0]["bufferView"] = 1;
    EXPECT_NE(file.refusal().find("image 0: buffer view 1 reaches past the end of buffer 0"),
              std::string::npos);
    file.root["images"][0] = Json::object();
    EXPECT_EQ(file.refusal(), "image 0: has neither uri nor bufferView");
}

TEST(GltfTexture, NamesWithSpacesEscapesAndUnicode) {
    PaintedFile file;
    std::filesystem::create_directory(file.folder / "ü ❤");
    writeFile(file.folder / "ü ❤/a b+100%.png", file.kPng);
    for (const char* uri : {"ü ❤/a b+100%.png", "%C3%BC%20%E2%9D%A4/a%20b+100%25.png"}) {
        file.root["images"][0]["uri"] = uri;
        EXPECT_EQ(file.load().images.at(0).name, "texture 'ü ❤/a b+100%.png'");
    }
}

TEST(GltfTexture, MissingOrBrokenIsRefusedByName) {
    PaintedFile file;
    const auto refusal = [&](const char* uri) {
        file.root["images"][0]["uri"] = uri;
        return file.refusal();
    };
    writeFile(file.folder / "broken.png", file.kPng.substr(0, 50));
    writeFile(file.folder / "prose.png", "Dear friend,");
    writeFile(file.folder / "empty.png", "");
    std::filesystem::create_directory(file.folder / "folder.png");
    std::filesystem::create_symlink("/etc/passwd", file.folder / "link.png");
    EXPECT_EQ(refusal("gone.png"), "texture 'gone.png' is missing");
    EXPECT_EQ(refusal("folder.png"), "texture 'folder.png' is missing");
    EXPECT_EQ(refusal("broken.png"), "texture 'broken.png' is cut off");
    EXPECT_EQ(refusal("prose.png"), "texture 'prose.png' is no picture of a known format");
    EXPECT_EQ(refusal("empty.png"), "texture 'empty.png' is no picture of a known format");
    EXPECT_EQ(refusal("../wood.png"), "texture '../wood.png' leaves the scene's folder");
    EXPECT_EQ(refusal("%2e%2e/wood.png"), "texture '../wood.png' leaves the scene's folder");
    EXPECT_EQ(refusal("link.png"), "texture 'link.png' leaves the scene's folder");
    EXPECT_EQ(refusal("https://example.org/a.png"),
              "texture 'https://example.org/a.png' is not a file beside the scene");
    EXPECT_EQ(refusal("data:image/png,abc"), "image 0 has a data URI that is not base64");
}

TEST(GltfTexture, MissingBesideASceneWithoutAFolder) {
    PaintedFile file;
    file.root["images"][0]["uri"] = "gone.png";
    file.write();
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(file.folder / "");
    EXPECT_EQ(refusalOf("scene.gltf"), "texture 'gone.png' is missing");
    std::filesystem::current_path(before);
}

TEST(GltfTexture, BackslashesInTheNameOfAnImage) {
    PaintedFile file;
    std::filesystem::create_directory(file.folder / "images");
    writeFile(file.folder / "images/a.png", onePixelPng({9, 8, 7, 6}));
    for (const char* uri : {"images\\a.png", "images%5Ca.png", ".\\images\\a.png"}) {
        file.root["images"][0]["uri"] = uri;
        EXPECT_EQ(file.load().images.at(0).bytes.at(0), glm::u8vec4(9, 8, 7, 6)) << uri;
    }
    // A name that has a backslash is its own.
    writeFile(file.folder / "images\\a.png", onePixelPng({1, 1, 1, 1}));
    file.root["images"][0]["uri"] = "images\\a.png";
    EXPECT_EQ(file.load().images.at(0).bytes.at(0), glm::u8vec4(1));
}

TEST(GltfTexture, FlawsThatHideNoTexelAreReported) {
    PaintedFile file;
    const std::string jpeg = jpegFile();
    writeFile(file.folder / "wood.png", jpeg.substr(0, jpeg.size() - 2));
    const Scene scene = file.load();
    EXPECT_EQ(scene.images.at(0).bytes, std::vector<glm::u8vec4>(64, glm::u8vec4(200, 200, 200, 255)));
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_TRUE(scene.warnings[0].ends_with("texture 'wood.png' has no end mark"));
}

TEST(GltfTexture, MissingMayBeAllowed) {
    PaintedFile file;
    file.root["images"] = {{{"uri", "gone.png"}}, {{"uri", "wood.png"}}};
    file.root["textures"] = {{{"source", 0}}, {{"source", 1}}};
    file.root["materials"][0]["emissiveTexture"] = {{"index", 1}};
    const Scene scene = file.load({.allowMissingTextures = true});
    EXPECT_EQ(scene.materials[0].baseColorTexture.texture, kNoTexture);
    EXPECT_EQ(scene.materials[0].emissiveTexture.texture, 0u);
    ASSERT_EQ(scene.textures.size(), 1u);
    EXPECT_EQ(scene.textures[0].image, 0u);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_TRUE(scene.warnings[0].ends_with("texture 'gone.png' is missing; its uses are left out"));
    expectError(ErrorKind::inputRefused, "texture 'gone.png' is missing", {"allowMissingTextures"},
                [&] { file.load(); });
}

TEST(GltfTexture, OnlyWhatTrianglesUseIsRead) {
    PaintedFile file;
    file.root["images"].push_back({{"uri", "gone.png"}});
    file.root["textures"].push_back({{"source", 1}});
    file.root["materials"].push_back({{"emissiveTexture", {{"index", 1}}}}); // used by no triangle
    file.root["materials"][0]["occlusionTexture"] = {{"index", 1}};          // ignored by a path tracer
    const Scene scene = file.load();
    EXPECT_EQ(scene.textures.size(), 1u);
    EXPECT_EQ(scene.images.size(), 1u);
    EXPECT_EQ(scene.materials[1].emissiveTexture.texture, kNoTexture);
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfTexture, ImageOfSeveralTexturesIsReadOnce) {
    PaintedFile file;
    file.root["samplers"] = {{{"wrapS", 33071}}};
    file.root["textures"].push_back({{"source", 0}, {"sampler", 0}});
    file.root["materials"][0]["emissiveTexture"] = {{"index", 1}};
    file.root["materials"][0]["normalTexture"] = {{"index", 0}};
    const Scene scene = file.load();
    EXPECT_EQ(scene.images.size(), 1u);
    ASSERT_EQ(scene.textures.size(), 2u);
    const Material& material = scene.materials[0];
    EXPECT_EQ(material.baseColorTexture.texture, material.normalTexture.texture);
    EXPECT_EQ(scene.textures[material.emissiveTexture.texture].wrapS, TextureWrap::clampToEdge);
    EXPECT_EQ(scene.textures[material.normalTexture.texture].wrapS, TextureWrap::repeat);
}

TEST(GltfTexture, LinearFormatIsNotDecoded) {
    PaintedFile file;
    writeFile(file.folder / "sky.hdr", hdrFile(1, 1, {128, 128, 128, 129}));
    file.root["images"][0]["uri"] = "sky.hdr";
    const Scene scene = file.load();
    EXPECT_FALSE(PaintedFile::ref(scene).isSrgb);
    EXPECT_EQ(scene.images[0].floats.at(0), glm::vec4(1.0f));
}

TEST(GltfTexture, WebpBeforeItsFallback) {
    PaintedFile file;
    writeFile(file.folder / "wood.webp", webpFile());
    file.root["images"].push_back({{"uri", "wood.webp"}});
    file.root["textures"][0]["extensions"]["EXT_texture_webp"]["source"] = 1;
    file.root["extensionsUsed"] = {"EXT_texture_webp"};
    const Scene scene = file.load();
#ifdef METAMARCH_WEBP
    EXPECT_EQ(scene.images.at(0).width, 4u);
    EXPECT_TRUE(scene.warnings.empty());
    file.root["textures"][0].erase("source");
    file.root["extensionsRequired"] = {"EXT_texture_webp"};
    EXPECT_EQ(file.load().images.at(0).width, 4u);
#else
    EXPECT_EQ(scene.images.at(0).width, 1u);
    EXPECT_EQ(scene.warnings.size(), 1u);
    file.root["extensionsRequired"] = {"EXT_texture_webp"};
    EXPECT_EQ(file.refusal(), "extensionsRequired: EXT_texture_webp is not supported");
#endif
}

TEST(GltfTexture, UnknownImageFormatWithAFallback) {
    PaintedFile file;
    file.root["textures"][0]["extensions"]["KHR_texture_basisu"]["source"] = 0;
    file.root["extensionsUsed"] = {"KHR_texture_basisu"};
    EXPECT_TRUE(file.load().warnings.empty());
    file.root["textures"][0].erase("source");
    file.root["extensionsRequired"] = {"KHR_texture_basisu"};
    const std::string reason = "texture 0 has only an image of KHR_texture_basisu, which is not decoded";
    EXPECT_EQ(file.refusal(), reason);
    EXPECT_TRUE(
        file.load({.allowMissingTextures = true}).warnings[0].ends_with(reason + "; its uses are left out"));
    file.root["textures"][0]["extensions"]["MSFT_texture_dds"]["source"] = 0;
    EXPECT_EQ(
        file.refusal(),
        "texture 0 has only an image of KHR_texture_basisu and of MSFT_texture_dds, which is not decoded");
    file.root["textures"][0].erase("extensions");
    EXPECT_EQ(file.refusal(), "texture 0 has no image of a known format");
}

} // namespace
} // namespace metamarch

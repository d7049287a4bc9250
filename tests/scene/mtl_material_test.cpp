// SPDX-License-Identifier: MIT
// Materials of OBJ, converted to glTF's.
#include "fixtures/expect_error.h"
#include "metamarch/error/error.h"
#include "scene/gltf_file.h"
#include "scene/picture_file.h"

#include <gtest/gtest.h>

namespace metamarch {
namespace {

class MtlMaterial : public testing::Test {
  protected:
    // Loads a triangle whose material has these lines.
    Scene load(const std::string& lines, const ImportOptions& options = {}) {
        writeFile(folder / "a.mtl", "newmtl m\n" + lines);
        writeFile(folder / "a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 0.75\n"
                                    "vn 0 0 1\nusemtl m\nf 1/1/1 2/2/1 3/3/1\n");
        return loadScene(folder / "a.obj", options);
    }

    Material material(const std::string& lines) { return load(lines).materials.at(0); }

    std::string refusal(const std::string& lines) {
        return lineOfError(ErrorKind::inputRefused, [&] { load(lines); })
            .substr((folder / "a.obj").string().size() + 2);
    }

    void writePng(const std::string& name, std::uint32_t width, int channels,
                  const std::vector<unsigned char>& samples) {
        writeFile(folder / name, pngFile(width, 1, channels, samples));
    }

    static const TextureImage& image(const Scene& scene, const TextureRef& ref) {
        return scene.images.at(scene.textures.at(ref.texture).image);
    }

    TemporaryFolder folder;
};

TEST_F(MtlMaterial, ClassicNumbers) {
    const Material m = material("Kd 0.25 0.5 2\nKs 0.5 0.25 0\nNs 30\nKe 0 4 2\nd 0.5\nillum 2\nNi 1.0\n");
    EXPECT_EQ(m.name, "m");
    EXPECT_EQ(m.baseColorFactor, glm::vec4(0.25f, 0.5f, 1, 0.5f));
    EXPECT_EQ(m.alphaMode, AlphaMode::blend);
    EXPECT_EQ(m.metallicFactor, 0.0f);
    EXPECT_FLOAT_EQ(m.roughnessFactor, 0.5f); // (2 / 32)^(1/4)
    EXPECT_EQ(m.specularFactor, 1.0f);
    EXPECT_EQ(m.specularColorFactor, glm::vec3(0.5f, 0.25f, 0));
    EXPECT_EQ(m.emissiveFactor * m.emissiveStrength, glm::vec3(0, 4, 2));
    EXPECT_EQ(m.transmissionFactor, 0.0f);
    EXPECT_EQ(m.ior, 1.5f); // Ni counts only for materials that transmit light
    EXPECT_TRUE(m.doubleSided);
}

TEST_F(MtlMaterial, NothingShinesWithoutKs) {
    const Material m = material("Kd 1 1 1\n");
    EXPECT_EQ(m.specularFactor, 0.0f);
    EXPECT_EQ(m.roughnessFactor, 1.0f);
    EXPECT_EQ(m.alphaMode, AlphaMode::opaque);
}

TEST_F(MtlMaterial, PhysicalNumbersComeFirst) {
    const Material m = material("Kd 1 1 1\nKs 0 0 0\nNs 900\nPr 0.25\nPm 0.75\n");
    EXPECT_EQ(m.roughnessFactor, 0.25f);
    EXPECT_EQ(m.metallicFactor, 0.75f);
    EXPECT_EQ(m.specularFactor, 1.0f);
}

TEST_F(MtlMaterial, GlassTransmits) {
    const Material solid = material("Kd 1 1 1\nd 0.25\nNi 1.75\nillum 7\n");
    EXPECT_EQ(solid.transmissionFactor, 0.75f);
    EXPECT_EQ(solid.ior, 1.75f);
    EXPECT_GT(solid.thicknessFactor, 0.0f);
    EXPECT_EQ(solid.alphaMode, AlphaMode::opaque);
    EXPECT_EQ(material("d 0.25\nNi 1.75\nillum 4\n").thicknessFactor, 0.0f);
}

TEST_F(MtlMaterial, TextureIsPaintedUpright) {
    std::filesystem::create_directory(folder / "maps");
    writePng("maps/a b.png", 1, 3, {10, 20, 30});
    const Scene scene = load("map_Kd -clamp on maps\\a b.png\n");
    const TextureRef ref = scene.materials[0].baseColorTexture;
    EXPECT_TRUE(ref.isSrgb);
    EXPECT_EQ(image(scene, ref).bytes.at(0), glm::u8vec4(10, 20, 30, 255));
    EXPECT_EQ(image(scene, ref).name, "texture 'maps/a b.png'");
    EXPECT_EQ(scene.textures[ref.texture].wrapS, TextureWrap::clampToEdge);
    EXPECT_EQ(scene.texCoords[2], glm::vec2(0, 0.25f)); // v points down
    EXPECT_EQ(load("map_Kd maps/a b.png\n").textures[0].wrapT, TextureWrap::repeat);
}

TEST_F(MtlMaterial, MaskBecomesAlpha) {
    writePng("leaf.png", 2, 3, {10, 20, 30, 40, 50, 60});
    writePng("mask.png", 2, 1, {0, 200});
    writePng("small.png", 1, 1, {100});
    writePng("cut.png", 2, 4, {9, 9, 9, 7, 9, 9, 9, 255});
    using Bytes = std::vector<glm::u8vec4>;
    const auto bytes = [&](const std::string& lines) {
        const Scene scene = load(lines);
        EXPECT_EQ(scene.materials[0].alphaMode, AlphaMode::blend);
        return image(scene, scene.materials[0].baseColorTexture).bytes;
    };
    EXPECT_EQ(bytes("map_Kd leaf.png\nmap_d mask.png\n"), Bytes({{10, 20, 30, 0}, {40, 50, 60, 200}}));
    EXPECT_EQ(bytes("map_Kd leaf.png\nmap_d small.png\n"), Bytes({{10, 20, 30, 100}, {40, 50, 60, 100}}));
    EXPECT_EQ(bytes("map_Kd leaf.png\nmap_d cut.png\n"), Bytes({{10, 20, 30, 7}, {40, 50, 60, 255}}));
    EXPECT_EQ(bytes("map_Kd small.png\nmap_d mask.png\n"), Bytes({{100, 100, 100, 0}, {100, 100, 100, 200}}));
    EXPECT_EQ(bytes("map_d mask.png\n"), Bytes({{255, 255, 255, 0}, {255, 255, 255, 200}}));
    // The alpha of map_Kd itself is not a mask.
    EXPECT_EQ(load("map_Kd cut.png\n").materials[0].alphaMode, AlphaMode::opaque);
}

TEST_F(MtlMaterial, RoughnessAndMetallicShareATexture) {
    writePng("rough.png", 1, 1, {50});
    writePng("metal.png", 1, 1, {90});
    const auto texel = [&](const std::string& lines) {
        const Scene scene = load(lines);
        const TextureRef ref = scene.materials[0].metallicRoughnessTexture;
        EXPECT_FALSE(ref.isSrgb);
        return image(scene, ref).bytes.at(0);
    };
    const glm::u8vec4 both = texel("map_Pr rough.png\nmap_Pm metal.png\n");
    EXPECT_EQ(both.g, 50);
    EXPECT_EQ(both.b, 90);
    const glm::u8vec4 metal = texel("Pr 0.5\nmap_Pm metal.png\n");
    EXPECT_EQ(metal.g, 255);
    EXPECT_EQ(metal.b, 90);
    EXPECT_EQ(material("map_Pm metal.png\n").metallicFactor, 1.0f);
    EXPECT_EQ(material("map_Pr rough.png\n").metallicFactor, 0.0f);
}

TEST_F(MtlMaterial, EmissionMapAloneShines) {
    writePng("lamp.png", 1, 3, {10, 20, 30});
    const Material m = material("map_Ke lamp.png\n");
    EXPECT_EQ(m.emissiveFactor * m.emissiveStrength, glm::vec3(1));
    EXPECT_TRUE(m.emissiveTexture.isSrgb);
    EXPECT_EQ(material("Ke 0.5 0 0\nmap_Ke lamp.png\n").emissiveFactor, glm::vec3(0.5f, 0, 0));
}

TEST_F(MtlMaterial, NormalMapBringsTangents) {
    writePng("flat.png", 1, 3, {128, 128, 255});
    const Scene scene = load("norm flat.png\n");
    EXPECT_FALSE(scene.materials[0].normalTexture.isSrgb);
    ASSERT_EQ(scene.tangents.size(), 3u);
    EXPECT_LT(glm::distance(scene.tangents[0], glm::vec4(1, 0, 0, 1)), 1e-6f);
    EXPECT_TRUE(load("map_Kd flat.png\n").tangents.empty());
}

TEST_F(MtlMaterial, OneFileIsReadOnce) {
    writePng("a.png", 1, 3, {1, 2, 3});
    const Scene scene = load("map_Kd a.png\nmap_Ke a.png\n");
    EXPECT_EQ(scene.images.size(), 1u);
}

TEST_F(MtlMaterial, MissingTexturesAreRefusedByName) {
    writePng("a.png", 1, 3, {1, 2, 3});
    writeFile(folder / "prose.png", "Dear friend,");
    EXPECT_EQ(refusal("map_Kd gone.png\n"), "texture 'gone.png' is missing");
    EXPECT_EQ(refusal("map_Kd a.png\nmap_d gone.png\n"), "texture 'gone.png' is missing");
    EXPECT_EQ(refusal("map_Kd ../a.png\n"), "texture '../a.png' leaves the scene's folder");
    EXPECT_EQ(refusal("map_Kd /etc/passwd\n"), "texture '/etc/passwd' leaves the scene's folder");
    EXPECT_EQ(refusal("map_Kd prose.png\n"), "texture 'prose.png' is no picture of a known format");
    const Scene scene = load("map_Kd gone.png\n", {.allowMissingTextures = true});
    EXPECT_EQ(scene.materials[0].baseColorTexture.texture, kNoTexture);
    EXPECT_TRUE(scene.warnings.at(0).ends_with("texture 'gone.png' is missing; its uses are left out"));
}

TEST_F(MtlMaterial, MapsThatAreNotRenderedAreReported) {
    const Scene scene = load("disp gone.png\nrefl -type sphere gone.png\nmap_Ns gone.png\ndisp b.png\n");
    EXPECT_TRUE(scene.warnings.at(0).ends_with("a.obj: 'a.mtl': disp, refl, map_Ns are not rendered"));
}

TEST_F(MtlMaterial, NeitherVariantsNorAnimations) {
    expectError(ErrorKind::invalidArgument, "there is no variant blue; the scene has none", {"variant"},
                [&] { load("", {.variant = "blue"}); });
    expectError(ErrorKind::invalidArgument, "there is no animation walk; the scene has none", {"animation"},
                [&] { load("", {.time = 1.0, .animation = "walk"}); });
    EXPECT_TRUE(load("", {.time = 1.0}).warnings.at(0).ends_with("it looks the same at any time"));
}

} // namespace
} // namespace metamarch

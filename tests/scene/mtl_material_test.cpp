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

    // Loads a triangle for each of the materials n0, n1, ... of a library.
    Scene loadAll(const std::string& library, int materials) {
        writeFile(folder / "a.mtl", library);
        std::string content = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n";
        for (int i = 0; i < materials; ++i) {
            content += "usemtl n" + std::to_string(i) + "\nf 1 2 3\n";
        }
        writeFile(folder / "a.obj", content);
        return loadScene(folder / "a.obj");
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

TEST_F(MtlMaterial, ColorsOfOneNumberAreGrey) {
    EXPECT_EQ(material("Kd 0.5\n").baseColorFactor, glm::vec4(0.5f, 0.5f, 0.5f, 1));
    EXPECT_EQ(material("Ke .25 # a glow\n").emissiveFactor, glm::vec3(0.25f));
    const Scene scene = load("Kd spectral steel.rfl 0.5\nKs xyz 0.5 0.5 0.5\nPm high\nKe nan 0 0\n");
    EXPECT_EQ(scene.materials[0].baseColorFactor, glm::vec4(0.6f, 0.6f, 0.6f, 1));
    EXPECT_EQ(scene.materials[0].emissiveFactor, glm::vec3(0));
    EXPECT_EQ(material("Kd 0.5# grey\n").baseColorFactor, glm::vec4(0.5f, 0.5f, 0.5f, 1));
    const Scene words = load("Kd 0.5 abc\nKe 0.5 0.5 nan\n");
    EXPECT_EQ(words.materials[0].baseColorFactor, glm::vec4(0.6f, 0.6f, 0.6f, 1));
    EXPECT_TRUE(words.warnings.at(0).ends_with("'a.mtl': Kd, Ke have no number there and are skipped"));
    ASSERT_EQ(scene.warnings.size(), 2u);
    EXPECT_TRUE(scene.warnings[0].ends_with("'a.mtl': Kd spectral, Ks xyz are not rendered"));
    EXPECT_TRUE(scene.warnings[1].ends_with("'a.mtl': Pm, Ke have no number there and are skipped"));
}

TEST_F(MtlMaterial, BackslashesJoinLines) {
    writePng("a.png", 1, 3, {10, 20, 30});
    EXPECT_EQ(material("Kd 1 \\\n 0 0\n").baseColorFactor, glm::vec4(1, 0, 0, 1));
    EXPECT_NE(material("map_Kd \\\r\n a.png\n").baseColorTexture.texture, kNoTexture);
    EXPECT_EQ(material("Kd 1 0 0 # C:\\\nd 0.5\n").baseColorFactor, glm::vec4(1, 0, 0, 0.5f));
}

TEST_F(MtlMaterial, MapsWithoutNumbersHaveFactorOne) {
    writePng("a.png", 1, 3, {10, 20, 30});
    EXPECT_EQ(material("illum 0\nmap_Kd a.png\n").baseColorFactor, glm::vec4(1));
    EXPECT_EQ(material("Kd 0.5 0.5 0.5\nmap_Kd a.png\n").baseColorFactor, glm::vec4(0.5f, 0.5f, 0.5f, 1));
    const Material shiny = material("map_Ks a.png\n");
    EXPECT_EQ(shiny.specularFactor, 1.0f);
    EXPECT_EQ(shiny.specularColorFactor, glm::vec3(1));
    EXPECT_NE(shiny.specularColorTexture.texture, kNoTexture);
    EXPECT_EQ(material("map_Kd -mm 0 0.25 a.png\n").baseColorFactor, glm::vec4(0.25f, 0.25f, 0.25f, 1));
}

TEST_F(MtlMaterial, TransparencyOfBothMeanings) {
    EXPECT_EQ(material("Tr 0.25\n").baseColorFactor.a, 0.75f);
    EXPECT_EQ(material("Tr 0\n").alphaMode, AlphaMode::opaque);
    EXPECT_EQ(material("d 0.25\nTr 0.25\n").baseColorFactor.a, 0.25f);
    EXPECT_EQ(material("Tr 1\nillum 4\n").transmissionFactor, 1.0f);
    const auto warnings = [&](const std::string& lines, float alpha) {
        const Scene scene = load(lines);
        EXPECT_EQ(scene.materials[0].baseColorFactor.a, alpha);
        std::string text;
        for (const std::string& line : scene.warnings) {
            text += line.substr((folder / "a.obj").string().size() + 2);
        }
        return text;
    };
    EXPECT_EQ(warnings("Tr 1.000000\n", 1.0f),
              "by Tr nothing would be seen of the materials m; they are rendered opaque");
    EXPECT_EQ(warnings("d 0\n", 0.0f), "nothing is seen of the materials m: their d is 0");
    EXPECT_EQ(warnings("d -halo 0.5\n", 0.5f), "'a.mtl': d -halo are not rendered");
    // MeshLab names itself before the first material.
    EXPECT_EQ(warnings("# Converted by Meshlab Group\nnewmtl m\nTr 0.25\n", 0.25f), "");
    EXPECT_EQ(warnings("# Converted by Meshlab Group\nnewmtl m\nTr 1\n", 1.0f), "");
}

TEST_F(MtlMaterial, WarningsNameManyMaterialsInOneLine) {
    writePng("a.png", 1, 3, {10, 20, 30});
    writePng("b.png", 1, 3, {10, 20, 30});
    std::string library;
    for (int i = 0; i < 10; ++i) {
        library += "newmtl n" + std::to_string(i) + "\nd 0\nnorm a.png\nbump b.png\nmap_Kd a.png\n" +
                   "map_d -s 2 2 b.png\n";
    }
    std::vector<std::string> warnings = loadAll(library, 10).warnings;
    for (std::string& line : warnings) {
        line = line.substr((folder / "a.obj").string().size() + 2);
    }
    EXPECT_EQ(
        warnings,
        std::vector<std::string>(
            {"nothing is seen of the materials n0, n1, n2, n3, n4, n5, n6, n7 and 2 more: their d is 0",
             "the bump maps of the materials n0, n1, n2, n3, n4, n5, n6, n7 and 2 more are not rendered: "
             "they have normal maps",
             "the options of the maps b.png are not rendered: each becomes one picture with another map, "
             "whose options hold for both"}));
}

// Many materials share a colour map; each has a mask of its own.
TEST_F(MtlMaterial, EqualPicturesAreOne) {
    writePng("a.png", 1, 3, {10, 20, 30});
    std::string library;
    for (int i = 0; i < 6; ++i) {
        const std::string mask = std::to_string(i % 3);
        writePng("m" + mask + ".png", 1, 1, {static_cast<unsigned char>(i % 3)});
        library += "newmtl n" + std::to_string(i) + "\nmap_Kd a.png\nmap_d m" + mask + ".png\n";
    }
    library += "newmtl n6\nmap_Kd a.png\nnewmtl n7\nbump a.png\n";
    const Scene scene = loadAll(library, 8);
    EXPECT_EQ(scene.images.size(), 5u); // with three masks, without one, and as heights
    const auto imageOf = [&](int material) {
        const Material& of = scene.materials[static_cast<std::size_t>(material)];
        const TextureRef& ref = material == 7 ? of.normalTexture : of.baseColorTexture;
        return scene.textures.at(ref.texture).image;
    };
    for (int i = 0; i < 8; ++i) {
        for (int j = 0; j < 8; ++j) {
            EXPECT_EQ(imageOf(i) == imageOf(j), i == j || (i < 6 && j < 6 && i % 3 == j % 3));
        }
    }
}

TEST_F(MtlMaterial, MapsAreFoundBesideTheLibraryAndTheObj) {
    std::filesystem::create_directory(folder / "sub");
    writePng("sub/t.png", 1, 3, {10, 20, 30});
    writePng("o.png", 1, 3, {40, 50, 60});
    writeFile(folder / "sub" / "t.mtl", "newmtl x\nmap_Kd t.png\nmap_Ke o.png\n");
    writeFile(folder / "a.obj", "mtllib sub/t.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl x\nf 1 2 3\n");
    const Scene scene = loadScene(folder / "a.obj");
    EXPECT_EQ(image(scene, scene.materials[0].baseColorTexture).name, "texture 'sub/t.png'");
    EXPECT_EQ(image(scene, scene.materials[0].emissiveTexture).name, "texture 'o.png'");
}

TEST_F(MtlMaterial, NamesOfMaps) {
    writePng("t.png", 1, 3, {10, 20, 30});
    writePng("two words.png", 1, 3, {1, 2, 3});
    for (const std::string name :
         {"t.png \t", "C:\\Users\\me\\t.png", ".\\t.png", "/home/me/t.png", "textures/t.png", "\"t.png\"",
          "t.png # painted", "-s 2 t.png", "-o 1 2 3 -clamp off t.png", "-bm 1 -blendu on -cc off t.png"}) {
        const Scene scene = load("map_Kd " + name + "\n");
        EXPECT_EQ(scene.warnings, std::vector<std::string>()) << name;
        ASSERT_EQ(scene.images.size(), 1u) << name;
        EXPECT_EQ(scene.images[0].name, "texture 't.png'");
    }
    EXPECT_EQ(load("map_Kd -s 1 1 two words.png \n").images.at(0).name, "texture 'two words.png'");
    EXPECT_EQ(load("map_Kd \n").materials[0].baseColorTexture.texture, kNoTexture);
    EXPECT_EQ(refusal("map_Kd C:\\gone.png\n"), "texture 'C:/gone.png' is missing");
    EXPECT_EQ(refusal("map_Kd -5 gone.png\n"), "texture '-5 gone.png' is missing");
}

// The map is looked up at scale * (u, v) + offset, v up.
TEST_F(MtlMaterial, ScaleAndOffsetPlaceAMap) {
    writePng("t.png", 1, 3, {10, 20, 30});
    const auto lookedUp = [&](const std::string& options, const glm::vec2& uv) {
        const glm::vec2 at = material("map_Kd " + options + " t.png\n").baseColorTexture.transform *
                             glm::vec3(uv.x, 1.0f - uv.y, 1);
        return glm::vec2(at.x, 1.0f - at.y);
    };
    const glm::vec2 uv(0.5f, 0.25f);
    EXPECT_EQ(lookedUp("-s 2 4 1 -o 0.25 0.5 0", uv), glm::vec2(1.25f, 1.5f));
    EXPECT_EQ(lookedUp("-o 0.25 -s 2", uv), glm::vec2(1.25f, 0.25f));
    EXPECT_EQ(lookedUp("-s 2 3", uv), glm::vec2(1, 0.75f));
    EXPECT_EQ(lookedUp("-s -1 1 1", uv), glm::vec2(-0.5f, 0.25f));
}

TEST_F(MtlMaterial, OptionsThatAreNotRenderedAreNamed) {
    writePng("t.png", 1, 3, {10, 20, 30});
    const Scene scene = load("map_Kd -t 1 2 3 -texres 512 -boost 2 -mm 0.5 1 -cc on -blendu off -imfchan r "
                             "-type sphere t.png\nfancy 3\nKq 1\n");
    ASSERT_EQ(scene.warnings.size(), 2u);
    EXPECT_TRUE(scene.warnings[0].ends_with("'a.mtl': fancy, Kq are not known and are skipped"));
    EXPECT_TRUE(
        scene.warnings[1].ends_with("'a.mtl': -t, -texres, -boost, -mm with a base, -cc on, -blendu off, "
                                    "-imfchan r of map_Kd, -type are options of maps that are not rendered"));
}

TEST_F(MtlMaterial, ChannelsOfMaps) {
    writePng("t.png", 1, 4, {10, 20, 30, 40});
    const auto texel = [&](const std::string& line, TextureRef Material::*ref) {
        const Scene scene = load(line + " t.png\n");
        return image(scene, scene.materials[0].*ref).bytes.at(0);
    };
    EXPECT_EQ(texel("map_d", &Material::baseColorTexture).a, 40);
    EXPECT_EQ(texel("map_d -imfchan g", &Material::baseColorTexture).a, 20);
    EXPECT_EQ(texel("map_d -imfchan l", &Material::baseColorTexture).a, 19); // 0.2126 r + 0.7152 g + 0.0722 b
    EXPECT_EQ(texel("map_Pr", &Material::metallicRoughnessTexture).g, 10);
    EXPECT_EQ(texel("map_Pr -imfchan m", &Material::metallicRoughnessTexture).g, 40);
    EXPECT_EQ(texel("Pc 1\nmap_Pc -imfchan b", &Material::clearcoatTexture).r, 30);
}

TEST_F(MtlMaterial, LayersOfThePhysicalExtension) {
    const Material m = material("Pr 0.5\nPs 0.25\nPc 0.75\nPcr 0.125\naniso 0.5\nanisor 0.25\n");
    EXPECT_EQ(m.sheenColorFactor, glm::vec3(0.25f));
    EXPECT_EQ(m.sheenRoughnessFactor, 0.5f);
    EXPECT_EQ(m.clearcoatFactor, 0.75f);
    EXPECT_EQ(m.clearcoatRoughnessFactor, 0.125f);
    EXPECT_EQ(m.anisotropyStrength, 0.5f);
    EXPECT_FLOAT_EQ(m.anisotropyRotation, 1.57079633f);
}

// A ramp that rises by 1 / 255 from texel to texel has the slope of that height over one texel.
TEST_F(MtlMaterial, BumpMapsAreHeights) {
    std::vector<unsigned char> ramp;
    ramp.reserve(200);
    for (int x = 0; x < 200; ++x) {
        ramp.push_back(static_cast<unsigned char>(x));
    }
    writePng("ramp.png", 200, 1, ramp);
    const Scene scene = load("bump -bm 0.5 ramp.png\n");
    const Material& m = scene.materials[0];
    EXPECT_EQ(m.normalScale, 0.5f);
    EXPECT_FALSE(m.normalTexture.isSrgb);
    const glm::vec3 normal = glm::vec3(image(scene, m.normalTexture).floats.at(100)) * 2.0f - 1.0f;
    const float slope = 0.01f * 200.0f / 255.0f; // kHeightOfWhite
    EXPECT_LT(glm::distance(normal, glm::normalize(glm::vec3(-slope, 0, 1))), 1e-6f);
    EXPECT_EQ(scene.tangents.size(), scene.positions.size());
    writePng("flat.png", 1, 1, {77});
    const Scene flat = load("map_Bump flat.png\n");
    EXPECT_EQ(image(flat, flat.materials[0].normalTexture).floats.at(0), glm::vec4(0.5f, 0.5f, 1, 1));
}

TEST_F(MtlMaterial, BumpMapsOfBlenderAreNormalMaps) {
    writePng("normal.png", 2, 3, {128, 128, 255, 160, 100, 240});
    const Scene scene = load("map_Bump -bm 2 normal.png\n");
    EXPECT_EQ(scene.materials[0].normalScale, 2.0f);
    EXPECT_EQ(image(scene, scene.materials[0].normalTexture).bytes.at(1), glm::u8vec4(160, 100, 240, 255));
}

TEST_F(MtlMaterial, ALaterMaterialOfTheSameNameAddsToIt) {
    const Material m = material("Kd 1 0 0\nnewmtl other\nKd 0 1 0\nnewmtl m\nKe 0 0 1\n");
    EXPECT_EQ(m.baseColorFactor, glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(m.emissiveFactor, glm::vec3(0, 0, 1));
}

TEST_F(MtlMaterial, NeitherVariantsNorAnimations) {
    expectError(ErrorKind::invalidArgument, "there is no variant blue; the file has none", {"variant"},
                [&] { load("", {.variant = "blue"}); });
    expectError(ErrorKind::invalidArgument, "there is no animation walk; the file has none", {"animation"},
                [&] { load("", {.time = 1.0, .animation = "walk"}); });
    EXPECT_TRUE(load("", {.time = 1.0}).warnings.at(0).ends_with("it looks the same at any time"));
}

} // namespace
} // namespace metamarch

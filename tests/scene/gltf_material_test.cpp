// SPDX-License-Identifier: MIT
// Materials of glTF, with every extension and with variants.
#include "fixtures/expect_error.h"
#include "metamarch/error/error.h"
#include "scene/gltf_file.h"
#include "scene/picture_file.h"

#include <gtest/gtest.h>

namespace metamarch {
namespace {

using Json = nlohmann::json;

// A triangle with one material, and textures 0 and 1.
class MaterialFile : public TriangleFile {
  public:
    explicit MaterialFile(const Json& material) {
        root["materials"] = {material};
        primitive()["material"] = 0;
        root["textures"] = {{{"source", 0}}, {{"source", 1}}};
        root["images"] = {{{"uri", "0.png"}}, {{"uri", "1.png"}}};
        writeFile(folder / "0.png", onePixelPng({10, 20, 30, 40}));
        writeFile(folder / "1.png", onePixelPng({50, 60, 70, 80}));
    }

    Material material(const ImportOptions& options = {}) { return load(options).materials.at(0); }
};

Json withExtension(const char* name, const Json& content) { return {{"extensions", {{name, content}}}}; }

Json texture(int index) { return {{"index", index}}; }

TEST(GltfMaterial, DefaultsAreTheSpecifications) {
    const Material material = MaterialFile(Json::object()).material();
    EXPECT_EQ(material.baseColorFactor, glm::vec4(1));
    EXPECT_EQ(material.metallicFactor, 1.0f);
    EXPECT_EQ(material.roughnessFactor, 1.0f);
    EXPECT_EQ(material.emissiveFactor, glm::vec3(0));
    EXPECT_EQ(material.emissiveStrength, 1.0f);
    EXPECT_EQ(material.alphaMode, AlphaMode::opaque);
    EXPECT_EQ(material.alphaCutoff, 0.5f);
    EXPECT_FALSE(material.doubleSided);
    EXPECT_FALSE(material.unlit);
    EXPECT_EQ(material.ior, 1.5f);
    EXPECT_EQ(material.transmissionFactor, 0.0f);
    EXPECT_EQ(material.thicknessFactor, 0.0f);
    EXPECT_EQ(material.attenuationDistance, INFINITY);
    EXPECT_EQ(material.specularFactor, 1.0f);
    EXPECT_EQ(material.sheenColorFactor, glm::vec3(0));
    EXPECT_EQ(material.iridescenceIor, 1.3f);
    EXPECT_EQ(material.iridescenceThicknessMaximum, 400.0f);
    for (const TextureRef* ref : texturesOf(const_cast<Material&>(material))) {
        EXPECT_EQ(ref->texture, kNoTexture);
    }
}

// glTF 2.0, 3.7.2.1: a primitive without a material has the default one.
TEST(GltfMaterial, PrimitivesWithoutAMaterialHaveTheDefault) {
    TriangleFile file;
    file.primitive()["attributes"]["COLOR_0"] = file.addVec3({1, 0, 0, 1, 0, 0, 1, 0, 0});
    file.root["meshes"][0]["primitives"].push_back(file.primitive());
    file.root["materials"] = {{{"name", "painted"}}};
    file.root["meshes"][0]["primitives"].push_back(file.primitive());
    file.root["meshes"][0]["primitives"][2]["material"] = 0;
    const Scene scene = file.load();
    EXPECT_EQ(scene.triangleMaterial, std::vector<std::uint32_t>({1, 1, 0}));
    ASSERT_EQ(scene.materials.size(), 2u);
    const Material& material = scene.materials[1];
    EXPECT_EQ(material.name, "default");
    EXPECT_EQ(material.baseColorFactor, glm::vec4(1));
    EXPECT_EQ(material.metallicFactor, 1.0f);
    EXPECT_EQ(material.roughnessFactor, 1.0f);
    EXPECT_EQ(scene.colors[0], glm::vec4(1, 0, 0, 1));
}

// The conversion of KHR_materials_ior: a dielectric of index 0 reflects its specular colour.
TEST(GltfMaterial, SpecularGlossiness) {
    Json source =
        withExtension("KHR_materials_pbrSpecularGlossiness", {{"diffuseFactor", {1, 0.5, 0.25, 0.5}},
                                                              {"specularFactor", {0.25, 0.5, 1}},
                                                              {"glossinessFactor", 0.75}});
    source["pbrMetallicRoughness"] = {{"metallicFactor", 1}, {"baseColorTexture", texture(1)}};
    const Material plain = MaterialFile(source).material();
    EXPECT_EQ(plain.baseColorFactor, glm::vec4(1, 0.5f, 0.25f, 0.5f));
    EXPECT_EQ(plain.baseColorTexture.texture, kNoTexture);
    EXPECT_EQ(plain.metallicFactor, 0.0f);
    EXPECT_EQ(plain.roughnessFactor, 0.25f);
    EXPECT_EQ(plain.ior, 0.0f);
    EXPECT_EQ(plain.specularFactor, 1.0f);
    EXPECT_EQ(plain.specularColorFactor, glm::vec3(0.25f, 0.5f, 1));
    // What the extension replaces is not read, so faults there do not refuse the file.
    source["pbrMetallicRoughness"] = {{"baseColorTexture", texture(99)}, {"baseColorFactor", "red"}};
    source["extensions"]["KHR_materials_specular"] = {{"specularFactor", 0.5},
                                                      {"specularTexture", texture(99)}};
    source["extensions"]["KHR_materials_ior"] = {{"ior", "high"}};
    const Material replaced = MaterialFile(source).material();
    EXPECT_EQ(replaced.baseColorFactor, glm::vec4(1, 0.5f, 0.25f, 0.5f));
    EXPECT_EQ(replaced.specularFactor, 1.0f);
    EXPECT_EQ(replaced.ior, 0.0f);
    const Material bare =
        MaterialFile(withExtension("KHR_materials_pbrSpecularGlossiness", Json::object())).material();
    EXPECT_EQ(bare.specularColorFactor, glm::vec3(1));
    EXPECT_EQ(bare.roughnessFactor, 0.0f);
}

// Glossiness is in the alpha of the specular colour: 0.5 * 80 / 255, whose roughness is 215 / 255.
TEST(GltfMaterial, SpecularGlossinessTextures) {
    MaterialFile file(withExtension("KHR_materials_pbrSpecularGlossiness",
                                    {{"diffuseTexture", texture(0)},
                                     {"specularGlossinessTexture", {{"index", 1}, {"texCoord", 1}}},
                                     {"glossinessFactor", 0.5}}));
    const Scene scene = file.load();
    const Material& material = scene.materials.at(0);
    const auto texel = [&](const TextureRef& ref) {
        return scene.images[scene.textures[ref.texture].image].bytes.at(0);
    };
    EXPECT_EQ(texel(material.baseColorTexture), glm::u8vec4(10, 20, 30, 40));
    EXPECT_TRUE(material.baseColorTexture.isSrgb);
    EXPECT_EQ(texel(material.specularColorTexture), glm::u8vec4(50, 60, 70, 80));
    EXPECT_TRUE(material.specularColorTexture.isSrgb);
    EXPECT_EQ(texel(material.metallicRoughnessTexture).g, 215);
    EXPECT_FALSE(material.metallicRoughnessTexture.isSrgb);
    EXPECT_EQ(material.metallicRoughnessTexture.texCoord, 1u);
    EXPECT_EQ(material.roughnessFactor, 1.0f);
    EXPECT_EQ(scene.images.size(), 3u);
    // A texture that the importer made has no number in the file.
    file.root["materials"].push_back({{"emissiveTexture", texture(2)}});
    EXPECT_EQ(file.refusal(), "material 1: emissiveTexture: texture 2 does not exist, there are 2");
}

TEST(GltfMaterial, CoreFactorsAndTextures) {
    MaterialFile file({{"name", "lamp"},
                       {"doubleSided", true},
                       {"emissiveFactor", {0.5, 0.25, 0}},
                       {"emissiveTexture", texture(1)},
                       {"alphaMode", "MASK"},
                       {"alphaCutoff", 0.25},
                       {"normalTexture", {{"index", 1}, {"scale", -2}}},
                       {"pbrMetallicRoughness",
                        {{"baseColorFactor", {0.25, 0.5, 0.75, 1}},
                         {"baseColorTexture", texture(0)},
                         {"metallicFactor", 0.5},
                         {"roughnessFactor", 0.125},
                         {"metallicRoughnessTexture", texture(1)}}}});
    const Scene scene = file.load();
    const Material& lamp = scene.materials.at(0);
    EXPECT_EQ(lamp.name, "lamp");
    EXPECT_EQ(lamp.baseColorFactor, glm::vec4(0.25f, 0.5f, 0.75f, 1.0f));
    EXPECT_EQ(lamp.metallicFactor, 0.5f);
    EXPECT_EQ(lamp.roughnessFactor, 0.125f);
    EXPECT_EQ(lamp.emissiveFactor, glm::vec3(0.5f, 0.25f, 0));
    EXPECT_EQ(lamp.normalScale, -2.0f);
    EXPECT_EQ(lamp.alphaMode, AlphaMode::mask);
    EXPECT_EQ(lamp.alphaCutoff, 0.25f);
    EXPECT_TRUE(lamp.doubleSided);
    // Colours are sRGB-encoded, everything else is linear.
    EXPECT_TRUE(lamp.baseColorTexture.isSrgb);
    EXPECT_TRUE(lamp.emissiveTexture.isSrgb);
    EXPECT_FALSE(lamp.normalTexture.isSrgb);
    EXPECT_FALSE(lamp.metallicRoughnessTexture.isSrgb);
    ASSERT_EQ(scene.textures.size(), 2u);
    const auto texel = [&](const TextureRef& ref) {
        return scene.images[scene.textures[ref.texture].image].bytes.at(0);
    };
    EXPECT_EQ(texel(lamp.baseColorTexture), glm::u8vec4(10, 20, 30, 40));
    EXPECT_EQ(texel(lamp.normalTexture), glm::u8vec4(50, 60, 70, 80));
    EXPECT_EQ(scene.triangleMaterial, std::vector<std::uint32_t>({0}));
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfMaterial, OutOfRangeIsClamped) {
    const Material material =
        MaterialFile({{"alphaCutoff", -1},
                      {"emissiveFactor", {2, -1, 0}},
                      {"pbrMetallicRoughness", {{"baseColorFactor", {2, -1, 0, 1}}, {"metallicFactor", 7}}}})
            .material();
    EXPECT_EQ(material.baseColorFactor, glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(material.metallicFactor, 1.0f);
    EXPECT_EQ(material.emissiveFactor, glm::vec3(1, 0, 0));
    EXPECT_EQ(material.alphaCutoff, 0.0f);
}

TEST(GltfMaterial, AlphaModes) {
    const auto modeNamed = [](const char* name) {
        return MaterialFile(Json{{"alphaMode", name}}).material().alphaMode;
    };
    EXPECT_EQ(modeNamed("OPAQUE"), AlphaMode::opaque);
    EXPECT_EQ(modeNamed("MASK"), AlphaMode::mask);
    EXPECT_EQ(modeNamed("BLEND"), AlphaMode::blend);
}

TEST(GltfMaterial, SmallExtensions) {
    EXPECT_TRUE(MaterialFile(withExtension("KHR_materials_unlit", Json::object())).material().unlit);
    EXPECT_EQ(MaterialFile(withExtension("KHR_materials_emissive_strength", {{"emissiveStrength", 8}}))
                  .material()
                  .emissiveStrength,
              8.0f);
    const auto ior = [](double value) {
        return MaterialFile(withExtension("KHR_materials_ior", {{"ior", value}})).material().ior;
    };
    EXPECT_EQ(ior(1.25), 1.25f);
    EXPECT_EQ(ior(0.5), 1.0f);
    EXPECT_EQ(ior(0.0), 0.0f); // the extension's value for a dielectric that reflects everything
    EXPECT_EQ(
        MaterialFile(withExtension("KHR_materials_dispersion", {{"dispersion", 2}})).material().dispersion,
        2.0f);
}

TEST(GltfMaterial, TransmissionAndVolume) {
    Json source = withExtension("KHR_materials_transmission",
                                {{"transmissionFactor", 0.5}, {"transmissionTexture", texture(1)}});
    source["extensions"]["KHR_materials_volume"] = {{"thicknessFactor", 0.25},
                                                    {"thicknessTexture", texture(0)},
                                                    {"attenuationDistance", 4},
                                                    {"attenuationColor", {0.5, 0.25, 1}}};
    const Material material = MaterialFile(source).material({.scale = -2.0f});
    EXPECT_EQ(material.transmissionFactor, 0.5f);
    EXPECT_NE(material.transmissionTexture.texture, kNoTexture);
    EXPECT_FALSE(material.transmissionTexture.isSrgb);
    EXPECT_EQ(material.thicknessFactor, 0.5f);
    EXPECT_NE(material.thicknessTexture.texture, kNoTexture);
    EXPECT_EQ(material.attenuationDistance, 8.0f);
    EXPECT_EQ(material.attenuationColor, glm::vec3(0.5f, 0.25f, 1));

    const Material diffuse = MaterialFile(withExtension("KHR_materials_diffuse_transmission",
                                                        {{"diffuseTransmissionFactor", 0.5},
                                                         {"diffuseTransmissionTexture", texture(0)},
                                                         {"diffuseTransmissionColorFactor", {1, 0.5, 0}},
                                                         {"diffuseTransmissionColorTexture", texture(1)}}))
                                 .material();
    EXPECT_EQ(diffuse.diffuseTransmissionFactor, 0.5f);
    EXPECT_FALSE(diffuse.diffuseTransmissionTexture.isSrgb);
    EXPECT_EQ(diffuse.diffuseTransmissionColorFactor, glm::vec3(1, 0.5f, 0));
    EXPECT_TRUE(diffuse.diffuseTransmissionColorTexture.isSrgb);
}

TEST(GltfMaterial, SpecularSheenAndAnisotropy) {
    const Material specular =
        MaterialFile(withExtension("KHR_materials_specular", {{"specularFactor", 0.5},
                                                              {"specularTexture", texture(0)},
                                                              {"specularColorFactor", {2, 1, 0}},
                                                              {"specularColorTexture", texture(1)}}))
            .material();
    EXPECT_EQ(specular.specularFactor, 0.5f);
    EXPECT_FALSE(specular.specularTexture.isSrgb);
    EXPECT_EQ(specular.specularColorFactor, glm::vec3(2, 1, 0));
    EXPECT_TRUE(specular.specularColorTexture.isSrgb);

    const Material sheen =
        MaterialFile(withExtension("KHR_materials_sheen", {{"sheenColorFactor", {0.5, 0.25, 1}},
                                                           {"sheenColorTexture", texture(0)},
                                                           {"sheenRoughnessFactor", 0.75},
                                                           {"sheenRoughnessTexture", texture(1)}}))
            .material();
    EXPECT_EQ(sheen.sheenColorFactor, glm::vec3(0.5f, 0.25f, 1));
    EXPECT_TRUE(sheen.sheenColorTexture.isSrgb);
    EXPECT_EQ(sheen.sheenRoughnessFactor, 0.75f);
    EXPECT_FALSE(sheen.sheenRoughnessTexture.isSrgb);
    EXPECT_NE(sheen.sheenRoughnessTexture.texture, kNoTexture);

    const Material brushed =
        MaterialFile(withExtension("KHR_materials_anisotropy", {{"anisotropyStrength", 0.5},
                                                                {"anisotropyRotation", -2},
                                                                {"anisotropyTexture", texture(1)}}))
            .material();
    EXPECT_EQ(brushed.anisotropyStrength, 0.5f);
    EXPECT_EQ(brushed.anisotropyRotation, -2.0f);
    EXPECT_NE(brushed.anisotropyTexture.texture, kNoTexture);
}

TEST(GltfMaterial, ClearcoatAndIridescence) {
    const Material coat =
        MaterialFile(withExtension("KHR_materials_clearcoat",
                                   {{"clearcoatFactor", 0.5},
                                    {"clearcoatTexture", texture(0)},
                                    {"clearcoatRoughnessFactor", 0.25},
                                    {"clearcoatRoughnessTexture", texture(1)},
                                    {"clearcoatNormalTexture", {{"index", 1}, {"scale", 3}}}}))
            .material();
    EXPECT_EQ(coat.clearcoatFactor, 0.5f);
    EXPECT_EQ(coat.clearcoatRoughnessFactor, 0.25f);
    EXPECT_EQ(coat.clearcoatNormalScale, 3.0f);
    EXPECT_NE(coat.clearcoatTexture.texture, kNoTexture);
    EXPECT_EQ(coat.clearcoatRoughnessTexture.texture, coat.clearcoatNormalTexture.texture);
    EXPECT_EQ(coat.normalScale, 1.0f);

    const Material film = MaterialFile(withExtension("KHR_materials_iridescence",
                                                     {{"iridescenceFactor", 0.5},
                                                      {"iridescenceTexture", texture(0)},
                                                      {"iridescenceIor", 2},
                                                      {"iridescenceThicknessMinimum", 200},
                                                      {"iridescenceThicknessMaximum", 100},
                                                      {"iridescenceThicknessTexture", texture(1)}}))
                              .material();
    EXPECT_EQ(film.iridescenceFactor, 0.5f);
    EXPECT_EQ(film.iridescenceIor, 2.0f);
    EXPECT_EQ(film.iridescenceThicknessMinimum, 200.0f); // may exceed the maximum
    EXPECT_EQ(film.iridescenceThicknessMaximum, 100.0f);
    EXPECT_NE(film.iridescenceTexture.texture, kNoTexture);
    EXPECT_NE(film.iridescenceThicknessTexture.texture, kNoTexture);
}

TEST(GltfMaterial, WrongTypesAreRefused) {
    const std::vector<std::pair<Json, std::string>> cases = {
        {{{"alphaMode", "GLOW"}}, "material 0: alphaMode 'GLOW' is none of OPAQUE, MASK, BLEND"},
        {{{"doubleSided", 1}}, "material 0: doubleSided is neither true nor false"},
        {{{"emissiveFactor", {1, 1}}}, "material 0: emissiveFactor has 2 numbers, not 3"},
        {{{"emissiveFactor", {1, 1, "x"}}}, "material 0: emissiveFactor: \"x\" is not a finite number"},
        {{{"pbrMetallicRoughness", {{"metallicFactor", "x"}}}},
         "material 0: pbrMetallicRoughness: metallicFactor: \"x\" is not a finite number"},
        {{{"pbrMetallicRoughness", {{"metallicFactor", 1e300}}}},
         "material 0: pbrMetallicRoughness: metallicFactor: 1e+300 is not a finite number"},
        {{{"pbrMetallicRoughness", 1}}, "material 0: pbrMetallicRoughness: is not an object"},
        {{{"normalTexture", texture(9)}}, "material 0: normalTexture: texture 9 does not exist, there are 2"},
        {{{"normalTexture", {{"index", std::uint64_t{1} << 32}}}},
         "material 0: normalTexture: index: 4294967296 is not an integer from 0 to 2147483647"},
        {{{"normalTexture", Json::object()}}, "material 0: normalTexture: has no index"},
        {{{"extensions", {{"KHR_materials_volume", {{"attenuationDistance", 0}}}}}},
         "material 0: KHR_materials_volume: attenuationDistance is 0"},
    };
    for (const auto& [material, line] : cases) {
        MaterialFile file(material);
        EXPECT_EQ(file.refusal(), line);
    }
}

class VariantFile : public MaterialFile {
  public:
    VariantFile() : MaterialFile(Json{{"name", "plain"}}) {
        root["materials"].push_back({{"name", "leather"}});
        root["materials"].push_back({{"name", "silk"}});
        root["extensionsRequired"] = {"KHR_materials_variants"};
        root["extensions"]["KHR_materials_variants"]["variants"] = {
            {{"name", "brown"}}, {{"name", "black"}}, {{"name", "white"}}};
        primitive()["extensions"]["KHR_materials_variants"]["mappings"] = {
            {{"variants", {0, 1}}, {"material", 1}}, {{"variants", {2}}, {"material", 2}}};
    }

    std::uint32_t materialOf(const std::string& variant) {
        return load({.variant = variant}).triangleMaterial.at(0);
    }
};

TEST(GltfVariants, ChooseTheMaterial) {
    VariantFile file;
    EXPECT_EQ(file.load().variants, std::vector<std::string>({"brown", "black", "white"}));
    EXPECT_EQ(file.materialOf(""), 0u);
    EXPECT_EQ(file.materialOf("brown"), 1u);
    EXPECT_EQ(file.materialOf("black"), 1u);
    EXPECT_EQ(file.materialOf("white"), 2u);
    EXPECT_EQ(file.materialOf("2"), 2u);
}

TEST(GltfVariants, PrimitiveWithoutAMappingKeepsItsMaterial) {
    VariantFile file;
    file.primitive()["extensions"]["KHR_materials_variants"]["mappings"].erase(1);
    EXPECT_EQ(file.materialOf("white"), 0u);
}

TEST(GltfVariants, UnknownOnesAreListed) {
    VariantFile file;
    expectError(ErrorKind::invalidArgument,
                "there is no variant blue; the file has 0 'brown', 1 'black', 2 'white'", {"variant"},
                [&] { file.load({.variant = "blue"}); });
    TriangleFile plain;
    expectError(ErrorKind::invalidArgument, "there is no variant blue; the file has none", {"variant"},
                [&] { plain.load({.variant = "blue"}); });
}

TEST(GltfVariants, MaterialOutOfRange) {
    VariantFile file;
    file.primitive()["extensions"]["KHR_materials_variants"]["mappings"][0]["material"] = 9;
    expectError(ErrorKind::inputRefused, "mapping 0: material 9 does not exist, there are 3",
                [&] { file.load({.variant = "brown"}); });
}

} // namespace
} // namespace metamarch

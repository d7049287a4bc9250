// SPDX-License-Identifier: MIT
#include "fixtures/expect_error.h"
#include "metamarch/settings/render_settings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace metamarch {
namespace {

// Everything that a picture is made of, with the settings of `metamarch render`.
struct Picture {
    Picture() {
        declareCamera(settings, view);
        declareTone(settings, tone);
        declareIntegrator(settings, path, std::size(kIntegrators));
        declarePath(settings, path, samplesPerPixel);
        declareLight(settings, light);
        declareImport(settings, import);
        declareStructure(settings, structure);
    }

    ViewChoice view;
    ToneMapping tone;
    PathChoice path;
    std::uint32_t samplesPerPixel = 64;
    LightChoice light;
    ImportOptions import;
    AccelerationOptions structure;
    SettingList settings;
};

void expectRefused(const std::string& name, const std::string& text, const std::string& what) {
    Picture picture;
    EXPECT_EQ(lineOfError(ErrorKind::invalidArgument, [&] { picture.settings.at(name).set(text); }), what)
        << name << ' ' << text;
    EXPECT_FALSE(picture.settings.at(name).isChanged()) << name << ' ' << text;
}

TEST(Setting, RefusesWhatIsNoValueAndSaysWhatToGive) {
    for (const char* text : {"", "0", "-1", "1.5", "many", "99999999999", "1e3", "0x10", "5 "}) {
        expectRefused("spp", text, "give a whole number from 1 to 16777216");
    }
    for (const char* text : {"", "nan", "-1", "inf", "1e39", "2,5"}) {
        expectRefused("clamp", text, "give a finite luminance of at least 0");
    }
    for (const char* text : {"0", "nan", "inf", "1e300", "1e-300", "-0"}) {
        expectRefused("scale", text, "give a finite number other than 0");
    }
    for (const char* text : {"0", "180", "-10", "nan"}) {
        expectRefused("vfov", text, "give degrees between 0 and 180");
    }
    for (const char* text : {"1,2", "1,2,3,4", "1,,3", "0,nan,0", "0,1e39,0", "1, 2,3", "up"}) {
        expectRefused("eye", text, "give three numbers, x,y,z");
    }
    expectRefused("integrator", "fast", "give path, direct, ao or primary");
    expectRefused("integrator", "", "give path, direct, ao or primary");
    expectRefused("preset", "fast", "give paper");
    expectRefused("background", "1,-1,1", "give radiance of at least 0");
    expectRefused("sun", "0,0,0", "give a direction, not 0,0,0");
}

TEST(Setting, ReachesTheLibrarysStructs) {
    Picture picture;
    const std::pair<const char*, const char*> given[] = {
        {"spp", "+16"},          {"integrator", "ao"},    {"brdf", "gltf"},  {"clamp", "2.5"},
        {"env", "sky.hdr"},      {"env-rotation", "450"}, {"vfov", "30"},    {"eye", "1,2,3"},
        {"target", "+1,0,0"},    {"filter", "tent"},      {"table", "gcd"},  {"cells", "1e6"},
        {"no-exit-boxes", "on"}, {"merge", "on"},         {"scale", "-2"},   {"time", "0.5"},
        {"tone-map", "agx"},     {"exposure", "-1"},      {"unit", "1,2,4"}, {"orthographic", "3"},
    };
    for (const auto& [name, text] : given) {
        picture.settings.at(name).set(text);
        EXPECT_TRUE(picture.settings.at(name).isGiven()) << name;
        EXPECT_TRUE(picture.settings.at(name).isChanged()) << name;
    }
    EXPECT_EQ(picture.samplesPerPixel, 16u);
    EXPECT_EQ(picture.path.integrator, Integrator::ao);
    EXPECT_EQ(picture.path.brdf, Brdf::gltf);
    EXPECT_EQ(picture.path.clamp, 2.5f);
    EXPECT_EQ(picture.light.kind, LightChoice::Kind::map);
    EXPECT_EQ(picture.light.map, "sky.hdr");
    EXPECT_FLOAT_EQ(picture.light.rotation, 1.57079633f); // a turn of 450 degrees is one of 90
    EXPECT_EQ(picture.view.verticalFov, 30.0);
    EXPECT_EQ(picture.view.eye, glm::vec3(1.0f, 2.0f, 3.0f));
    EXPECT_EQ(picture.view.lens.pixelFilter, kFilterTent);
    EXPECT_EQ(picture.view.target, glm::vec3(1.0f, 0.0f, 0.0f));
    EXPECT_EQ(picture.view.orthographicHeight, 3.0f);
    EXPECT_EQ(picture.structure.table, TableMethod::gcd);
    EXPECT_EQ(picture.structure.cells, 1000000u);
    EXPECT_EQ(picture.structure.unit, glm::dvec3(1.0, 2.0, 4.0));
    EXPECT_FALSE(picture.structure.exitBoxes);
    EXPECT_TRUE(picture.structure.mergeLeaves);
    EXPECT_EQ(picture.import.scale, -2.0f);
    EXPECT_EQ(picture.import.time, 0.5);
    EXPECT_EQ(picture.tone.toneOperator, kToneAgx);
    EXPECT_EQ(picture.tone.exposure, -1.0f);
}

// The panel reads a value as text, and a header's options are typed again.
TEST(Setting, TakesItsOwnTextBack) {
    const std::pair<const char*, const char*> given[] = {
        {"spp", "7"},
        {"seed", "4294967295"},
        {"max-bounces", "0"},
        {"clamp", "0.1"},
        {"sun", "1,2,3"},
        {"sun", "-1e-3,0.7,-2"},
        {"sun", "0,1,0"},
        {"env-rotation", "12.345678"},
        {"env-rotation", "-0.1"},
        {"env-intensity", "0.001"},
        {"aperture", "1e-5"},
        {"vfov", "33.3"},
        {"eye", "0.1,-2,3e5"},
        {"tree-depth", "12"},
        {"unit", "0.25"},
        {"scale", "1e-3"},
        {"quantum", "0.125"},
        {"focus-distance", "0.7"},
        {"up", "0,0,1"},
        {"time", "0.1"},
        {"background", "0.1,0.2,0.3"},
        {"exposure", "0.3"},
    };
    for (const auto& [name, text] : given) {
        Picture typed;
        typed.settings.at(name).set(text);
        Picture again;
        again.settings.at(name).set(typed.settings.at(name).text());
        EXPECT_EQ(again.settings.at(name).text(), typed.settings.at(name).text()) << name << ' ' << text;
        EXPECT_TRUE(again.settings.at(name).isChanged()) << name << ' ' << text;
        EXPECT_EQ(again.light, typed.light) << name << ' ' << text;
        EXPECT_EQ(again.path, typed.path) << name << ' ' << text;
        EXPECT_EQ(again.import, typed.import) << name << ' ' << text;
        EXPECT_EQ(again.tone, typed.tone) << name << ' ' << text;
        EXPECT_EQ(again.view.eye, typed.view.eye) << name << ' ' << text;
        EXPECT_EQ(again.view.verticalFov, typed.view.verticalFov) << name << ' ' << text;
        EXPECT_EQ(again.view.lens.apertureRadius, typed.view.lens.apertureRadius) << name << ' ' << text;
        EXPECT_EQ(again.structure.unit, typed.structure.unit) << name << ' ' << text;
        EXPECT_EQ(again.structure.quantum, typed.structure.quantum) << name << ' ' << text;
    }
}

TEST(Setting, ChangesNothingByItsDeclaration) {
    const Picture picture;
    EXPECT_EQ(picture.settings.changedText(), "");
    EXPECT_EQ(picture.light, LightChoice());
    EXPECT_EQ(picture.path, PathChoice());
    EXPECT_EQ(picture.import, ImportOptions());
}

TEST(Setting, NamesEverySettingOnceAndOnlyThoseThatAreThere) {
    const Picture picture;
    const SettingList& settings = picture.settings;
    for (const Setting& setting : settings.all()) {
        EXPECT_EQ(&settings.at(setting.name()), &setting) << setting.name() << " is declared twice";
        EXPECT_FALSE(setting.help().empty()) << setting.name();
        EXPECT_FALSE(setting.group().empty() && setting.name() != "integrator") << setting.name();
        for (const std::string& other : setting.excluded()) {
            EXPECT_NO_THROW(settings.at(other)) << setting.name();
        }
        for (const std::string& other : setting.needed()) {
            EXPECT_NO_THROW(settings.at(other)) << setting.name();
        }
    }
    EXPECT_THROW(settings.at("sise"), std::out_of_range);
}

TEST(Setting, WritesWhatDiffersAsACommandLine) {
    Picture picture;
    picture.settings.at("spp").set("64"); // the default
    picture.settings.at("seed").set("5");
    picture.settings.at("panorama").set("on");
    picture.settings.at("background").set("1,0.5,0");
    EXPECT_EQ(picture.settings.changedText(), "--panorama --seed 5 --background 1,0.5,0");
    constexpr std::string_view kWithout[] = {"seed"};
    EXPECT_EQ(picture.settings.changedText(kWithout), "--panorama --background 1,0.5,0");
    Picture lit;
    lit.settings.at("sky").set("on");
    lit.settings.at("camera").set("Front view");
    EXPECT_EQ(lit.settings.changedText(), "--camera 'Front view' --sky");
    lit.settings.at("camera").set("Ann's $1");
    EXPECT_EQ(lit.settings.changedText(), "--camera 'Ann'\\''s $1' --sky");
}

TEST(Setting, PresetAndTreeDepthGoTogetherInEitherOrder) {
    for (const bool presetFirst : {true, false}) {
        Picture picture;
        const auto preset = [&] { picture.settings.at("preset").set("paper"); };
        if (presetFirst) {
            preset();
        }
        picture.settings.at("tree-depth").set("20");
        if (!presetFirst) {
            preset();
        }
        EXPECT_EQ(picture.structure.treeDepth, 20u);
        EXPECT_FALSE(picture.structure.exitBoxes);
    }
}

TEST(Setting, TonesFollowTheIntegratorUnlessTheyAreGiven) {
    for (const auto& [name, integrator] : kIntegrators) {
        Picture picture;
        chooseTone(picture.settings, integrator, picture.tone);
        const bool isLight = integrator == Integrator::path || integrator == Integrator::direct;
        EXPECT_EQ(picture.tone.toneOperator, isLight ? kToneNeutral : kToneNone) << name;
        picture.settings.at("tone-map").set("aces");
        chooseTone(picture.settings, integrator, picture.tone);
        EXPECT_EQ(picture.tone.toneOperator, kToneAces) << name;
    }
}

TEST(Setting, RefusesStructuresThatExcludeEachOther) {
    AccelerationOptions options;
    EXPECT_NO_THROW(checkStructure(options));
    options.table = TableMethod::gcd;
    options.quantum = 0.1;
    EXPECT_NO_THROW(checkStructure(options));
    options.cells = 9;
    expectError(ErrorKind::invalidArgument, "exclude it", [&] { checkStructure(options); });
    options.cells.reset();
    options.table = TableMethod::rectilinear;
    expectError(ErrorKind::invalidArgument, "gcd table alone", [&] { checkStructure(options); });
    options.quantum.reset();
    options.mergeLeaves = true;
    expectError(ErrorKind::invalidArgument, "even cells", [&] { checkStructure(options); });
}

} // namespace
} // namespace metamarch

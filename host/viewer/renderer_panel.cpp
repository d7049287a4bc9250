// SPDX-License-Identifier: MIT
#include "metamarch/viewer/renderer_panel.h"

#include "metamarch/render/view_names.h"
#include "metamarch/viewer/channel_picture.h"
#include "metamarch/viewer/heat_range.h"
#include "metamarch/viewer/panel_controls.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <imgui.h>
#include <string>

namespace metamarch::viewer {
namespace {

void drawViewChoice(Settings& settings) {
    const char* const beauty = "picture";
    const char* const current = settings.view              ? render::kViewNames[*settings.view].name.data()
                                : settings.channel.empty() ? beauty
                                                           : settings.channel.c_str();
    if (ImGui::BeginCombo("view", current, ImGuiComboFlags_HeightLargest)) {
        if (ImGui::Selectable(beauty, !settings.view && settings.channel.empty())) {
            settings.view.reset();
            settings.channel.clear();
        }
        for (const render::ViewName& known : render::kViewNames) {
            if (ImGui::Selectable(known.name.data(), settings.view == known.view)) {
                settings.view = known.view;
            }
        }
        ImGui::Separator();
        for (const Aov& channel : shownChannels()) {
            const std::string name = channel.name();
            if (ImGui::Selectable(fmt::format("channel {}", name).c_str(),
                                  !settings.view && settings.channel == name)) {
                settings.view.reset();
                settings.channel = name;
            }
        }
        ImGui::EndCombo();
    }
    if (settings.view && isHeatMap(*settings.view)) {
        if (ImGui::SliderFloat("hottest", &settings.heatMax, 1.0f, kMostHeat, "%.0f",
                               kTypedWithin | ImGuiSliderFlags_Logarithmic)) {
            settings.isHeatFitted = false;
        }
        ImGui::SameLine();
        ImGui::Checkbox("automatic", &settings.isHeatFitted);
    }
}

void drawTraversals(ViewerState& state) {
    Settings& settings = state.settings;
    settings.traversal = chooseName("traversal", settings.traversal, state.runnable);
    bool isSplit = state.hasSplit();
    if (ImGui::Checkbox("split", &isSplit)) {
        state.actions.push_back(Action::toggleSplit);
    }
    if (state.hasSplit()) {
        settings.secondTraversal = chooseName("right side", settings.secondTraversal, state.runnable);
    }
}

// Draws the control for the setting's kind, with its help as a tooltip. Draws nothing for a setting that is
// neither a flag nor has choices or a slider.
void drawSetting(Setting& setting) {
    if (setting.kind() != Setting::Kind::flag && setting.choices().empty() && !setting.slider()) {
        return;
    }
    std::string label = setting.name();
    std::ranges::replace(label, '-', ' ');
    if (setting.kind() == Setting::Kind::flag) {
        bool isOn = setting.text() == "on";
        if (ImGui::Checkbox(label.c_str(), &isOn)) {
            setting.set(isOn ? "on" : "off");
        }
    } else if (!setting.choices().empty()) {
        const std::string current = setting.text();
        const std::string chosen = chooseName(label.c_str(), current, setting.choices());
        if (chosen != current) {
            setting.set(chosen);
        }
    } else if (const std::optional<Slider>& slider = setting.slider()) {
        auto value = std::stof(setting.text());
        const ImGuiSliderFlags scale = slider->isLogarithmic ? ImGuiSliderFlags_Logarithmic : 0;
        if (ImGui::SliderFloat(label.c_str(), &value, static_cast<float>(slider->least),
                               static_cast<float>(slider->most), slider->format, kTypedWithin | scale)) {
            setting.set(fmt::format("{}", slider->isWhole ? std::round(value) : value));
        }
    }
    if (ImGui::IsItemHovered()) {
        ImGui::SetTooltip("%s", setting.help().c_str());
    }
}

void drawLight(LightChoice& light, SettingList& controls, const bool sceneHasLight) {
    using Kind = LightChoice::Kind;
    constexpr const char* kKinds[] = {"the scene's, or a sky", "map", "background", "sky"};
    int kind = static_cast<int>(light.kind);
    if (ImGui::Combo("light", &kind, kKinds, IM_ARRAYSIZE(kKinds)) &&
        !(static_cast<Kind>(kind) == Kind::map && light.map.empty())) {
        light.kind = static_cast<Kind>(kind);
    }
    const bool isSky = light.kind == Kind::sky || (light.kind == Kind::automatic && !sceneHasLight);
    if (light.map.empty()) {
        ImGui::TextDisabled("drop a .hdr or .exr map on the window");
    }
    if (light.kind == Kind::map) {
        line(light.map.filename().string());
        drawSetting(controls.at("env-rotation"));
    }
    if (light.kind == Kind::background) {
        ImGui::ColorEdit3("radiance", &light.background.x,
                          ImGuiColorEditFlags_Float | ImGuiColorEditFlags_HDR);
    }
    if (light.kind == Kind::map || isSky) {
        drawSetting(controls.at("env-intensity"));
    }
    if (isSky) {
        ImGui::SliderAngle("sun's height", &light.sunElevation, -10.0f, 90.0f, "%.0f deg", kTypedWithin);
        ImGui::SliderAngle("sun's azimuth", &light.sunAzimuth, -180.0f, 180.0f, "%.0f deg", kTypedWithin);
    }
}

void drawBackdrop(Settings& settings) {
    using Kind = BackdropChoice::Kind;
    constexpr const char* kKinds[] = {"the surroundings", "nothing", "a colour", "blurred surroundings"};
    int kind = static_cast<int>(settings.backdrop.kind);
    if (ImGui::Combo("behind the scene", &kind, kKinds, IM_ARRAYSIZE(kKinds))) {
        settings.backdrop.kind = static_cast<Kind>(kind);
        settings.path.isTransparent = settings.backdrop.kind != Kind::surroundings;
    }
    if (ImGui::IsItemHovered()) {
        ImGui::SetTooltip("%s",
                          "The light stays the same. Over nothing, P saves a transparent picture. Where "
                          "the surroundings are not shown, Ctrl+S saves a transparent film.");
    }
    if (settings.backdrop.kind == Kind::solid) {
        ImGui::ColorEdit3("colour", &settings.backdrop.color.x);
    }
}

} // namespace

void drawRenderer(ViewerState& state) {
    Settings& settings = state.settings;
    drawViewChoice(settings);
    int samples = static_cast<int>(settings.samples);
    if (ImGui::InputInt("samples", &samples, 64, 1024, ImGuiInputTextFlags_EnterReturnsTrue)) {
        settings.samples = static_cast<std::uint32_t>(std::clamp(samples, 1, static_cast<int>(kMostSamples)));
    }
    drawTraversals(state);
    ImGui::Checkbox("denoise", &settings.isDenoised);
    ImGui::Checkbox("preview before the picture", &settings.hasPreview);
    ImGui::BeginDisabled(!state.filterRefusal.empty());
    ImGui::Checkbox("filter the first samples", &settings.hasFilter);
    ImGui::EndDisabled();
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) {
        ImGui::SetTooltip("%s", state.filterRefusal.empty()
                                    ? "The film is never filtered, nor is what P and Ctrl+S save."
                                    : std::string(state.filterRefusal).c_str());
    }
    for (Setting& setting : state.controls.all()) {
        drawSetting(setting);
    }
    drawLight(settings.light, state.lightControls, state.scene && state.scene->hasLight);
    drawBackdrop(settings);
}

} // namespace metamarch::viewer

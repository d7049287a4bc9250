// SPDX-License-Identifier: MIT
#include "metamarch/viewer/panels.h"

#include "metamarch/render/view_names.h"
#include "metamarch/viewer/channel_picture.h"
#include "metamarch/viewer/controls.h"
#include "metamarch/viewer/heat_range.h"
#include "metamarch/viewer/overlay.h"
#include "metamarch/vulkan/byte_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <imgui.h>
#include <string>

namespace metamarch::viewer {
namespace {

// The user may type a number into a slider; it is clamped as well.
constexpr ImGuiSliderFlags kTypedWithin = ImGuiSliderFlags_AlwaysClamp;

// Breaks a text that is wider than the panel.
void line(const std::string& text) { ImGui::TextWrapped("%s", text.c_str()); }

// Draws a list of names. Returns the name that the user chooses in this frame, otherwise `current`.
template <class Names, class NameOf>
std::string chooseName(const char* const label, const std::string& current, const Names& names,
                       const NameOf& nameOf) {
    std::string chosen = current;
    if (ImGui::BeginCombo(label, current.c_str())) {
        for (const auto& entry : names) {
            const std::string name(nameOf(entry));
            if (ImGui::Selectable(name.c_str(), name == current)) {
                chosen = name;
            }
        }
        ImGui::EndCombo();
    }
    return chosen;
}

constexpr auto kItself = [](const auto& name) { return name; };

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
    settings.traversal = chooseName("traversal", settings.traversal, state.runnable, kItself);
    bool isSplit = state.hasSplit();
    if (ImGui::Checkbox("split", &isSplit)) {
        state.actions.push_back(Action::toggleSplit);
    }
    if (state.hasSplit()) {
        settings.secondTraversal =
            chooseName("right side", settings.secondTraversal, state.runnable, kItself);
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
        const std::string chosen = chooseName(label.c_str(), current, setting.choices(), kItself);
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

void drawCamera(ViewerState& state) {
    ViewCamera& camera = state.camera;
    const std::vector<SceneCamera>& cameras = state.scene->whole->cameras;
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        const std::string label = fmt::format("{} {}##camera", i, cameras[i].name);
        if (ImGui::RadioButton(label.c_str(), camera.fileCamera == i)) {
            camera = ofFile(*state.scene->whole, i, glm::length(camera.target - camera.eye));
        }
    }
    if (!camera.verticalExtent) {
        auto fov = static_cast<float>(camera.verticalFov);
        if (ImGui::SliderFloat("field of view", &fov, 1.0f, 170.0f, "%.1f deg", kTypedWithin)) {
            camera.verticalFov = static_cast<double>(fov);
        }
    }
    ImGui::Checkbox("panorama", &camera.isPanorama);
    ImGui::SliderFloat("aperture", &camera.apertureRadius, 0.0f, 1.0f, "%.4f",
                       kTypedWithin | ImGuiSliderFlags_Logarithmic);
    if (camera.focusDistance) {
        line(fmt::format("in focus at {:.4g}", *camera.focusDistance));
    }
    if (ImGui::Button("frame all")) {
        state.actions.push_back(Action::frameAll);
    }
    ImGui::SameLine();
    if (ImGui::Button("print options")) {
        state.actions.push_back(Action::printCamera);
    }
}

void drawViewportStatistics(const ViewportStatistics& now, const Settings& settings) {
    if (!settings.view) {
        line(fmt::format("{:.1f} of {} samples a pixel", now.samples, settings.samples));
        line(fmt::format("{:.2f} Mrays/s, {:.2f} Msamples/s", now.raysPerSecond * 1e-6,
                         now.samplesPerSecond * 1e-6));
        line(fmt::format("{:.2f} steps and {:.2f} tests a ray", now.stepsPerRay, now.testsPerRay));
    } else if (now.seconds > 0.0) {
        line(fmt::format("{:.2f} ms for the picture", now.seconds * 1e3));
    }
}

void drawStatistics(const ViewerState& state) {
    const Statistics& now = state.statistics;
    const LoadedScene& scene = *state.scene;
    line(now.device);
    line(fmt::format("{:.1f} frames/s, {} x {}", now.framesPerSecond, state.size.x, state.size.y));
    if (now.filmSize != state.size && now.filmSize.x > 0) {
        line(fmt::format("the picture has {} x {} pixels, all that fit into memory", now.filmSize.x,
                         now.filmSize.y));
    }
    const std::vector<std::string> traversals = state.traversals();
    for (std::size_t i = 0; i < traversals.size(); ++i) {
        if (state.hasSplit()) {
            ImGui::TextDisabled("%s: %s", i == 0 ? "left" : "right", traversals[i].c_str());
        }
        drawViewportStatistics(now.viewports[i], state.settings);
    }
    line(fmt::format("{} triangles, {} on the device", scene.shown.scene->triangles.size(),
                     vulkan::byteText(now.deviceBytes)));
    line(fmt::format("read in {:.2f} s, tree {:.2f} s, table {:.2f} s", scene.importSeconds,
                     scene.shown.structure->treeSeconds, scene.shown.structure->tableSeconds));
}

void drawKept(ViewerState& state) {
    for (const Shown slot : {Shown::present, Shown::a, Shown::b}) {
        ImGui::BeginDisabled(!state.kept.has(slot));
        if (ImGui::RadioButton(nameOf(slot), state.kept.shown() == slot)) {
            state.toShow = slot;
        }
        ImGui::EndDisabled();
        if (slot != Shown::present) {
            ImGui::SameLine();
            if (ImGui::Button(fmt::format("keep the view as {}", nameOf(slot)).c_str())) {
                state.actions.push_back(slot == Shown::a ? Action::keepA : Action::keepB);
            }
        }
    }
}

void drawMeshes(ViewerState& state) {
    const Scene& whole = *state.scene->whole;
    std::set<std::uint32_t>& hidden = state.settings.hiddenMeshes;
    for (std::uint32_t i = 0; i < whole.meshes.size(); ++i) {
        bool isShown = !hidden.contains(i);
        const std::string label = fmt::format(
            "{}##mesh{}", whole.meshes[i].name.empty() ? fmt::format("mesh {}", i) : whole.meshes[i].name, i);
        const bool isPicked = state.selected && state.selected->mesh == i;
        if (isPicked) {
            ImGui::PushStyleColor(ImGuiCol_Text, {1.0f, 0.82f, 0.24f, 1.0f});
        }
        if (ImGui::Checkbox(label.c_str(), &isShown)) {
            isShown ? static_cast<void>(hidden.erase(i)) : static_cast<void>(hidden.insert(i));
        }
        if (isPicked) {
            ImGui::PopStyleColor();
        }
    }
}

void drawAnimation(ViewerState& state) {
    const Scene& whole = *state.scene->whole;
    ImportOptions& import = state.settings.import;
    Playback& playback = state.playback;
    if (whole.animations.size() > 1) {
        const std::string all = "all at once";
        std::vector<std::string> names = {all};
        for (std::size_t i = 0; i < whole.animations.size(); ++i) {
            const std::string& name = whole.animations[i].name;
            names.push_back(name.empty() ? fmt::to_string(i) : name);
        }
        const std::string chosen =
            chooseName("animation", import.animation.empty() ? all : import.animation, names, kItself);
        import.animation = chosen == all ? "" : chosen;
    } else if (!whole.animations.front().name.empty()) {
        line(whole.animations.front().name);
    }
    bool isPosed = import.time.has_value();
    if (ImGui::Checkbox("pose", &isPosed)) {
        import.time = isPosed ? std::optional(0.0) : std::nullopt;
    }
    auto time = static_cast<float>(import.time.value_or(0.0));
    if (ImGui::SliderFloat("time", &time, 0.0f, static_cast<float>(whole.animationSeconds()), "%.2f s",
                           kTypedWithin)) {
        import.time = static_cast<double>(time);
    }
    if (ImGui::Button(playback.isPlaying ? "pause" : "play")) {
        state.actions.push_back(Action::togglePlay);
    }
    ImGui::SameLine();
    ImGui::Checkbox("loop", &playback.isLooped);
    ImGui::SliderFloat("speed", &playback.speed, 0.1f, 10.0f, "%.1f x",
                       kTypedWithin | ImGuiSliderFlags_Logarithmic);
}

void drawScene(ViewerState& state) {
    const Scene& whole = *state.scene->whole;
    ImportOptions& import = state.settings.import;
    line(state.file.filename().string());
    if (!whole.variants.empty()) {
        const std::string own = "the file's own";
        std::vector<std::string> names = {own};
        names.insert(names.end(), whole.variants.begin(), whole.variants.end());
        const std::string chosen =
            chooseName("variant", import.variant.empty() ? own : import.variant, names, kItself);
        import.variant = chosen == own ? "" : chosen;
    }
    if (whole.scenes.size() > 1) {
        const std::string own = "the file's own";
        std::vector<std::string> names = {own};
        names.insert(names.end(), whole.scenes.begin(), whole.scenes.end());
        const std::string chosen =
            chooseName("scene", import.scene.empty() ? own : import.scene, names, kItself);
        import.scene = chosen == own ? "" : chosen;
    }
    if (whole.animationSeconds() > 0.0) {
        drawAnimation(state);
    }
    drawMeshes(state);
}

void drawMaterial(const Material& material) {
    const auto color = [](const char* const label, const glm::vec3& value) {
        ImGui::ColorButton(label, {value.x, value.y, value.z, 1.0f}, ImGuiColorEditFlags_NoTooltip);
        ImGui::SameLine();
        line(fmt::format("{} {:.3f} {:.3f} {:.3f}", label, value.x, value.y, value.z));
    };
    line(material.name.empty() ? "material without a name" : material.name);
    color("base colour", glm::vec3(material.baseColorFactor));
    line(fmt::format("metallic {:.2f}, roughness {:.2f}, ior {:.2f}", material.metallicFactor,
                     material.roughnessFactor, material.ior));
    if (material.emissiveFactor != glm::vec3(0.0f)) {
        color("emission", material.emissiveFactor * material.emissiveStrength);
    }
    const std::pair<const char*, float> parts[] = {
        {"transmission", material.transmissionFactor}, {"thickness", material.thicknessFactor},
        {"clearcoat", material.clearcoatFactor},       {"anisotropy", material.anisotropyStrength},
        {"iridescence", material.iridescenceFactor},   {"dispersion", material.dispersion}};
    for (const auto& [name, value] : parts) {
        if (value != 0.0f) {
            line(fmt::format("{} {:.3f}", name, value));
        }
    }
    constexpr const char* kAlpha[] = {"opaque", "mask", "blend"};
    line(fmt::format("alpha: {}{}", kAlpha[static_cast<int>(material.alphaMode)],
                     material.doubleSided ? ", double sided" : ""));
    Material copy = material;
    const auto count = std::ranges::count_if(
        texturesOf(copy), [](const TextureRef* use) { return use->texture != kNoTexture; });
    line(fmt::format("{} textures", count));
}

void drawPicked(const ViewerState& state) {
    const Pick& picked = *state.selected;
    const Scene& whole = *state.scene->whole;
    line(fmt::format("triangle {} of {}", picked.triangleId, whole.meshes[picked.mesh].name));
    line(fmt::format("at {:.4g} {:.4g} {:.4g}, {:.4g} away", picked.position.x, picked.position.y,
                     picked.position.z, picked.distance));
    if (picked.material != kNoMaterial) {
        drawMaterial(whole.materials[picked.material]);
    }
}

void drawMarchLog(ViewerState& state) {
    const MarchLog& log = state.march->log;
    if (state.settings.traversal != "meta_table") {
        line(fmt::format("of meta_table; {} draws the picture", state.settings.traversal));
    }
    const auto count = static_cast<int>(log.steps.size());
    line(fmt::format(
        "{} look-ups, {} triangle tests, {}", log.result.steps, log.result.tests,
        log.result.hit.triangleId == kNoTriangle
            ? "nothing hit"
            : fmt::format("triangle {} at {:.4g}", log.result.hit.triangleId, log.steps.back().best.t)));
    ImGui::SliderInt("step", &state.marchStep, 0, count, state.marchStep == 0 ? "all" : "%d", kTypedWithin);
    if (state.marchStep > 0 && state.marchStep <= count) {
        const MarchStep& step = log.steps[static_cast<std::size_t>(state.marchStep) - 1];
        line(fmt::format("t {:.5g} to {:.5g}{}", step.tNear, step.tFar, step.isFinal ? ", the last" : ""));
    }
    for (int i = 0; i < kMarchParts; ++i) {
        const auto part = static_cast<MarchPart>(i);
        ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(marchColor(part)), "%s", nameOf(part));
    }
    if (ImGui::Button(state.isMarchPlaying ? "pause##march" : "play##march")) {
        state.actions.push_back(Action::togglePlay);
    }
    ImGui::SameLine();
    if (ImGui::Button("save the steps")) {
        state.actions.push_back(Action::saveMarch);
    }
    ImGui::SameLine();
    if (ImGui::Button("remove")) {
        state.march.reset();
    }
}

void drawHelp() {
    if (ImGui::BeginTable("keys", 2)) {
        for (const KeyHelp& help : keyHelp()) {
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(help.keys.data());
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(help.what.data());
        }
        ImGui::EndTable();
    }
}

void drawHelpWindow(ViewerState& state) {
    const glm::vec2 middle = 0.5f * glm::vec2(state.size);
    ImGui::SetNextWindowPos({middle.x, middle.y}, ImGuiCond_Appearing, {0.5f, 0.5f});
    ImGui::Begin("Keys", &state.settings.hasHelp, ImGuiWindowFlags_AlwaysAutoResize);
    drawHelp();
    ImGui::End();
}

void listMessages(const ViewerState& state) {
    for (const Message& message : state.messages) {
        ImGui::TextWrapped("%s", message.text.c_str());
    }
}

// What a window without a scene shows.
void drawInvitation(ViewerState& state) {
    const glm::vec2 middle = 0.5f * glm::vec2(state.size);
    ImGui::SetNextWindowPos({middle.x, middle.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::Begin("Empty", nullptr,
                 ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove);
    ImGui::TextUnformatted("drop a scene or an HDR here");
    for (std::size_t i = 0; i < state.recent.size(); ++i) {
        const std::filesystem::path& file = state.recent[i];
        if (ImGui::Selectable(fmt::format("{}##recent{}", file.filename().string(), i).c_str())) {
            state.opened.push_back(file);
        }
        if (ImGui::IsItemHovered()) {
            ImGui::SetTooltip("%s", file.string().c_str());
        }
    }
    ImGui::End();
}

bool header(const char* const name, const bool isOpen) {
    return ImGui::CollapsingHeader(name, isOpen ? ImGuiTreeNodeFlags_DefaultOpen : 0);
}

void drawShaderError(const ViewerState& state) {
    const glm::vec2 size(state.size);
    ImGui::SetNextWindowPos({size.x * 0.3f, size.y * 0.1f}, ImGuiCond_Appearing);
    ImGui::SetNextWindowSize({size.x * 0.65f, 0.0f}, ImGuiCond_Appearing);
    ImGui::Begin("Shader error: the old shader goes on");
    ImGui::PushStyleColor(ImGuiCol_Text, {1.0f, 0.45f, 0.4f, 1.0f});
    ImGui::TextWrapped("%s", state.shaderError.c_str());
    ImGui::PopStyleColor();
    ImGui::End();
}

} // namespace

void drawPanels(ViewerState& state) {
    if (!state.shaderError.empty()) {
        drawShaderError(state);
    }
    if (state.settings.hasHelp) {
        drawHelpWindow(state);
    }
    if (state.file.empty()) {
        drawInvitation(state);
    }
    state.coveredLeft = 0.0f;
    if (!state.settings.hasPanels) {
        return;
    }
    const float text = ImGui::GetFontSize();
    const float width = 27.0f * text;
    const glm::vec2 size(state.size);
    ImGui::SetNextWindowPos({0.6f * text, 0.6f * text}, ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowCollapsed(width > 0.5f * size.x, ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowSizeConstraints({width, 0.0f}, {width, size.y - 1.2f * text});
    const bool isUsed = ImGui::Begin("metamarch", nullptr, ImGuiWindowFlags_AlwaysAutoResize);
    const float left = ImGui::GetWindowPos().x;
    const bool isAtTheLeft = left < 0.25f * size.x && !ImGui::IsWindowCollapsed();
    state.coveredLeft = isAtTheLeft ? std::min(left + width, 0.5f * size.x) : 0.0f;
    if (!isUsed) { // folded, or not measured yet
        ImGui::End();
        return;
    }
    ImGui::PushItemWidth(15.0f * text);
    if (header("Renderer", true)) {
        drawRenderer(state);
    }
    if (state.scene) {
        if (header("Statistics", true)) {
            drawStatistics(state);
        }
        if (header("Camera", false)) {
            drawCamera(state);
        }
        if (header("Scene", false)) {
            drawScene(state);
        }
        if (header("A and B", false)) {
            drawKept(state);
        }
        if (state.selected && header("Picked triangle", true)) {
            drawPicked(state);
        }
        if (state.march && header("March of a ray", true)) {
            drawMarchLog(state);
        }
    }
    if (ImGui::Button("keys (F1)")) {
        state.actions.push_back(Action::toggleHelp);
    }
    if (!state.messages.empty() && header("Messages", true)) {
        listMessages(state);
    }
    ImGui::PopItemWidth();
    ImGui::End();
}

} // namespace metamarch::viewer

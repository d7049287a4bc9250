// SPDX-License-Identifier: MIT
#include "metamarch/viewer/panels.h"

#include "metamarch/viewer/controls.h"
#include "metamarch/viewer/overlay.h"
#include "metamarch/viewer/panel_controls.h"
#include "metamarch/viewer/renderer_panel.h"
#include "metamarch/viewer/scene_panel.h"
#include "metamarch/vulkan/byte_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <imgui.h>
#include <string>

namespace metamarch::viewer {
namespace {

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
    // The numbers are of the present picture, also while a kept one is shown.
    const auto& [left, right] = now.viewports;
    if (right.traversal.empty()) {
        drawViewportStatistics(left, state.settings);
    } else {
        ImGui::TextDisabled("left: %s", left.traversal.c_str());
        drawViewportStatistics(left, state.settings);
        ImGui::TextDisabled("right: %s", right.traversal.c_str());
        drawViewportStatistics(right, state.settings);
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
    // Tab shows and hides the panel. It must not put the keyboard into a field, which would take all keys.
    ImGui::PushAllowKeyboardFocus(false);
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
    ImGui::PopAllowKeyboardFocus();
    ImGui::PopItemWidth();
    ImGui::End();
}

} // namespace metamarch::viewer

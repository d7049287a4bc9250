// SPDX-License-Identifier: MIT
#include "metamarch/viewer/scene_panel.h"

#include "metamarch/viewer/panel_controls.h"

#include <fmt/format.h>

#include <cstdint>
#include <imgui.h>
#include <set>
#include <string>
#include <vector>

namespace metamarch::viewer {
namespace {

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
            chooseName("animation", import.animation.empty() ? all : import.animation, names);
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

} // namespace

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

void drawScene(ViewerState& state) {
    const Scene& whole = *state.scene->whole;
    ImportOptions& import = state.settings.import;
    line(state.file.filename().string());
    if (!whole.variants.empty()) {
        const std::string own = "the file's own";
        std::vector<std::string> names = {own};
        names.insert(names.end(), whole.variants.begin(), whole.variants.end());
        const std::string chosen =
            chooseName("variant", import.variant.empty() ? own : import.variant, names);
        import.variant = chosen == own ? "" : chosen;
    }
    if (whole.scenes.size() > 1) {
        const std::string own = "the file's own";
        std::vector<std::string> names = {own};
        names.insert(names.end(), whole.scenes.begin(), whole.scenes.end());
        const std::string chosen = chooseName("scene", import.scene.empty() ? own : import.scene, names);
        import.scene = chosen == own ? "" : chosen;
    }
    if (whole.animationSeconds() > 0.0) {
        drawAnimation(state);
    }
    drawMeshes(state);
}

} // namespace metamarch::viewer

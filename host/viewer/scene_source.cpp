// SPDX-License-Identifier: MIT
#include "metamarch/viewer/scene_source.h"

#include "metamarch/file/input_file.h"

#include <fmt/format.h>

#include <utility>

namespace metamarch::viewer {
namespace {

bool isMap(const std::filesystem::path& file) {
    const std::string ending = lowerCaseEnding(file);
    return ending == ".hdr" || ending == ".exr";
}

std::string busyText(const ViewerState& state) {
    const bool isBuilt = *state.loadStage == LoadStage::building;
    return fmt::format("{} {}{} ...", nameOf(*state.loadStage), isBuilt ? "the tree and the table of " : "",
                       state.file.filename().string());
}

} // namespace

SceneSource::SceneSource(const SceneRequest& first, const Settings& settings) : first_(first) {
    first_.import = settings.import;
    first_.light = settings.light;
    first_.path = settings.path;
}

void SceneSource::ask(ViewerState& state) {
    if (state.file.empty()) {
        return;
    }
    SceneRequest request = first_;
    request.file = state.file;
    request.import = state.settings.import;
    request.light = state.settings.light;
    request.path = state.settings.path;
    request.hiddenMeshes = state.settings.hiddenMeshes;
    request.reading = reading_;
    watch(state.file);
    loader_.ask(std::move(request));
    state.loadStage = LoadStage::reading;
    state.busy = busyText(state);
}

void SceneSource::followLoading(ViewerState& state) const {
    if (!loader_.isBusy()) {
        state.loadStage.reset();
    } else {
        state.loadStage = loader_.stage();
        state.busy = busyText(state);
    }
}

std::optional<SceneLoader::Answer> SceneSource::take(const ViewerState& state) {
    const bool isSaid = state.loadStage == LoadStage::uploading || state.playback.isPlaying;
    return isSaid || loader_.hasRefused() ? loader_.take() : std::nullopt;
}

void SceneSource::readAgain(ViewerState& state) {
    reading_ = ++newestReading_;
    ask(state);
}

void SceneSource::takeDropped(const std::vector<std::filesystem::path>& files, ViewerState& state) {
    for (const std::filesystem::path& file : files) {
        if (isMap(file)) {
            state.settings.light.kind = LightChoice::Kind::map;
            state.settings.light.map = file;
            if (state.file.empty()) {
                state.say(file.string() + " lights the next scene");
            }
        } else {
            state.settings.hiddenMeshes.clear();
            if (!state.file.empty()) {
                // Another file has other scenes, variants and animations.
                const ImportOptions& before = state.settings.import;
                state.settings.import = {.scale = before.scale,
                                         .allowMissingTextures = before.allowMissingTextures};
            }
            state.file = file;
        }
        ask(state);
    }
}

void SceneSource::goBack(const std::string& refusal, ViewerState& state) {
    state.say(refusal);
    const SceneRequest& shown = state.scene ? state.scene->request : first_;
    state.file = shown.file;
    state.settings.import = shown.import;
    state.settings.light = shown.light;
    state.settings.hiddenMeshes = shown.hiddenMeshes;
    state.settings.path.integrator = shown.path.integrator;
    state.settings.path.brdf = shown.path.brdf;
    reading_ = shown.reading;
    watch(state.file);
}

// Called before the file is read, so that a change during the reading counts.
void SceneSource::watch(const std::filesystem::path& file) {
    if (watchedFile_ != file) {
        watchedFile_ = file;
        fileWatch_.watch(file.empty() ? std::vector<std::filesystem::path>() : std::vector{file});
    }
}

} // namespace metamarch::viewer

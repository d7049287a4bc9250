// SPDX-License-Identifier: MIT
// Where the window's scenes come from: asks for them, watches their files, and goes back where one is
// refused.
#pragma once
#include "metamarch/viewer/file_watch.h"
#include "metamarch/viewer/scene_loader.h"
#include "metamarch/viewer/viewer_state.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace metamarch::viewer {

class SceneSource {
  public:
    // `first` is the scene of the command line; its file may be empty. Later ones have its structure.
    SceneSource(const SceneRequest& first, const Settings& settings);

    // Asks for the scene that the state's file and settings describe.
    void ask(ViewerState& state);
    // The same, and reads the files even if nothing else has changed.
    void readAgain(ViewerState& state);
    // Asks for each of the files: a scene, or a map that lights the present one or the next one.
    void takeDropped(const std::vector<std::filesystem::path>& files, ViewerState& state);

    bool isBusy() const { return loader_.isBusy(); }
    // Says in the state what is done with the scene that the window waits for. Call it before each frame.
    void followLoading(ViewerState& state) const;
    bool hasFileChanged() { return fileWatch_.hasChanged(); } // see FileWatch
    bool isFileGone() const { return fileWatch_.areGone(); }
    // Returns each answer once. A scene is given only after a frame has said that it is uploaded, for which
    // the window stands still. While an animation plays, no frame says so.
    std::optional<SceneLoader::Answer> take(const ViewerState& state);

    // Shows the refusal, and resets file and settings to those of the scene that is shown, or of the command
    // line if there is none.
    void goBack(const std::string& refusal, ViewerState& state);

  private:
    void watch(const std::filesystem::path& file);

    SceneRequest first_;
    SceneLoader loader_;
    FileWatch fileWatch_;
    std::filesystem::path watchedFile_;
    std::uint32_t reading_ = 0; // SceneRequest::reading
    std::uint32_t newestReading_ = 0;
};

} // namespace metamarch::viewer

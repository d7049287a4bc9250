// SPDX-License-Identifier: MIT
// Reads scenes and builds their structures in a thread, so that the window stays responsive.
#pragma once
#include "metamarch/error/error.h"
#include "metamarch/render/prepared_scene.h"
#include "metamarch/scene/import.h"

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace metamarch::viewer {

struct SceneRequest {
    std::filesystem::path file;
    ImportOptions import;
    AccelerationOptions structure;
    LightChoice light;
    PathChoice path;
    std::set<std::uint32_t> hiddenMeshes; // of Scene::meshes
    std::uint32_t reading = 0;            // a new number makes the loader read the files again
};

struct LoadedScene {
    SceneRequest request;
    std::shared_ptr<const Scene> whole;
    render::PreparedScene shown; // without the triangles of hidden meshes
    Bounds bounds;               // of `whole`
    bool hasLight = false;       // hasLight(*whole)
    std::vector<std::string> warnings{};
    double importSeconds = 0.0; // duration of the last reading of the file
};

// What is done with a request, in this order. A stage whose result is there already takes no time. The last
// one is for who takes the scene.
enum class LoadStage { reading, building, lighting, uploading };
inline constexpr int kLoadStages = 4;
constexpr const char* nameOf(const LoadStage stage) {
    return stage == LoadStage::reading    ? "reading"
           : stage == LoadStage::building ? "building"
           : stage == LoadStage::lighting ? "lighting"
                                          : "uploading";
}

class SceneLoader {
  public:
    SceneLoader();
    ~SceneLoader(); // waits for the work under way
    SceneLoader(const SceneLoader&) = delete;
    SceneLoader& operator=(const SceneLoader&) = delete;

    // Requests a scene. If there are several requests, only the last one is answered. The loader reuses what
    // has not changed since the last scene: a change of light reads no scene file and builds no tree.
    void ask(SceneRequest request);
    bool isBusy() const;
    LoadStage stage() const; // of the last request, while it is busy
    // Returns true if take() has a reason why there is no scene.
    bool hasRefused() const;

    // The answer to a request: a scene, or the reason why there is none. take() returns each answer once.
    struct Answer {
        std::shared_ptr<const LoadedScene> scene;
        std::optional<Error> refusal;
    };
    std::optional<Answer> take();

  private:
    void run(const std::stop_token& stop);
    Answer answer(const SceneRequest& request);

    std::atomic<LoadStage> stage_{LoadStage::reading};
    mutable std::mutex mutex;
    std::condition_variable_any wake;
    std::optional<SceneRequest> waiting;
    std::optional<Answer> ready;
    bool isWorking = false;
    std::shared_ptr<const LoadedScene> last; // used by the thread only
    std::jthread thread;                     // the last member, because it uses the others
};

} // namespace metamarch::viewer

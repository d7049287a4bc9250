// SPDX-License-Identifier: MIT
// Scenes read and built by a thread of their own, so that the window goes on meanwhile.
#pragma once
#include "metamarch/error/error.h"
#include "metamarch/render/prepared_scene.h"
#include "metamarch/scene/import.h"

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
    std::uint32_t reading = 0;            // another number reads files anew
};

struct LoadedScene {
    SceneRequest request;
    std::shared_ptr<const Scene> whole;
    render::PreparedScene shown; // without the triangles of hidden meshes
    Bounds bounds;               // of `whole`
    bool hasLight = false;       // hasLight(*whole)
    std::vector<std::string> warnings{};
    double importSeconds = 0.0; // when the file was last read
};

class SceneLoader {
  public:
    SceneLoader();
    ~SceneLoader(); // waits for the work under way
    SceneLoader(const SceneLoader&) = delete;
    SceneLoader& operator=(const SceneLoader&) = delete;

    // Of several requests only the last is answered. What it shares with the scene that was loaded last is
    // kept: a change of light reads no file and builds no tree.
    void ask(SceneRequest request);
    bool isBusy() const;

    // The answer, once: a scene, or the line that says why there is none.
    struct Answer {
        std::shared_ptr<const LoadedScene> scene;
        std::optional<Error> refusal;
    };
    std::optional<Answer> take();

  private:
    void run(const std::stop_token& stop);
    Answer answer(const SceneRequest& request);

    mutable std::mutex mutex;
    std::condition_variable_any wake;
    std::optional<SceneRequest> waiting;
    std::optional<Answer> ready;
    bool isWorking = false;
    std::shared_ptr<const LoadedScene> last; // the thread's own
    std::jthread thread;                     // last: it uses the others
};

} // namespace metamarch::viewer

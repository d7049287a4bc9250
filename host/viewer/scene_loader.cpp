// SPDX-License-Identifier: MIT
#include "metamarch/viewer/scene_loader.h"

#include "metamarch/error/error.h"
#include "metamarch/render/stopwatch.h"
#include "metamarch/shading/surroundings.h"

#include <new>
#include <utility>

namespace metamarch::viewer {
namespace {

std::shared_ptr<const Scene> withoutMeshes(const std::shared_ptr<const Scene>& whole,
                                           const std::set<std::uint32_t>& hidden) {
    if (hidden.empty()) {
        return whole;
    }
    auto shown = std::make_shared<Scene>(*whole);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < whole->triangles.size(); ++i) {
        if (!hidden.contains(whole->triangleMesh[i])) {
            shown->triangles[kept] = whole->triangles[i];
            shown->triangleMesh[kept] = whole->triangleMesh[i];
            shown->triangleMaterial[kept] = whole->triangleMaterial[i];
            ++kept;
        }
    }
    shown->triangles.resize(kept);
    shown->triangleMesh.resize(kept);
    shown->triangleMaterial.resize(kept);
    return shown;
}

bool sameFile(const SceneRequest& a, const SceneRequest& b) {
    return a.file == b.file && a.import == b.import && a.reading == b.reading;
}

} // namespace

SceneLoader::SceneLoader() : thread([this](const std::stop_token& stop) { run(stop); }) {}

SceneLoader::~SceneLoader() = default;

void SceneLoader::ask(SceneRequest request) {
    {
        const std::lock_guard lock(mutex);
        waiting = std::move(request);
        ready.reset();
    }
    wake.notify_one();
}

bool SceneLoader::isBusy() const {
    const std::lock_guard lock(mutex);
    return waiting || isWorking || ready;
}

LoadStage SceneLoader::stage() const {
    const std::lock_guard lock(mutex);
    return waiting ? LoadStage::reading : stage_.load();
}

bool SceneLoader::hasRefused() const {
    const std::lock_guard lock(mutex);
    return ready && !ready->scene;
}

std::optional<SceneLoader::Answer> SceneLoader::take() {
    const std::lock_guard lock(mutex);
    return std::exchange(ready, std::nullopt);
}

void SceneLoader::run(const std::stop_token& stop) {
    std::unique_lock lock(mutex);
    while (wake.wait(lock, stop, [&] { return waiting.has_value(); }) && !stop.stop_requested()) {
        const SceneRequest request = std::move(*waiting);
        waiting.reset();
        isWorking = true;
        stage_ = LoadStage::reading;
        lock.unlock();
        Answer made = answer(request);
        lock.lock();
        isWorking = false;
        if (!waiting) {
            ready = std::move(made);
        }
    }
}

SceneLoader::Answer SceneLoader::answer(const SceneRequest& request) {
    try {
        const bool isRead = last && sameFile(last->request, request);
        const Stopwatch import;
        const std::shared_ptr<const Scene> whole =
            isRead ? last->whole : std::make_shared<const Scene>(loadScene(request.file, request.import));
        const double importSeconds = isRead ? last->importSeconds : import.seconds();
        const bool isBuilt = isRead && last->request.hiddenMeshes == request.hiddenMeshes;
        stage_ = LoadStage::building;
        auto loaded = std::make_shared<LoadedScene>(
            LoadedScene{.request = request,
                        .whole = whole,
                        .shown = isBuilt ? last->shown
                                         : render::PreparedScene(withoutMeshes(whole, request.hiddenMeshes),
                                                                 request.structure),
                        .bounds = isRead ? last->bounds : boundsOf(*whole),
                        .hasLight = isRead ? last->hasLight : hasLight(*whole),
                        .importSeconds = importSeconds});
        stage_ = LoadStage::lighting;
        loaded->shown.light(request.file.string(), request.path, request.light);
        for (const auto& warnings :
             {whole->warnings, render::warningsOf(*loaded->shown.structure), loaded->shown.lightWarnings}) {
            loaded->warnings.insert(loaded->warnings.end(), warnings.begin(), warnings.end());
        }
        last = loaded;
        stage_ = LoadStage::uploading;
        return {loaded, std::nullopt};
    } catch (const Error& error) {
        return {nullptr, error};
    } catch (const std::bad_alloc&) {
        return {nullptr, Error(ErrorKind::outOfMemory, request.file.string() + ": out of memory")};
    } catch (const std::exception& error) {
        return {nullptr, Error(ErrorKind::inputRefused, request.file.string() + ": " + error.what())};
    }
}

} // namespace metamarch::viewer

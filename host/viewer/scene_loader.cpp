#include "metamarch/viewer/scene_loader.h"

#include "metamarch/error/error.h"
#include "metamarch/render/stopwatch.h"

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
        auto loaded = std::make_shared<LoadedScene>();
        loaded->request = request;
        const bool isRead = last && sameFile(last->request, request);
        const Stopwatch import;
        loaded->whole =
            isRead ? last->whole : std::make_shared<const Scene>(loadScene(request.file, request.import));
        loaded->importSeconds = isRead ? last->importSeconds : import.seconds();
        loaded->bounds = isRead ? last->bounds : boundsOf(*loaded->whole);
        loaded->hasLight = isRead ? last->hasLight : hasLight(*loaded->whole);
        loaded->warnings = loaded->whole->warnings;

        const bool isBuilt = isRead && last->request.hiddenMeshes == request.hiddenMeshes;
        loaded->shown = isBuilt ? last->shown : withoutMeshes(loaded->whole, request.hiddenMeshes);
        loaded->structure = isBuilt ? last->structure
                                    : std::make_shared<const AccelerationStructure>(
                                          buildAccelerationStructure(*loaded->shown, request.structure));

        LitScene lit = lightScene(*loaded->shown, request.file.string(), request.path, request.light);
        loaded->shading = std::move(lit.shading);
        loaded->warnings.insert(loaded->warnings.end(), lit.warnings.begin(), lit.warnings.end());
        last = loaded;
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

// SPDX-License-Identifier: MIT
#include "metamarch/python/loaded_scene.h"

#include "metamarch/error/error.h"
#include "metamarch/scene/file_digest.h"
#include "metamarch/scene/import.h"
#include "metamarch/shading/shadow_catcher.h"

#include <fmt/format.h>

#include <utility>

namespace metamarch::python {
namespace {

ImportOptions importOptions(const Words& words) {
    Choice choice;
    choice.take(words);
    choice.check();
    return choice.options.import;
}

} // namespace

std::shared_ptr<SceneOnDevice> putOnDevice(const std::shared_ptr<OpenDevice>& device,
                                           const render::PreparedScene& scene) {
    return {new SceneOnDevice{device, {device->device, scene}}, DeleteUnlessForked()};
}

LoadedScene::LoadedScene(const std::string& path, Words words)
    : words_(std::move(words)), path_(path), name_(path) {
    beginWork();
    scene_ = std::make_shared<const Scene>(read(importOptions(words_)));
    sha1_ = sha1Of(path);
}

LoadedScene::LoadedScene(const std::string& name, std::vector<unsigned char> glb, Words words)
    : words_(std::move(words)), path_("-"), name_(name), glb_(std::move(glb)) {
    beginWork();
    scene_ = std::make_shared<const Scene>(read(importOptions(words_)));
}

Scene LoadedScene::read(const ImportOptions& import) const {
    if (glb_) {
        return loadGlb(name_, *glb_, import);
    }
    if (!sha1_.empty() && sha1Of(path_) != sha1_) {
        throw Error(ErrorKind::inputRefused,
                    fmt::format("{}: the file has changed since it was loaded", name_));
    }
    return loadScene(path_, import);
}

std::shared_ptr<const Scene> LoadedScene::at(const ImportOptions& import) {
    const std::scoped_lock lock(mutex_);
    if (!later_ || laterTime_ != import.time) {
        later_ = std::make_shared<const Scene>(read(import));
        laterTime_ = import.time;
    }
    return later_;
}

LoadedScene::Prepared& LoadedScene::preparedLocked() {
    if (!prepared_.scene) {
        Choice choice;
        choice.take(words_);
        prepared_.scene.emplace(scene_, choice.options.structure);
    }
    return prepared_;
}

LoadedScene::Prepared& LoadedScene::groundedLocked(const CatcherChoice& choice) {
    if (!grounded_.scene || !(groundChoice_ == choice)) {
        grounded_ = {};
        Choice structure;
        structure.take(words_);
        const auto scene = std::make_shared<Scene>(*scene_);
        ground_ = placeCatcher(*scene, choice);
        grounded_.scene.emplace(scene, structure.options.structure);
        groundChoice_ = choice;
    }
    return grounded_;
}

render::PreparedScene LoadedScene::prepared() {
    const std::scoped_lock lock(mutex_);
    return *preparedLocked().scene;
}

render::PreparedScene LoadedScene::lit(const cli::RenderOptions& options, PathChoice& path) {
    const std::scoped_lock lock(mutex_);
    const CatcherChoice& catcher = options.catcher;
    Prepared& kept = catcher.isPlane() ? groundedLocked(catcher) : preparedLocked();
    if (catcher.isOn()) {
        path.catcher = catcher.isPlane() ? ground_ : catcherMaterial(*scene_, catcher.material);
    }
    if (path.integrator == Integrator::primary) {
        return *kept.scene;
    }
    const Light light{path.shading(), path.isOcclusion(), options.light};
    if (kept.light != light) {
        render::PreparedScene scene = *kept.scene; // stays as it is if this throws
        scene.light(name_, path, options.light);
        kept.scene = std::move(scene);
        kept.light = light;
    }
    return *kept.scene;
}

std::shared_ptr<SceneOnDevice> LoadedScene::on(const std::shared_ptr<OpenDevice>& device,
                                               const render::PreparedScene& scene) {
    const std::scoped_lock lock(mutex_);
    const bool isThere =
        onDevice_ && onDevice_->owner == device && onDevice_->scene.scene().shading == scene.shading;
    if (!isThere) {
        onDevice_.reset(); // the device may have no memory for two
        onDevice_ = putOnDevice(device, scene);
    }
    return onDevice_;
}

} // namespace metamarch::python

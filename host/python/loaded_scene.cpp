// SPDX-License-Identifier: MIT
#include "metamarch/python/loaded_scene.h"

#include "metamarch/scene/file_digest.h"
#include "metamarch/scene/import.h"

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

LoadedScene::LoadedScene(const std::string& path, Words words)
    : words_(std::move(words)), path_(path), name_(path) {
    beginWork();
    scene_ = std::make_shared<const Scene>(loadScene(path, importOptions(words_)));
    sha1_ = sha1Of(path);
}

LoadedScene::LoadedScene(const std::string& name, std::vector<unsigned char> glb, Words words)
    : words_(std::move(words)), path_("-"), name_(name) {
    beginWork();
    scene_ = std::make_shared<const Scene>(loadGlb(name, std::move(glb), importOptions(words_)));
}

render::PreparedScene LoadedScene::preparedLocked() {
    if (!prepared_) {
        Choice choice;
        choice.take(words_);
        prepared_.emplace(scene_, choice.options.structure);
    }
    return *prepared_;
}

render::PreparedScene LoadedScene::prepared() {
    const std::scoped_lock lock(mutex_);
    return preparedLocked();
}

render::PreparedScene LoadedScene::lit(const cli::RenderOptions& options) {
    const std::scoped_lock lock(mutex_);
    render::PreparedScene scene = preparedLocked();
    if (options.path.integrator == Integrator::primary) {
        return scene;
    }
    const Light light{options.path.shading(), options.path.isOcclusion(), options.light};
    if (light_ != light) {
        scene.light(name_, options.path, options.light);
        prepared_ = scene;
        light_ = light;
    }
    return scene;
}

std::shared_ptr<SceneOnDevice> LoadedScene::on(const std::shared_ptr<OpenDevice>& device,
                                               const render::PreparedScene& scene) {
    const std::scoped_lock lock(mutex_);
    const bool isThere =
        onDevice_ && onDevice_->owner == device && onDevice_->scene.scene().shading == scene.shading;
    if (!isThere) {
        onDevice_.reset(); // the device may have no memory for two
        onDevice_.reset(new SceneOnDevice{device, {device->device, scene}});
    }
    return onDevice_;
}

} // namespace metamarch::python

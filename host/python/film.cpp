// SPDX-License-Identifier: MIT
#include "metamarch/python/film.h"

#include "metamarch/cli/next_frame.h"
#include "metamarch/cli/output_check.h"
#include "metamarch/cli/rendered_picture.h"
#include "metamarch/error/error.h"
#include "metamarch/image/image_file.h"
#include "metamarch/render/picture.h"
#include "metamarch/render/traversal_choice.h"

#include <exception>
#include <utility>

namespace metamarch::python {
namespace {

// Returns null for the cpu. Where nobody chooses, this chooses the cpu, also in `words`, unless there is a
// graphics processor: beside software drivers the kernels of the CPU draw the same picture, and Clang's are
// faster.
std::shared_ptr<OpenDevice> deviceFor(Choice& choice, Words& words) {
    const cli::RenderOptions& options = choice.options;
    if (options.backend == cli::Backend::cpu) {
        return nullptr;
    }
    const bool isChosen = choice.settings.at("backend").isGiven() || !options.device.empty() ||
                          !(options.traversal.empty() || render::isOnCpu(options.traversal));
    try {
        std::shared_ptr<OpenDevice> device = openDevice(options.device);
        if (isChosen || !device->device.report().keepsBits()) {
            return device;
        }
    } catch (const Error& error) {
        if (isChosen || error.kind != ErrorKind::noDevice) {
            throw;
        }
    }
    const Words cpu = {{"backend", "cpu"}};
    words.push_back(cpu.front());
    choice.take(cpu);
    return nullptr;
}

} // namespace

Film::Film(std::shared_ptr<LoadedScene> scene, Words words, const SceneCamera& camera,
           render::RenderResult result, const std::uint32_t samplesWanted, std::vector<std::string> warnings,
           std::unique_ptr<const Denoiser> denoiser)
    : scene_(std::move(scene)), words_(std::move(words)), camera_(camera), result_(std::move(result)),
      denoiser_(std::move(denoiser)), image_(render::imageOf(result_, denoiser_.get())),
      samplesWanted_(samplesWanted), warnings_(std::move(warnings)) {}

bool Film::isComplete() const {
    return !result_.isCancelled && result_.settings.samplesPerPixel == samplesWanted_;
}

void Film::beginPictureWork() const {
    if (denoiser_) {
        beginWork(); // its library works with threads
    }
    beginFileWork();
}

void Film::save(const std::string& path, const Words& words) const {
    beginPictureWork();
    Choice choice;
    choice.take(scene_->words());
    choice.take(words_);
    choice.take(words);
    choice.check();
    cli::RenderOptions& options = choice.options;
    options.scenePath = scene_->path();
    options.outputPath = path;
    chooseTone(choice.settings, options.path.integrator, options.tone);
    if (cli::isPart(options)) {
        throw Error(ErrorKind::invalidArgument,
                    path + ": a picture is written as .exr, .png, .jpg, .webp or .tif");
    }
    if (pictureFormatOf(path, options.storage) != PictureFormat::exr) {
        options.aovs.clear(); // a film with further channels may also be shown
    }
    cli::checkFormat(options);
    const cli::NamedFile output[] = {{"path", path}};
    cli::checkOutputsDiffer(output, cli::companionsOf(scene_->scene()));
    const cli::NamedFile inputs[] = {{"env", options.light.map}};
    cli::checkOutputsDiffer(output, inputs);
    cli::writeRenderedPicture(result_, options, choice.settings, camera_, scene_->sha1(), denoiser_.get());
}

std::vector<std::uint8_t> Film::rgba8(const Words& words) const {
    beginPictureWork();
    Choice choice;
    choice.take(words_);
    choice.take(words);
    chooseTone(choice.settings, choice.options.path.integrator, choice.options.tone);
    return rgba8Of(render::shownImageOf(result_, denoiser_.get()), choice.options.tone);
}

std::shared_ptr<Film> renderFilm(const std::shared_ptr<LoadedScene>& scene, Words words, const bool isOnePass,
                                 Film* const before, const std::atomic<bool>& isStopped) {
    beginWork();
    Choice choice;
    choice.take(scene->words());
    choice.take(words);
    choice.check();
    render::RenderSettings settings = cli::settingsOf(choice.options);
    // Before the long work: the library may not be installed.
    auto denoiser = choice.options.isDenoised ? std::make_unique<const Denoiser>() : nullptr;
    const std::shared_ptr<OpenDevice> device = deviceFor(choice, words);
    const cli::RenderOptions& options = choice.options;
    if (device) {
        render::requireTraversal(device->device.report(), settings.traversal);
    }
    const glm::vec2 size(options.size);
    const SceneCamera sceneCamera = chooseCamera(scene->scene(), options.view, size.x / size.y);
    const Camera camera = makeCamera(sceneCamera, options.size.x, options.size.y, options.view.lens);

    render::RenderControl control;
    control.onStep = [&](const render::RenderProgress& progress) {
        const bool isAtPass = isOnePass && progress.isPassEnd && progress.nextSample < progress.endSample;
        return isStopped || isAtPass ? render::RenderWish::stop : render::RenderWish::goOn;
    };
    control.timeLimit = options.timeLimit.value_or(control.timeLimit);
    if (before != nullptr) {
        control.start = before->takeSums();
    }

    if (cli::hasMotion(options)) {
        settings.next = cli::nextFrame(options, scene->scene(), sceneCamera,
                                       [&](const ImportOptions& later) { return scene->at(later); });
    }
    const render::PreparedScene lit = scene->lit(options, settings.path);
    render::RenderResult result;
    const auto whole = [](render::RenderResult drawn) {
        if (drawn.failure) {
            std::rethrow_exception(drawn.failure);
        }
        return drawn;
    };
    if (device) {
        result = useDevice(device, [&] {
            const std::shared_ptr<SceneOnDevice> onDevice = scene->on(device, lit);
            return whole(renderPicture(onDevice->scene, camera, settings, control));
        });
    } else {
        result = whole(renderPicture(lit, camera, settings, control));
    }
    std::vector<std::string> warnings = render::warningsOf(*lit.structure);
    for (const std::vector<std::string>* more : {&lit.lightWarnings, &std::as_const(result).warnings}) {
        warnings.insert(warnings.end(), more->begin(), more->end());
    }
    return std::make_shared<Film>(scene, std::move(words), sceneCamera, std::move(result),
                                  settings.samplesPerPixel, std::move(warnings), std::move(denoiser));
}

} // namespace metamarch::python

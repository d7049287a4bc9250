// SPDX-License-Identifier: MIT
#include "metamarch/viewer/viewer.h"

#include "metamarch/error/error.h"
#include "metamarch/reference/eye_media.h"
#include "metamarch/render/stopwatch.h"
#include "metamarch/render/view_names.h"
#include "metamarch/shaders/shader_library.h"
#include "metamarch/shared/screen.h"
#include "metamarch/viewer/actions.h"
#include "metamarch/viewer/backdrop.h"
#include "metamarch/viewer/controls.h"
#include "metamarch/viewer/heat_range.h"
#include "metamarch/viewer/kept_pictures.h"
#include "metamarch/viewer/magnifier.h"
#include "metamarch/viewer/overlay.h"
#include "metamarch/viewer/panels.h"
#include "metamarch/viewer/picture_saver.h"
#include "metamarch/viewer/pixel_readout.h"
#include "metamarch/viewer/player.h"
#include "metamarch/viewer/presenter.h"
#include "metamarch/viewer/recent_files.h"
#include "metamarch/viewer/scene_source.h"
#include "metamarch/viewer/shader_reload.h"
#include "metamarch/viewer/split_view.h"
#include "metamarch/viewer/tour.h"
#include "metamarch/vulkan/byte_text.h"
#include "metamarch/vulkan/context.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <limits>
#include <utility>

namespace metamarch::viewer {
namespace {

// While nothing happens, the window sleeps for kIdleSeconds at a time, and for kBusySeconds while a scene is
// being loaded. It first draws kFramesAfterEvent frames, because Dear ImGui needs some to react to an event.
constexpr double kIdleSeconds = 0.25;
constexpr double kBusySeconds = 0.05;
constexpr int kFramesAfterEvent = 3;

class Viewer {
  public:
    explicit Viewer(const ViewerOptions& usedOptions)
        : options(usedOptions), window(system, options.size, "metamarch"),
          context(system.instanceExtensions()),
          device(context, options.device,
                 [this](const VkPhysicalDevice candidate, const std::uint32_t queueFamily) {
                     return system.presents(*context.instance(), candidate, queueFamily);
                 }),
          presenter(context, device, window), shaders(options.shaderFolder), saver(options.software, device),
          scenes(options.scene, options.settings), keptPictures(device), magnifier(device), backdrop(device),
          splitView(device) {
        state.file = options.scene.file;
        state.settings = options.settings;
        state.shaderFolder = shaders.folder().string();
        state.statistics.device = fmt::format("{} ({})", device.name(), device.report().driverInfo);
        for (const std::string& traversal : state.traversals()) {
            render::requireTraversal(device.report(), traversal);
        }
        for (const std::string_view traversal : traversals()) {
            if (render::missingFor(device.report(), traversal).empty()) {
                state.runnable.emplace_back(traversal);
            }
        }
        state.recent = recentFiles.read();
        scenes.ask(state);
    }

    ~Viewer() {
        try {
            dropPictures();
        } catch (const std::exception&) {
            // The device is lost; the exception that reported it is already on its way.
        }
    }
    Viewer(const Viewer&) = delete;
    Viewer& operator=(const Viewer&) = delete;

    void run() {
        Stopwatch frame;
        while (!window.isClosing()) {
            const double nap = quietFrames < kFramesAfterEvent ? 0.0
                               : isExpecting()                 ? kBusySeconds
                                                               : kIdleSeconds;
            const Stopwatch asleep;
            const Input input = window.poll(nap);
            quietFrames = asleep.seconds() < nap ? 0 : quietFrames + 1;
            const double seconds = std::exchange(frame, Stopwatch()).seconds();
            takeScene();
            scenes.followLoading(state);
            scenes.takeDropped(input.dropped, state);
            reloadWhatChanged();
            if (!presenter.beginFrame()) {
                quietFrames = kFramesAfterEvent; // minimised
                continue;
            }
            state.size = presenter.size();
            followSize();
            const KeptView before{state.camera, state.settings};
            controls.apply(input, window, seconds, state);
            keepStep();
            if (!player.isSaving()) {
                drawPanels(state);
                drawTour(state);
                hasDrawnPanels = true;
            }
            scenes.takeDropped(std::exchange(state.opened, {}), state);
            act();
            // Behind a kept view the time of an animation stands still.
            player.playAnimations(isKeptShown() ? 0.0 : seconds, scenes.isBusy() || isKeptShown(), state);
            player.playMarch(seconds, state);
            fitHeat();
            followOrShow(before);
            followZoom();
            if (state.scene) {
                if (!isKeptShown()) {
                    state.history.follow(state.camera, seconds);
                }
                drawOverlay(state);
                drawZoom(state);
                readOut();
                drawReadOut(state);
            }
            const bool isAnnounced = announceKernel() || state.loadStage == LoadStage::uploading;
            drawBusy(state);
            if (!isWindowWanted) { // messages do not belong into the picture
                drawMessages(state);
            }
            if (isAnnounced || trace()) {
                quietFrames = 0;
            }
            state.filterRefusal = splitView.isEmpty() ? "" : splitView.progressive().filterRefusal();
            presenter.endFrame(
                [&](vulkan::Commands& commands, const Screen& screen) -> const vulkan::Buffer& {
                    splitView.paint(commands, screen, state.settings.splitAt);
                    keptPictures.paint(commands, screen, state.kept.shown());
                    return state.zoom.isOn() ? magnifier.record(commands, screen, state.zoom) : screen.pixels;
                });
            saveWindow();
            splitView.measure(state.statistics);
            window.setTitle(titleText());
        }
        if (scenes.isBusy()) {
            // Reading cannot be interrupted, and nobody waits for its result. Nothing else is lost: kernels
            // and recent files are on disk as soon as they are there.
            std::_Exit(EXIT_SUCCESS);
        }
    }

  private:
    // Returns true if something is on its way that comes without an event.
    bool isExpecting() const {
        return scenes.isBusy() || splitView.isDenoising() || state.playback.isPlaying ||
               state.isMarchPlaying || player.isSaving();
    }

    // --- scenes ---

    // The program has no window to show without the scene that the command line names.
    bool isFirstMissing() const { return !state.scene && !options.scene.file.empty(); }

    void takeScene() {
        if (!hasDrawnPanels) { // the scene is seen beside them
            return;
        }
        std::optional<SceneLoader::Answer> answer = scenes.take(state);
        if (!answer) {
            return;
        }
        state.busy.clear();
        showKept(Shown::present);
        if (!answer->scene) {
            if (isFirstMissing()) {
                throw *answer->refusal;
            }
            scenes.goBack(answer->refusal->what(), state);
            return;
        }
        try {
            showScene(std::move(answer->scene));
        } catch (const Error& error) {
            if (isFirstMissing() || isLost()) {
                throw;
            }
            scenes.goBack(error.what(), state);
        }
    }

    void showScene(std::shared_ptr<const LoadedScene> loaded) {
        const bool isFirst = !state.scene;
        const bool isOther = isFirst || state.scene->request.file != loaded->request.file;
        state.size = presenter.size();
        const ViewCamera camera = cameraFor(*loaded); // throws for a camera that the scene does not have
        auto next = std::make_unique<render::DeviceScene>(device, loaded->shown);
        dropPictures();
        deviceScene = std::move(next);
        if (device.memoryUse().spilled > 0) { // what the last scene and its pictures took is free now
            deviceScene.reset();
            deviceScene = std::make_unique<render::DeviceScene>(device, loaded->shown);
        }
        if (device.memoryUse().spilled > 0) {
            state.say(fmt::format("warning: {} of the scene lie in host memory, which {} reads more slowly",
                                  vulkan::byteText(device.memoryUse().spilled), device.name()));
        }
        if (isOther || state.scene->whole != loaded->whole) {
            for (const std::string& warning : loaded->warnings) {
                state.say("warning: " + warning);
            }
        }
        if (!state.scene || state.scene->shown.scene != loaded->shown.scene) {
            state.selected.reset();
            state.march.reset();
        }
        state.scene = std::move(loaded);
        state.shownBox = {};
        state.camera = camera;
        if (isOther) {
            recentFiles.add(state.file);
            state.history.start(camera);
            forgetKept();
            state.playback.isPlaying = false;
        }
        if (isFirst && options.hasTour) {
            showTourScreen(state, 0);
        }
        state.statistics.deviceBytes = deviceScene->bytes();
        isStale = true;
    }

    // Returns the camera of the command line for the first scene, firstCamera for another file, and the
    // window's camera for the same file.
    ViewCamera cameraFor(const LoadedScene& loaded) const {
        if (!state.scene) {
            return options.chooseCamera(*loaded.whole, [&](const double verticalFov) {
                return state.framed(loaded.bounds, verticalFov);
            });
        }
        if (state.scene->request.file == loaded.request.file) {
            return followed(state.camera, *state.scene->whole, *loaded.whole,
                            glm::length(state.camera.target - state.camera.eye));
        }
        return firstCamera(loaded, state);
    }

    void reloadWhatChanged() {
        if (scenes.hasFileChanged()) {
            scenes.readAgain(state);
        }
        if (std::exchange(isFileGone, scenes.isFileGone()) != scenes.isFileGone() && isFileGone) {
            state.say(state.file.string() + " is gone; the window shows what it has read");
        }
        if (deviceScene && shaders.hasChanged()) {
            compileShaders();
            if (state.shaderError.empty()) {
                dropPictures();
                isStale = true;
            }
        }
    }

    void compileShaders() {
        const std::string error = shaders.compile(state.traversals(), deviceScene->buffers().memoryKind());
        state.shaderError = error;
        state.say(error.empty() ? "shaders compiled anew"
                                : "shader error: " + error.substr(0, error.find('\n')));
    }

    // --- actions of keys and buttons ---

    void act() {
        for (const Action action : std::exchange(state.actions, {})) {
            if (action == Action::quit) {
                window.close();
            } else if ((state.scene || !needsScene(action)) && !perform(action, device.report(), state)) {
                act(action);
            }
        }
    }

    void act(const Action action) {
        if (action == Action::printCamera) {
            printCamera();
        } else if (action == Action::keepA || action == Action::keepB) {
            keep(action == Action::keepA ? Shown::a : Shown::b);
        } else if (action == Action::saveScreenshot) {
            save(".png");
        } else if (action == Action::saveWindow) {
            isWindowWanted = presenter.keepFrame();
            if (!isWindowWanted) {
                state.say("this screen gives no picture of the window");
            }
        } else if (action == Action::saveMarch) {
            player.saveMarch(state);
        } else if (action == Action::saveExr) {
            save(".exr");
        } else if (action == Action::reload) {
            scenes.readAgain(state);
        }
    }

    void printCamera() {
        const std::string text = optionsText(state.camera, *state.scene->whole);
        state.say(text);
        window.copy(text);
    }

    void save(const char* const ending) {
        if (isKeptShown()) {
            saveKept(ending);
            return;
        }
        if (splitView.isEmpty() || !state.busy.empty()) {
            state.say("the picture is on its way: save it when it is there");
            return;
        }
        try {
            state.say(saver.save(splitView.progressive(), splitView.shown(), splitView.leftTraversal(), state,
                                 ending, chosenDenoiser(), backdrop));
        } catch (const Error& error) {
            state.say(error.what());
        }
    }

    void saveKept(const std::string& ending) {
        if (ending != ".png") {
            state.say("of a kept view there is no film: go back with Esc, or save its picture");
            return;
        }
        if (!keptPictures.has(state.kept.shown())) {
            state.say("the picture is on its way: save it when it is there");
            return;
        }
        const KeptPictures::Picture picture = keptPictures.picture(state.kept.shown());
        try {
            state.say("saved " + saver.saveWindow(picture.pixels, picture.size, state.file.stem().string()));
        } catch (const Error& error) {
            state.say(error.what());
        }
    }

    // Saves the window's picture, if that is wanted and there.
    void saveWindow() {
        const std::optional<Presenter::Frame> frame = presenter.takeFrame();
        if (!frame) {
            return;
        }
        isWindowWanted = false;
        quietFrames = 0; // shows the message, or the next step
        const std::string scene = state.file.stem().string();
        try {
            if (player.isSaving()) {
                player.stepIsSaved(saver.saveWindow(frame->pixels, frame->size, scene + "_march"), state);
            } else {
                state.say(fmt::format("saved {}, all that the window shows",
                                      saver.saveWindow(frame->pixels, frame->size, scene)));
            }
        } catch (const Error& error) {
            player.stopSaving();
            state.say(error.what());
        }
    }

    // Chooses the range of a heat map once its picture is whole.
    void fitHeat() {
        const Settings& settings = state.settings;
        const bool isHeat = settings.view && isHeatMap(*settings.view) && settings.isHeatFitted;
        if (!isHeat || isHeatKnown || isStale || isKeptShown() || splitView.isEmpty() ||
            splitView.shown().view != settings.view || !splitView.progressive().isWhole()) {
            return;
        }
        isHeatKnown = true;
        state.settings.heatMax = fittingHeat(splitView.progressive().shownPixels(), settings.heatMax);
    }

    // Brings the lines about the pixel under the cursor up to date, with the film of its side.
    void readOut() {
        state.readOut.clear();
        const glm::vec2 size(state.size);
        const bool isInside = glm::all(glm::greaterThanEqual(state.cursor, glm::vec2(0.0f))) &&
                              glm::all(glm::lessThan(state.cursor, size));
        if (!state.settings.hasReadOut || !isInside) {
            return;
        }
        const glm::uvec2 pixel(state.zoom.toPicture(state.cursor));
        state.readOut = {fmt::format("pixel {}, {}", pixel.x, pixel.y)};
        if (!splitView.isEmpty() && !state.settings.view && !isKeptShown()) {
            const ProgressiveImage& film = splitView.under(pixel.x, state.settings.splitAt);
            const glm::uvec2 place(pixelUnder(pixel.x, film.size().x, state.size.x),
                                   pixelUnder(pixel.y, film.size().y, state.size.y));
            std::ranges::move(channelLines(film.filmPixel(place)), std::back_inserter(state.readOut));
        }
        std::ranges::move(hitLines(*state.scene, state.traced(), glm::vec2(pixel) + 0.5f),
                          std::back_inserter(state.readOut));
    }

    // --- A and B ---

    bool isKeptShown() const { return state.kept.shown() != Shown::present; }

    void keep(const Shown slot) {
        if (!isKeptShown() && !splitView.isShown()) {
            state.say("the picture is on its way: keep it when it is there");
            return;
        }
        try {
            if (state.kept.shown() != slot) {
                keptPictures.keep(slot, state.size);
                state.kept.keep(slot, {state.camera, state.settings});
            }
            state.say(fmt::format("kept as {}", nameOf(slot)));
        } catch (const Error& error) {
            state.say(error.what());
        }
    }

    // A picture that is still to be kept takes the window's size of now.
    void followSize() {
        try {
            keptPictures.follow(state.size);
        } catch (const Error& error) {
            presenter.wait();
            forgetKept();
            state.say(fmt::format("{}; A and B are forgotten", error.what()));
        }
    }

    void forgetKept() {
        showKept(Shown::present);
        state.kept.forget();
        keptPictures.forget();
    }

    void showKept(const Shown wanted) {
        if (wanted == state.kept.shown()) {
            return;
        }
        const KeptView next = state.kept.show(wanted, {state.camera, state.settings});
        state.camera = next.camera;
        state.settings = next.settings;
        state.say(nameOf(wanted));
    }

    // While a kept view is shown, the present picture goes on. The first change goes on from the kept view.
    void followOrShow(const KeptView& before) {
        if (!isKeptShown()) {
            follow(before.settings, before.camera);
        } else if (!state.kept.isOf({state.camera, state.settings})) {
            const KeptView present = state.kept.leave();
            state.history.keep(present.camera);
            follow(present.settings, present.camera);
        }
        if (const std::optional<Shown> wanted = std::exchange(state.toShow, std::nullopt)) {
            showKept(*wanted);
        }
    }

    // --- zoom into pixels ---

    void followZoom() {
        state.zoom.follow(state.size);
        if (!state.zoom.isOn() || magnifier.isReady(state.size)) {
            return;
        }
        try {
            presenter.wait();
            magnifier.make(state.size);
        } catch (const Error& error) {
            state.zoom.end();
            state.say(error.what());
        }
    }

    // --- the march ---

    // Asks for the picture of the step that is saved next, without panels.
    void keepStep() {
        if (!player.isSaving()) {
            return;
        }
        isWindowWanted = state.shownStep() && presenter.keepFrame();
        if (!isWindowWanted) { // the march is gone, or the screen gives no pictures
            player.stopSaving();
            state.say("the march is not saved");
        }
    }

    // --- pictures ---

    // Compares the settings with those before and restarts only what a change affects.
    void follow(const Settings& before, const ViewCamera& cameraBefore) {
        const Settings& now = state.settings;
        const bool isOtherScene = before.light != now.light || before.import != now.import ||
                                  before.hiddenMeshes != now.hiddenMeshes ||
                                  before.path.shading() != now.path.shading();
        if (isOtherScene) {
            scenes.ask(state);
        }
        const bool isOtherPicture = cameraBefore != state.camera || before.path != now.path ||
                                    before.view != now.view || before.heatMax != now.heatMax ||
                                    before.isHeatFitted != now.isHeatFitted ||
                                    before.samples != now.samples || before.traversal != now.traversal ||
                                    before.secondTraversal != now.secondTraversal;
        isStale = isStale || isOtherPicture;
        isHalted = isHalted && !isStale && haltedSize == state.size;
        if (!deviceScene || isHalted) {
            return;
        }
        const bool areOthers = !splitView.areOf(state.traversals(), state.size);
        attempt([&] {
            if (areOthers) {
                presenter.wait();
                if (shaders.lacks(state.traversals())) {
                    compileShaders();
                }
                splitView.make(*deviceScene, state.traversals(), state.size, shaders.overrides(), backdrop);
            }
            backdrop.follow(now.backdrop, state.scene->shown.shading, state.traced(), now.tone);
            splitView.setTone(now.tone);
            splitView.setDenoiser(chosenDenoiser());
            splitView.setFilter(now.hasFilter);
            splitView.setChannel(now.channel);
            if (std::exchange(isStale, false) || areOthers) {
                splitView.start(makeRenderRequest());
                isHeatKnown = false;
            }
        });
    }

    // Returns null if noise stays. Loads the library when it is first wanted, and says so if it is not there.
    const Denoiser* chosenDenoiser() {
        if (state.settings.isDenoised && !denoiser) {
            try {
                denoiser.emplace();
            } catch (const Error& error) {
                state.settings.isDenoised = false;
                state.say(error.what());
            }
        }
        return state.settings.isDenoised ? &*denoiser : nullptr;
    }

    // The frame before the one in which the window waits for the driver says so. Returns true for that frame.
    bool announceKernel() {
        const bool wasSaid = std::exchange(isKernelSaid, splitView.isBeforeKernel() && !scenes.isBusy());
        if (wasSaid != isKernelSaid && !scenes.isBusy()) {
            state.busy = isKernelSaid ? "preparing the path tracer; the driver may compile it now" : "";
        }
        return isKernelSaid && !wasSaid;
    }

    // Returns true if the device has worked.
    bool trace() {
        bool hasWorked = false;
        if (!splitView.isEmpty()) {
            attempt([&] {
                hasWorked = splitView.advance();
                splitView.update();
            });
        }
        return hasWorked;
    }

    // Shows the error if the device cannot do the work, and halts until something changes.
    void attempt(const std::function<void()>& work) {
        try {
            work();
        } catch (const Error& error) {
            if (isLost()) {
                throw;
            }
            state.say(error.what());
            dropPictures();
            isStale = false;
            isHalted = true;
            haltedSize = state.size;
        }
    }

    bool isLost() const { return !device.waitIdle(); }

    void dropPictures() {
        presenter.wait();
        splitView.clear();
    }

    RenderRequest makeRenderRequest() const {
        RenderRequest request;
        request.camera = sceneCameraOf(state.camera, *state.scene->whole);
        request.lens = lensOf(state.camera);
        request.lens.pixelFilter = state.settings.pixelFilter;
        request.settings = state.settings.path.applied(state.scene->shown.shading->settings);
        request.settings.eyeMedia =
            mediaAt(*state.scene->shown.structure, *state.scene->shown.shading, request.camera.eye);
        request.view = state.settings.view;
        request.endSample = state.settings.samples;
        request.hasPreview = state.settings.hasPreview;
        request.scaleMax = state.settings.heatMax;
        if (request.view && !isHeatMap(*request.view)) {
            const glm::vec2 depths = state.depthRange();
            request.scaleMin = depths[0];
            request.scaleMax = depths[1];
        }
        return request;
    }

    // What the window waits for, in a word.
    std::string waitingText() const {
        return state.playback.isPlaying ? ""
               : isKernelSaid           ? " - preparing"
               : state.loadStage        ? fmt::format(" - {}", nameOf(*state.loadStage))
                                        : "";
    }

    std::string titleText() const {
        if (state.file.empty()) {
            return "metamarch";
        }
        const Settings& settings = state.settings;
        const std::string seen =
            isKeptShown() ? fmt::format("{} as it was kept", nameOf(state.kept.shown()))
            : settings.view
                ? std::string(render::kViewNames[*settings.view].name)
                : fmt::format("{}, {} of {} samples",
                              settings.channel.empty() ? std::string(nameOf(settings.path.integrator))
                                                       : "channel " + settings.channel,
                              static_cast<std::uint32_t>(state.statistics.viewports[0].samples),
                              settings.samples);
        const std::string how =
            state.hasSplit() ? settings.traversal + " | " + settings.secondTraversal : settings.traversal;
        return fmt::format("{} - {} - {}{} - metamarch", state.file.filename().string(), seen, how,
                           waitingText());
    }

    const ViewerOptions& options;
    WindowSystem system;
    Window window;
    vulkan::Context context;
    vulkan::Device device;
    Presenter presenter;
    ShaderReload shaders;
    PictureSaver saver;
    SceneSource scenes;
    Controls controls;
    Player player;
    ViewerState state;

    std::optional<Denoiser> denoiser; // loaded on first use
    std::unique_ptr<render::DeviceScene> deviceScene;
    KeptPictures keptPictures;
    Magnifier magnifier;
    Backdrop backdrop;
    SplitView splitView; // uses the device scene, the denoiser and the backdrop
    RecentFiles recentFiles;
    bool hasDrawnPanels = false;
    bool isFileGone = false;
    bool isWindowWanted = false; // a picture of it
    bool isKernelSaid = false;   // state.busy says that a kernel is made
    bool isStale = false;        // the picture must begin anew
    bool isHeatKnown = false;    // the range of the heat map has been compared with the picture
    bool isHalted = false;       // there is no picture until a setting or the window's size changes
    glm::uvec2 haltedSize{0};
    int quietFrames = 0; // number of frames since something happened
};

} // namespace

void runViewer(const ViewerOptions& options) { Viewer(options).run(); }

} // namespace metamarch::viewer

// SPDX-License-Identifier: MIT
#include "metamarch/viewer/viewer.h"

#include "metamarch/error/error.h"
#include "metamarch/render/stopwatch.h"
#include "metamarch/shaders/shader_library.h"
#include "metamarch/viewer/actions.h"
#include "metamarch/viewer/controls.h"
#include "metamarch/viewer/kept_pictures.h"
#include "metamarch/viewer/magnifier.h"
#include "metamarch/viewer/overlay.h"
#include "metamarch/viewer/panels.h"
#include "metamarch/viewer/picture_saver.h"
#include "metamarch/viewer/pixel_readout.h"
#include "metamarch/viewer/player.h"
#include "metamarch/viewer/presenter.h"
#include "metamarch/viewer/recent_files.h"
#include "metamarch/viewer/renderer.h"
#include "metamarch/viewer/scene_source.h"
#include "metamarch/viewer/title.h"
#include "metamarch/viewer/tour.h"
#include "metamarch/vulkan/context.h"

#include <fmt/format.h>

#include <cstdlib>
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
          presenter(context, device, window), saver(options.software, device),
          scenes(options.scene, options.settings), keptPictures(device), magnifier(device),
          renderer(device, presenter, options.shaderFolder) {
        state.file = options.scene.file;
        state.settings = options.settings;
        state.shaderFolder = renderer.shaderFolder().string();
        state.statistics.device = fmt::format("{} ({})", device.name(), device.report().driverText());
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
            } else {
                state.coveredLeft = 0.0f;
            }
            scenes.takeDropped(std::exchange(state.opened, {}), state);
            act();
            // Behind a kept view the time of an animation stands still.
            player.playAnimations(isKeptShown() ? 0.0 : seconds, scenes.isBusy() || isKeptShown(), state);
            player.playMarch(seconds, state);
            if (!isKeptShown()) {
                renderer.fitHeat(state);
            }
            followOrShow(before);
            followZoom();
            if (state.scene) {
                if (!isKeptShown()) {
                    state.history.follow(state.camera, seconds);
                }
                drawOverlay(state);
                drawZoom(state);
                state.readOut = readOutLines(state, renderer.view());
                drawReadOut(state);
            }
            const bool isAnnounced =
                renderer.announceKernel(scenes.isBusy(), state) || state.loadStage == LoadStage::uploading;
            drawBusy(state);
            if (!isWindowWanted) { // messages do not belong into the picture
                drawMessages(state);
            }
            if (isAnnounced || renderer.trace(state)) {
                quietFrames = 0;
            }
            state.filterRefusal =
                renderer.view().isEmpty() ? "" : renderer.view().progressive().filterRefusal();
            presenter.endFrame(
                [&](vulkan::Commands& commands, const Screen& screen) -> const vulkan::Buffer& {
                    renderer.view().paint(commands, screen, state.settings.splitAt);
                    keptPictures.paint(commands, screen, state.kept.shown());
                    return state.zoom.isOn() ? magnifier.record(commands, screen, state.zoom) : screen.pixels;
                });
            saveWindow();
            renderer.view().measure(state.statistics);
            window.setTitle(titleText(state, renderer.isKernelSaid()));
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
        return scenes.isBusy() || renderer.view().isDenoising() || state.playback.isPlaying ||
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
        renderer.upload(loaded->shown, state);
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
        renderer.followShaders(state);
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
        if (renderer.view().isEmpty() || !state.busy.empty()) {
            state.say("the picture is on its way: save it when it is there");
            return;
        }
        try {
            state.say(saver.save(renderer.view().progressive(), renderer.view().shown(),
                                 renderer.view().leftTraversal(), state, ending,
                                 renderer.chosenDenoiser(state), renderer.backdrop()));
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

    // --- A and B ---

    bool isKeptShown() const { return state.kept.shown() != Shown::present; }

    void keep(const Shown slot) {
        if (!isKeptShown() && !renderer.view().isShown()) {
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

    void follow(const Settings& before, const ViewCamera& cameraBefore) {
        const Settings& now = state.settings;
        const bool isOtherScene = before.light != now.light || before.import != now.import ||
                                  before.hiddenMeshes != now.hiddenMeshes ||
                                  before.path.shading() != now.path.shading();
        if (isOtherScene) {
            scenes.ask(state);
        }
        renderer.follow(before, cameraBefore, state);
    }

    bool isLost() const { return !device.waitIdle(); }

    const ViewerOptions& options;
    WindowSystem system;
    Window window;
    vulkan::Context context;
    vulkan::Device device;
    Presenter presenter;
    PictureSaver saver;
    SceneSource scenes;
    Controls controls;
    Player player;
    ViewerState state;

    KeptPictures keptPictures;
    Magnifier magnifier;
    Renderer renderer; // waits at its end for the frame that uses the two above
    RecentFiles recentFiles;
    bool hasDrawnPanels = false;
    bool isFileGone = false;
    bool isWindowWanted = false; // a picture of it
    int quietFrames = 0;         // number of frames since something happened
};

} // namespace

void runViewer(const ViewerOptions& options) { Viewer(options).run(); }

} // namespace metamarch::viewer

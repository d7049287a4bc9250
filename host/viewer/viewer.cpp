#include "viewer/viewer.h"

#include "error.h"
#include "render/view_names.h"
#include "scene/scene_file.h"
#include "shader_library.h"
#include "viewer/canvas.h"
#include "viewer/controls.h"
#include "viewer/overlay.h"
#include "viewer/panels.h"
#include "viewer/picture_saver.h"
#include "viewer/presenter.h"
#include "viewer/shader_reload.h"
#include "viewer/stage.h"
#include "vulkan/context.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace metamarch::viewer {
namespace {

using Clock = std::chrono::steady_clock;

// A frame while something changes: a coarse picture and the panels fit into the 50 ms of 20 frames a second.
constexpr double kQuickSeconds = 0.025;
// A submission while nothing changes; the window waits for one at most.
constexpr double kCalmSeconds = 0.06;
// Submissions of a frame that brings the coarse picture up to date. Their first ones are small, as nobody
// knows yet how long they take.
constexpr int kMostQuickSubmissions = 8;
// While there is nothing to draw the window sleeps for so long at a time.
constexpr double kIdleSeconds = 0.05;
constexpr double kStatisticsSeconds = 0.5;

double secondsBetween(const Clock::time_point from, const Clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
}

bool isMap(const std::filesystem::path& file) {
    const std::string ending = lowerCaseEnding(file);
    return ending == ".hdr" || ending == ".exr";
}

class Viewer {
  public:
    explicit Viewer(const ViewerOptions& usedOptions)
        : options(usedOptions), window(system, options.size, "metamarch"),
          context(system.instanceExtensions()), device(context, options.device, vulkan::DeviceUse::window),
          presenter(context, device, window), shaders(options.shaderFolder), saver(options.software, device) {
        state.file = options.scene.file;
        state.settings = options.settings;
        state.shaderFolder = shaders.folder().string();
        state.statistics.device = fmt::format("{} ({})", device.name(), device.report().driverInfo);
        render::requireTraversal(device.report(), state.settings.traversal);
        askForScene();
    }

    ~Viewer() { dropCanvases(); }
    Viewer(const Viewer&) = delete;
    Viewer& operator=(const Viewer&) = delete;

    void run() {
        Clock::time_point last = Clock::now();
        while (!window.isClosing()) {
            const Input input = window.poll(isIdle ? kIdleSeconds : 0.0);
            const Clock::time_point now = Clock::now();
            const double seconds = secondsBetween(std::exchange(last, now), now);
            takeScene();
            takeDropped(input);
            reloadWhatChanged();
            if (!presenter.beginFrame()) {
                isIdle = true; // minimised
                continue;
            }
            state.size = presenter.size();
            const Settings settingsBefore = state.settings;
            const ViewCamera cameraBefore = state.camera;
            controls.apply(input, window, seconds, state);
            drawPanels(state);
            act();
            follow(settingsBefore, cameraBefore);
            if (state.scene) {
                drawOverlay(state);
            }
            const bool hasWorked = trace();
            presenter.endFrame(
                [&](vulkan::Commands& commands, const Screen& screen) { paint(commands, screen); });
            isIdle = !hasWorked && !loader.isBusy();
            measure(now);
            window.setTitle(titleText());
        }
    }

  private:
    // --- scenes ---

    void askForScene() {
        SceneRequest request = options.scene;
        request.file = state.file;
        request.import = state.settings.import;
        request.light = state.settings.light;
        request.path = state.settings.path;
        request.hiddenMeshes = state.settings.hiddenMeshes;
        request.reading = readings;
        loader.ask(std::move(request));
        state.busy = fmt::format("reading {} ...", state.file.filename().string());
    }

    void takeScene() {
        std::optional<SceneLoader::Answer> answer = loader.take();
        if (!answer) {
            return;
        }
        state.busy.clear();
        if (!answer->scene) {
            if (!state.scene) {
                throw Error(static_cast<ExitCode>(answer->exitCode), answer->refusal);
            }
            state.say(answer->refusal);
            goBack();
            return;
        }
        try {
            showScene(std::move(answer->scene));
        } catch (const Error& error) {
            if (!state.scene) {
                throw;
            }
            state.say(error.what());
            goBack();
        }
    }

    // What was asked for is refused: nobody wants it any more.
    void goBack() {
        const SceneRequest& shown = state.scene->request;
        state.file = shown.file;
        state.settings.import = shown.import;
        state.settings.light = shown.light;
        state.settings.hiddenMeshes = shown.hiddenMeshes;
        readings = shown.reading;
    }

    void showScene(std::shared_ptr<const LoadedScene> loaded) {
        const bool isOther = !state.scene || state.scene->request.file != loaded->request.file;
        state.size = presenter.size();
        const ViewCamera camera = cameraFor(*loaded); // refuses one that the scene does not have
        auto next = std::make_unique<Stage>(device, loaded);
        dropCanvases();
        stage = std::move(next);
        if (isOther || state.scene->whole != loaded->whole) {
            for (const std::string& warning : loaded->warnings) {
                state.say("warning: " + warning);
            }
            fileWatch.watch({loaded->request.file});
        }
        if (!state.scene || state.scene->shown != loaded->shown) {
            state.selected.reset();
            state.march.reset();
        }
        state.scene = std::move(loaded);
        state.camera = camera;
        state.statistics.deviceBytes = stage->buffers.bytes() + stage->shading.bytes();
        isStale = true;
    }

    // Chosen on the command line; the first one, of a scene that was dropped on the window; else the one that
    // the window has.
    ViewCamera cameraFor(const LoadedScene& loaded) const {
        const Scene& scene = *loaded.whole;
        if (!state.scene) {
            return options.chooseCamera(scene, aspect());
        }
        if (state.scene->request.file == loaded.request.file) {
            return followed(state.camera, *state.scene->whole, scene,
                            glm::length(state.camera.target - state.camera.eye));
        }
        return scene.cameras.empty() ? framing(loaded.bounds, aspect(), ViewCamera().verticalFov)
                                     : ofFile(scene, 0, distanceOf(loaded, scene.cameras[0].eye));
    }

    float aspect() const { return static_cast<float>(state.size.x) / static_cast<float>(state.size.y); }

    static float distanceOf(const LoadedScene& loaded, const glm::vec3& eye) {
        const glm::vec3 middle = 0.5f * (loaded.bounds.lo + loaded.bounds.hi);
        const float distance = glm::length(middle - eye);
        return distance > 0.0f ? distance : 1.0f;
    }

    void takeDropped(const Input& input) {
        for (const std::filesystem::path& file : input.dropped) {
            if (isMap(file)) {
                state.settings.light.kind = LightChoice::Kind::map;
                state.settings.light.map = file;
            } else {
                state.file = file;
                state.settings.hiddenMeshes.clear();
                state.settings.import.variant.clear();
                state.settings.import.time.reset();
            }
            askForScene();
        }
    }

    void reloadWhatChanged() {
        if (fileWatch.hasChanged()) {
            readAgain();
        }
        if (stage && shaders.hasChanged()) {
            compileShaders();
            if (state.shaderError.empty()) {
                dropCanvases();
                isStale = true;
            }
        }
    }

    void compileShaders() {
        const std::string error = shaders.compile(traversals(), stage->buffers.memoryKind());
        state.shaderError = error;
        state.say(error.empty() ? "shaders compiled anew"
                                : "shader error: " + error.substr(0, error.find('\n')));
    }

    void readAgain() {
        ++readings;
        askForScene();
    }

    // --- what keys and buttons ask for ---

    void act() {
        for (const Action action : std::exchange(state.actions, {})) {
            if (state.scene || action == Action::quit) {
                act(action);
            }
        }
    }

    void act(const Action action) {
        switch (action) {
        case Action::frameAll:
            state.camera = framing(state.scene->bounds, aspect(), state.camera);
            break;
        case Action::frameSelected:
            frameSelected();
            break;
        case Action::nextCamera:
            nextCamera();
            break;
        case Action::printCamera:
            printCamera();
            break;
        case Action::saveScreenshot:
            save(".png");
            break;
        case Action::saveExr:
            save(".exr");
            break;
        case Action::reload:
            readAgain();
            break;
        case Action::nextTraversal:
            state.settings.traversal = nextTraversal(state.settings.traversal);
            break;
        case Action::nextView:
            turnView(1);
            break;
        case Action::previousView:
            turnView(-1);
            break;
        case Action::toggleSplit:
            state.settings.rival = state.hasSplit() ? "" : nextTraversal(state.settings.traversal);
            break;
        case Action::togglePanels:
            state.settings.hasPanels = !state.settings.hasPanels;
            break;
        case Action::quit:
            window.close();
            break;
        }
    }

    void printCamera() {
        const std::string text = optionsText(state.camera, *state.scene->whole);
        state.say(text);
        window.copy(text);
    }

    void frameSelected() {
        if (!state.selected) {
            return;
        }
        const Scene& shown = *state.scene->shown;
        Bounds bounds{state.selected->corners[0], state.selected->corners[0]};
        for (std::size_t i = 0; i < shown.triangles.size(); ++i) {
            if (shown.triangleMesh[i] == state.selected->mesh) {
                for (int corner = 0; corner < 3; ++corner) {
                    const glm::vec3& place = shown.positions[shown.triangles[i][corner]];
                    bounds = {glm::min(bounds.lo, place), glm::max(bounds.hi, place)};
                }
            }
        }
        state.camera = framing(bounds, aspect(), state.camera);
    }

    void nextCamera() {
        const std::vector<SceneCamera>& cameras = state.scene->whole->cameras;
        if (cameras.empty()) {
            state.say("the scene has no cameras");
            return;
        }
        const std::size_t next =
            state.camera.fileCamera ? (*state.camera.fileCamera + 1) % cameras.size() : 0;
        state.camera = ofFile(*state.scene->whole, next, distanceOf(*state.scene, cameras[next].eye));
        state.say(fmt::format("camera {} '{}'", next, cameras[next].name));
    }

    // One that the device can run.
    std::string nextTraversal(const std::string& current) const {
        const std::span<const std::string_view> all = metamarch::traversals();
        auto at = std::ranges::find(all, current);
        do {
            at = at + 1 == all.end() ? all.begin() : at + 1;
        } while (!render::missingFor(device.report(), *at).empty());
        return std::string(*at);
    }

    // Through all views, the picture before the first.
    void turnView(const int by) {
        constexpr int kCount = static_cast<int>(kInspectViews) + 1;
        const int current = state.settings.view ? static_cast<int>(*state.settings.view) + 1 : 0;
        const int next = (current + by + kCount) % kCount;
        state.settings.view = next == 0 ? std::nullopt : std::optional(static_cast<std::uint32_t>(next - 1));
    }

    void save(const char* const ending) {
        if (canvases.empty()) {
            return;
        }
        try {
            const Plate& plate = canvases.front()->finePlate();
            state.say(saver.save(plate, lastShot, state, ending));
        } catch (const Error& error) {
            state.say(error.what());
        }
    }

    // --- pictures ---

    std::vector<std::string> traversals() const {
        std::vector<std::string> names = {state.settings.traversal};
        if (state.hasSplit()) {
            names.push_back(state.settings.rival);
        }
        return names;
    }

    // What has changed decides what is done anew.
    void follow(const Settings& before, const ViewCamera& cameraBefore) {
        const Settings& now = state.settings;
        const bool isOtherScene = before.light != now.light || before.import != now.import ||
                                  before.hiddenMeshes != now.hiddenMeshes ||
                                  before.path.shading() != now.path.shading();
        if (isOtherScene) {
            askForScene();
        }
        const bool isOtherPicture = cameraBefore != state.camera || before.path != now.path ||
                                    before.view != now.view || before.heatMax != now.heatMax ||
                                    before.samples != now.samples;
        isStale = isStale || isOtherPicture || !hasCanvases();
        if (stage && !hasCanvases()) {
            makeCanvases();
        }
        for (const auto& canvas : canvases) {
            canvas->setTone(now.tone);
        }
        if (isStale && !canvases.empty()) {
            lastShot = makeShot();
            for (const auto& canvas : canvases) {
                canvas->start(lastShot, kQuickSeconds / static_cast<double>(canvases.size()));
            }
            state.statistics.sideSeconds = {};
            isStale = false;
        }
    }

    bool hasCanvases() const {
        const std::vector<std::string> wanted = traversals();
        return canvasSize == state.size && canvases.size() == wanted.size() &&
               std::ranges::equal(canvases, wanted, {},
                                  [](const auto& canvas) { return canvas->traversal(); });
    }

    void dropCanvases() {
        presenter.wait();
        canvases.clear();
    }

    void makeCanvases() {
        dropCanvases();
        if (shaders.lacks(traversals())) {
            compileShaders();
        }
        canvasSize = state.size;
        try {
            for (const std::string& name : traversals()) {
                canvases.push_back(
                    std::make_unique<Canvas>(device, *stage, name, canvasSize, shaders.overrides()));
            }
        } catch (const Error& error) {
            state.say(error.what());
            dropCanvases();
        }
    }

    Shot makeShot() const {
        Shot shot;
        shot.camera = sceneCameraOf(state.camera, *state.scene->whole);
        shot.lens = lensOf(state.camera);
        shot.settings = state.settings.path.applied(state.scene->shading.settings);
        shot.view = state.settings.view;
        shot.endSample = state.settings.samples;
        shot.scaleMax = shot.view && !isHeatMap(*shot.view) ? farthestCorner() : state.settings.heatMax;
        return shot;
    }

    // Of the scene's box from the eye.
    float farthestCorner() const {
        const Bounds& bounds = state.scene->bounds;
        const glm::vec3 away =
            glm::max(glm::abs(bounds.lo - state.camera.eye), glm::abs(bounds.hi - state.camera.eye));
        return std::max(glm::length(away), 1e-30f);
    }

    // Whether the device has done something.
    bool trace() {
        if (!state.scene || canvases.empty()) {
            return false;
        }
        try {
            bool hasWorked = false;
            for (int i = 0; i < kMostQuickSubmissions && !isWhole(); ++i) {
                for (const auto& canvas : canvases) {
                    hasWorked = (!canvas->isWhole() &&
                                 canvas->advance(kQuickSeconds / static_cast<double>(canvases.size()))) ||
                                hasWorked;
                }
            }
            if (!hasWorked) {
                for (const auto& canvas : canvases) {
                    hasWorked =
                        canvas->advance(kCalmSeconds / static_cast<double>(canvases.size())) || hasWorked;
                }
            }
            return hasWorked;
        } catch (const Error& error) {
            if (error.code == ExitCode::noDevice) {
                throw; // lost
            }
            state.say(error.what());
            state.settings.traversal = std::string(metamarch::traversals().front());
            state.settings.rival.clear();
            dropCanvases();
            return false;
        }
    }

    bool isWhole() const {
        return std::ranges::all_of(canvases, [](const auto& canvas) { return canvas->isWhole(); });
    }

    void paint(vulkan::Commands& commands, const Screen& screen) {
        if (canvases.empty() || canvasSize != screen.size) {
            constexpr std::uint32_t kEmpty = 0xff201c1a; // dark, in either order of colours
            commands.fill(screen.pixels, kEmpty);
            return;
        }
        const bool isSplit = canvases.size() > 1;
        const auto line =
            isSplit ? static_cast<std::uint32_t>(state.settings.splitAt * static_cast<float>(screen.size.x))
                    : screen.size.x;
        if (line > 0) {
            canvases[0]->record(commands, screen, 0, line);
        }
        if (line < screen.size.x) {
            canvases[1]->record(commands, screen, line, screen.size.x);
        }
    }

    // --- words ---

    void measure(const Clock::time_point now) {
        ++frames;
        for (std::size_t i = 0; i < canvases.size(); ++i) {
            const Plate& plate = canvases[i]->finePlate();
            if (plate.isWhole()) {
                double& seconds = state.statistics.sideSeconds[i];
                const double samples = std::max(plate.samples(), 1.0);
                seconds = plate.seconds() / samples;
            }
        }
        if (!canvases.empty()) {
            state.statistics.samples = canvases.front()->finePlate().samples();
        }
        const double seconds = secondsBetween(measured, now);
        if (seconds < kStatisticsSeconds) {
            return;
        }
        const render::PathCounters counters = totalCounters();
        const auto rate = [&](const double after, const double before) {
            return std::max(after - before, 0.0) / seconds;
        };
        Statistics& statistics = state.statistics;
        statistics.framesPerSecond = frames / seconds;
        statistics.raysPerSecond = rate(counters.rays, countersBefore.rays);
        statistics.samplesPerSecond = rate(counters.samples, countersBefore.samples);
        const double rays = counters.rays - countersBefore.rays;
        if (rays > 0.0) {
            statistics.stepsPerRay = (counters.steps - countersBefore.steps) / rays;
            statistics.testsPerRay = (counters.tests - countersBefore.tests) / rays;
        }
        countersBefore = counters;
        measured = now;
        frames = 0;
    }

    render::PathCounters totalCounters() const {
        render::PathCounters total;
        for (const auto& canvas : canvases) {
            for (const Plate* const plate : {&canvas->coarsePlate(), &canvas->finePlate()}) {
                if (const render::PathCounters* const counters = plate->counters()) {
                    total.rays += counters->rays;
                    total.samples += counters->samples;
                    total.steps += counters->steps;
                    total.tests += counters->tests;
                }
            }
        }
        return total;
    }

    std::string titleText() const {
        const Settings& settings = state.settings;
        const std::string seen =
            settings.view
                ? std::string(render::kViewNames[*settings.view].name)
                : fmt::format("{}, {} of {} samples", settings.path.integrator,
                              static_cast<std::uint32_t>(state.statistics.samples), settings.samples);
        const std::string how =
            state.hasSplit() ? settings.traversal + " | " + settings.rival : settings.traversal;
        return fmt::format("{} - {} - {}{} - metamarch", state.file.filename().string(), seen, how,
                           state.busy.empty() ? "" : " - busy");
    }

    const ViewerOptions& options;
    WindowSystem system;
    Window window;
    vulkan::Context context;
    vulkan::Device device;
    Presenter presenter;
    ShaderReload shaders;
    PictureSaver saver;
    SceneLoader loader;
    FileWatch fileWatch;
    Controls controls;
    ViewerState state;

    std::unique_ptr<Stage> stage;
    std::vector<std::unique_ptr<Canvas>> canvases; // left and right; they use the stage
    glm::uvec2 canvasSize{0};
    Shot lastShot;
    bool isStale = false; // the picture is to begin anew
    bool isIdle = false;
    std::uint32_t readings = 0;

    Clock::time_point measured = Clock::now();
    int frames = 0;
    render::PathCounters countersBefore;
};

} // namespace

void runViewer(const ViewerOptions& options) { Viewer(options).run(); }

} // namespace metamarch::viewer

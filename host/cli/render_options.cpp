// SPDX-License-Identifier: MIT
#include "metamarch/cli/render_options.h"

#include "metamarch/cli/device_settings.h"
#include "metamarch/cli/threads.h"
#include "metamarch/error/error.h"
#include "metamarch/file/input_file.h"
#include "metamarch/file/output_file.h"
#include "metamarch/file/standard_stream.h"
#include "metamarch/render/traversal_choice.h"
#include "metamarch/shaders/shader_library.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>
#include <utility>

namespace metamarch::cli {
namespace {

constexpr std::pair<std::string_view, Backend> kBackends[] = {{"gpu", Backend::gpu}, {"cpu", Backend::cpu}};

constexpr std::pair<std::string_view, ProgressForm> kProgressForms[] = {{"line", ProgressForm::line},
                                                                        {"json", ProgressForm::json}};

// What does not go together in a render that is stopped, continued or divided.
void checkRun(const RenderOptions& options) {
    const auto refuse = [](const std::string& line) { throw Error(ErrorKind::invalidArgument, line); };
    if (options.samples && !isPart(options)) {
        refuse(
            "--samples takes a part of the samples, which is no picture: name the output .part, and put the "
            "parts together with `metamarch merge`");
    }
    const bool keepsSums = isPart(options) || !options.checkpointPath.empty() ||
                           !options.resumePath.empty() || options.timeLimit;
    if (options.path.integrator == Integrator::primary && keepsSums) {
        throw Error(ErrorKind::invalidArgument,
                    "`primary` takes one sample: it has no parts, checkpoint or time limit", {"integrator"});
    }
    if (options.adaptive.isOn() && isPart(options)) {
        refuse("--noise-threshold looks at all samples of a picture: it renders no .part");
    }
    if (options.isDenoised && (options.path.integrator == Integrator::primary || isPart(options))) {
        throw Error(ErrorKind::invalidArgument,
                    isPart(options) ? "a .part holds sums; a picture of them is not denoised"
                                    : "the integrator primary has no noise",
                    {"denoise"});
    }
    if (options.timeLimit && options.samples) {
        refuse("--time-limit and --samples exclude each other: a part has all its samples");
    }
    if (options.crop && (options.crop->right > options.size.x || options.crop->bottom > options.size.y)) {
        throw Error(ErrorKind::invalidArgument,
                    fmt::format("the crop reaches beyond the picture of {} x {} pixels", options.size.x,
                                options.size.y),
                    {"crop"});
    }
    if (options.writeEvery && isStandardOutput(options.outputPath)) {
        refuse("--write-every would write several pictures to standard output");
    }
}

void checkCatcher(const RenderOptions& options) {
    const auto refuse = [](const std::string& line) { throw Error(ErrorKind::invalidArgument, line); };
    if (options.catcher.isOn() && options.path.integrator == Integrator::primary) {
        refuse("`--integrator primary` has no shadows for --shadow-catcher");
    }
    if (options.catcher.isOn() && options.adaptive.isOn()) {
        refuse("--noise-threshold judges colours, of which a --shadow-catcher has none: give --spp alone");
    }
    if (!options.catcher.isOn() && std::ranges::find(options.aovs, "shadow") != options.aovs.end()) {
        refuse("--aov shadow is the shadow on a ground: name it by --shadow-catcher");
    }
}

void checkMotion(const RenderOptions& options) {
    const auto refuse = [](const std::string& line) { throw Error(ErrorKind::invalidArgument, line); };
    if (!options.import.time && std::ranges::find(options.aovs, "motion") != options.aovs.end()) {
        refuse("--aov motion leads from --time SECONDS to the next frame: give the time");
    }
    if (hasMotion(options) && isStandardInput(options.scenePath)) {
        refuse("--aov motion reads the scene twice, at two times, and standard input gives it once");
    }
}

void checkChannels(const RenderOptions& options) {
    const std::vector<Aov> chosen = settingsOf(options).aovs();
    if (isPart(options)) {
        return;
    }
    if (pictureFormatOf(options.outputPath, options.storage) != PictureFormat::exr) {
        throw Error(ErrorKind::invalidArgument,
                    fmt::format("{}: only an EXR has further channels", options.outputPath), {"aov"});
    }
    const auto staysExact = [](const Aov& aov) { return aov.isCryptomatte() || aov.name() == "P"; };
    if (std::ranges::any_of(chosen, staysExact) && !options.storage.exr.isMultipart &&
        options.storage.exr.compression == ExrCompression::dwaa) {
        refuseLossyIds();
    }
}

// "A:B", which begins no later than it ends.
render::SampleRange parseSamples(const std::string& text) {
    const std::size_t colon = text.find(':');
    const auto refuse = [](const std::string& line) { throw Error(ErrorKind::invalidArgument, line); };
    if (colon == std::string::npos) {
        std::string hint;
        try {
            hint = fmt::format("; did you mean `--spp {}`?", parseCount(text, 1, kMostSamples));
        } catch (const Error&) {
        }
        refuse("give A:B, the samples from number A to number B - 1" + hint);
    }
    const render::SampleRange range{parseCount(text.substr(0, colon), 0, kMostSamples),
                                    parseCount(text.substr(colon + 1), 0, kMostSamples)};
    if (range.first >= range.end) {
        refuse("give A:B with A less than B");
    }
    return range;
}

void declareRun(SettingList& settings, RenderOptions& options) {
    settings.beginGroup("Long renders, and renders in parts");
    settings.choice("progress", options.progress, kProgressForms,
                    "line: on a terminal; json: one line of JSON a second on standard error");
    const NumberRange seconds{1e-3, 1e9, "seconds from 0.001 to 1e9"};
    settings
        .number("write-every", options.writeEvery, seconds,
                "Also write the picture as it is, and the checkpoint, so often (or on the signal USR1)")
        .withValueName("SECONDS");
    settings
        .number("time-limit", options.timeLimit, seconds,
                "End with the pass over the picture that reaches this time")
        .withValueName("SECONDS");
    settings
        .text("checkpoint", options.checkpointPath,
              "Keep the samples taken here, each minute and when the render is ended early")
        .withValueName("FILE");
    settings.text("resume", options.resumePath, "Go on from this checkpoint or part").withValueName("FILE");
    settings
        .add("samples", Setting::Kind::value,
             {[&options](const std::string& text) { options.samples = parseSamples(text); },
              [&options] {
                  return options.samples ? fmt::format("{}:{}", options.samples->first, options.samples->end)
                                         : "";
              }},
             "Take the samples from A to B - 1 of each pixel; the output is a .part")
        .withValueName("A:B")
        .excludes({"spp"});
    settings
        .add("crop", Setting::Kind::value,
             {[&options](const std::string& text) { options.crop = parseRect(text); },
              [&options] {
                  return options.crop ? fmt::format("{},{},{},{}", options.crop->left, options.crop->top,
                                                    options.crop->right, options.crop->bottom)
                                      : "";
              }},
             "Render the pixels from (x0,y0) up to, and without, (x1,y1)")
        .withValueName("x0,y0,x1,y1");
}

} // namespace

bool hasMotion(const RenderOptions& options) {
    const std::vector<Aov> chosen = settingsOf(options).aovs();
    return options.import.time && std::ranges::find(chosen, "motion", &Aov::name) != chosen.end();
}

bool isPart(const RenderOptions& options) { return lowerCaseEnding(options.outputPath) == ".part"; }

void declareRender(SettingList& settings, RenderOptions& options) {
    settings.positional("SCENE", options.scenePath,
                        "glTF, GLB, OBJ, PLY, OFF or STL file; -: a GLB from standard input");
    settings
        .text("output", options.outputPath,
              "Picture to write: .exr (all channels), .png, .jpg, .webp or .tif; .part: sums for `merge`; -: "
              "to standard output, as --format says (exr)")
        .withShortName("o")
        .withValueName("FILE")
        .required();
    settings.size("size", options.size, "Width and height in pixels");
    settings.text("stats", options.statsPath, "Write what it took as JSON; -: to standard output")
        .withValueName("FILE.json");
    settings.flag("stamp", options.isStamped,
                  "Say in an EXR's header when it was made and how long that took");
    settings.flag("quiet", options.quiet, "Print nothing but errors and warnings");
    settings
        .flag("verbose", options.isVerbose,
              "Also print the device, and each stage with its seconds, on standard error")
        .excludes({"quiet"});
    declareChannels(settings, options.aovs, options.missDepth);
    settings
        .number("frame-rate", options.frameRate, {1e-3, 1e6, "frames per second, from 0.001 to 1e6"},
                "Frames per second: the channel motion leads to the next one")
        .withValueName("FPS")
        .needs({"time"});
    settings.flag(
        "transparent", options.path.isTransparent,
        "The camera does not see the background or the environment, which light the scene all the same");
    settings.flag(
        "denoise", options.isDenoised,
        "Remove noise with Open Image Denoise, if it is installed; in an EXR the channels noisy.* are "
        "the picture without it");
    declareCatcher(settings, options.catcher, options.path);
    declareStorage(settings, options.storage);
    declareCamera(settings, options.view);
    declareTone(settings, options.tone);
    settings.beginGroup("Device");
    settings.choice("backend", options.backend, kBackends,
                    "gpu: Vulkan compute; cpu: the same kernel on the processor, without Vulkan");
    declareDevice(settings, options.device);
    declareThreads(settings, options.threads);
    declareTraversal(settings, "traversal", options.traversal,
                     fmt::format("How rays find triangles (default {}, or what marches --table; with "
                                 "--backend cpu {} or kd_stack): {}",
                                 traversals().front(), traversals().front(), fmt::join(traversals(), " ")));
    declareIntegrator(settings, options.path, std::size(kIntegrators));
    declarePath(settings, options.path, options.samplesPerPixel);
    settings
        .number("noise-threshold", options.adaptive.threshold, {0.0, 1e6, "an error of at least 0"},
                "Stop pixels once the standard error of their luminance, divided by its square root, is "
                "less around them; 0: never")
        .withValueName("E");
    settings
        .count("min-spp", options.adaptive.minSamples, 1, kMostSamples,
               "Samples a pixel before the first is stopped")
        .needs({"noise-threshold"});
    declareRun(settings, options);
    declareLight(settings, options.light);
    declareImport(settings, options.import);
    declareStructure(settings, options.structure);
}

render::RenderSettings settingsOf(const RenderOptions& options) {
    render::RenderSettings settings;
    settings.path = options.path;
    settings.firstSample = options.samples ? options.samples->first : 0;
    settings.samplesPerPixel = options.samples ? options.samples->end : options.samplesPerPixel;
    settings.adaptive = options.adaptive;
    settings.area = options.crop;
    settings.traversal = options.traversal;
    settings.missDepth = options.missDepth;
    if (!options.aovs.empty()) {
        settings.channels = chooseAovs(options.aovs, settings.writer());
    }
    if (!settings.traversal.empty()) {
        render::requireTable(options.structure.table, settings.traversal); // before the scene is loaded
    }
    return settings;
}

void checkArguments(const RenderOptions& options) {
    if (options.backend == Backend::cpu) {
        if (!options.device.empty()) {
            throw Error(ErrorKind::invalidArgument, "a device is for the gpu", {"backend", "device"});
        }
        render::traversalOnCpu(options.traversal);
    }
    checkRun(options);
    checkCatcher(options);
    checkMotion(options);
    checkView(options.view, options.path.integrator);
    checkStructure(options.structure);
}

std::vector<NamedFile> outputsOf(const RenderOptions& options) {
    return {{"--output", options.outputPath},
            {"--stats", options.statsPath},
            {"--checkpoint", options.checkpointPath}};
}

void checkFormat(const RenderOptions& options) {
    if (!options.aovs.empty()) {
        checkChannels(options);
    }
    if (!isPart(options) && options.path.isTransparent &&
        pictureFormatOf(options.outputPath, options.storage) == PictureFormat::jpeg) {
        throw Error(ErrorKind::invalidArgument,
                    fmt::format("{}: a JPEG cannot be transparent", options.outputPath), {"transparent"});
    }
}

void checkOutputs(const RenderOptions& options, const SettingList& given) {
    if (isPart(options)) {
        const OutputFile probe(options.outputPath);
    } else {
        checkWritable(options.outputPath, options.storage);
    }
    checkFormat(options);
    if (!options.statsPath.empty()) {
        const OutputFile probe(options.statsPath);
    }
    const std::vector<NamedFile> outputs = outputsOf(options);
    const NamedFile inputs[] = {{"SCENE", options.scenePath},
                                {"--env", given.at("env").text()},
                                {"--partition", given.at("partition").text()}};
    checkOutputsDiffer(outputs, inputs);
    // A checkpoint that is continued is also resumed.
    const NamedFile resumed[] = {{"--resume", options.resumePath}};
    checkOutputsDiffer(std::span(outputs).first(2), resumed);
}

} // namespace metamarch::cli

// SPDX-License-Identifier: MIT
#include "metamarch/bench/ray_file.h"
#include "metamarch/bench/results_page.h"
#include "metamarch/bench/traversal_bench.h"
#include "metamarch/cli/bench_options.h"
#include "metamarch/cli/commands.h"
#include "metamarch/cli/device_settings.h"
#include "metamarch/cli/output_check.h"
#include "metamarch/cli/threads.h"
#include "metamarch/cli/warnings.h"
#include "metamarch/error/error.h"
#include "metamarch/file/output_file.h"
#include "metamarch/file/standard_stream.h"
#include "metamarch/render/prepared_scene.h"
#include "metamarch/render/traversal_choice.h"
#include "metamarch/scene/import.h"
#include "metamarch/settings/render_settings.h"
#include "metamarch/shaders/shader_library.h"
#ifdef METAMARCH_EMBREE
#include "metamarch/bench/embree_peer.h"
#endif

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <optional>

namespace metamarch::cli {
namespace {

struct TraversalOptions {
    std::vector<std::string> scenePaths;
    std::vector<std::string> rays;
    std::vector<std::string> traversals;  // empty: the default
    std::vector<std::string> devices{""}; // the best one
    std::string jsonPath;
    std::string markdownPath;
    BenchOptions bench;
    ImportOptions import;
    AccelerationOptions structure;
};

// Returns the traversals that are measured on `device`: those that the user names, which must run, or the one
// of --table rectilinear, or by default all that the device can run. The program names those that it leaves
// out by default. It also leaves out brute_force, which takes minutes where the others take milliseconds.
std::vector<std::string> chooseTraversals(const vulkan::DeviceReport& device,
                                          const std::vector<std::string>& askedFor, const TableMethod table) {
    for (const std::string& traversal : askedFor) {
        render::requireTraversal(device, traversal);
    }
    if (!askedFor.empty()) {
        return askedFor;
    }
    if (table == TableMethod::rectilinear) {
        return {std::string(render::marchingTraversal(table))};
    }
    std::vector<std::string> names(traversals().begin(), traversals().end());
    std::erase(names, "brute_force");
    std::erase_if(names, [&](const std::string& traversal) {
        const std::vector<std::string> missing = render::missingFor(device, traversal);
        if (!missing.empty()) {
            printResult(fmt::format("{} is left out: {} lacks {}\n", traversal, device.name,
                                    fmt::join(missing, ", ")));
        }
        return !missing.empty();
    });
    return names;
}

// A device and what is measured on it.
struct BenchDevice {
    std::unique_ptr<vulkan::Device> device;
    std::vector<std::string> traversals;
};

bool isRaySetName(const std::string& word) {
    return std::ranges::find(bench::kRaySets, word, &bench::RaySetKind::name) != bench::kRaySets.end();
}

// Collects the rows, and prints each at once. A row whose hits are not the judge's is left out and named.
class RowSink {
  public:
    template <class MakeRow>
    void add(const MakeRow& makeRow) {
        try {
            add(makeRow());
        } catch (const Error& error) {
            if (error.kind != ErrorKind::mismatch) {
                throw;
            }
            refused.emplace_back(error.what());
        }
    }

    void add(const bench::Row& row) {
        printResult(fmt::format("{}\n", bench::toText(row)));
        flushResults();
        rows.push_back(row);
    }

    std::vector<bench::Row> rows;
    std::vector<std::string> refused;
};

void benchScene(bench::BenchScene& scene, const TraversalOptions& options, const glm::uvec2 size,
                const std::vector<BenchDevice>& devices, RowSink& sink) {
    const bench::Protocol protocol = options.bench.protocol();
#ifdef METAMARCH_EMBREE
    const bench::EmbreePeer embree(scene);
#endif
    std::vector<std::unique_ptr<render::SceneBuffers>> buffers;
    buffers.reserve(devices.size());
    for (const BenchDevice& used : devices) {
        buffers.push_back(
            std::make_unique<render::SceneBuffers>(*used.device, scene.structure, scene.shading));
    }
    for (const std::string& word : options.rays) {
        bench::RaySet set = isRaySetName(word)
                                ? bench::makeRaySet(word, scene.scene, scene.structure, size.x, size.y)
                                : bench::readRayFile(word);
        const bench::JudgedRays rays = bench::judgeRays(
            scene, isRaySetName(word) ? word : std::filesystem::path(word).filename().string(), "",
            std::move(set));
        // If the hits of the floor are not the judge's, the triangle test itself differs, and the benchmark
        // ends.
        for (std::size_t i = 0; i < devices.size(); ++i) {
            const bench::Row floor =
                bench::benchFloorOnDevice(scene, rays, *devices[i].device, *buffers[i], protocol);
            sink.add(floor);
            for (const std::string& traversal : devices[i].traversals) {
                sink.add([&] {
                    bench::Row row = bench::benchOnDevice(scene, rays, traversal, *devices[i].device,
                                                          *buffers[i], protocol);
                    bench::compareWithFloor(row, floor);
                    return row;
                });
            }
        }
#ifdef METAMARCH_EMBREE
        const bench::Row floor = bench::benchFloorOnCpu(scene, rays, protocol);
        sink.add(floor);
        for (bench::Row& row : embree.bench(rays, protocol)) {
            bench::compareWithFloor(row, floor);
            sink.add(row);
        }
#endif
    }
}

// Returns the devices: "all", or each word as --device takes it. No device is listed twice.
std::vector<BenchDevice> openDevices(const vulkan::Context& context, const TraversalOptions& options,
                                     const TableMethod table) {
    std::vector<std::string> names = options.devices;
    if (names == std::vector<std::string>{"all"}) {
        names.clear();
        for (const vulkan::DeviceReport& report : vulkan::reportDevices(context)) {
            if (report.usable()) {
                names.push_back(fmt::to_string(report.index));
            }
        }
    }
    std::vector<BenchDevice> devices;
    for (const std::string& name : names) {
        auto device = std::make_unique<vulkan::Device>(context, name);
        std::vector<std::string> measured = chooseTraversals(device->report(), options.traversals, table);
        devices.push_back({std::move(device), std::move(measured)});
    }
    return devices;
}

bench::Origin originOfAll(const BenchOptions& options, const std::vector<BenchDevice>& devices) {
    std::vector<std::string> names;
    std::vector<std::string> drivers;
    for (const BenchDevice& used : devices) {
        names.push_back(used.device->name());
        drivers.push_back(used.device->report().driverText());
    }
    return options.originOf(fmt::format("{}", fmt::join(names, "; ")),
                            fmt::format("{}", fmt::join(drivers, "; ")));
}

std::vector<NamedFile> outputsOf(const TraversalOptions& options) {
    return {{"--json", options.jsonPath}, {"--markdown", options.markdownPath}};
}

// Refuses bad outputs before the long work.
void checkOutputs(const TraversalOptions& options, const SettingList& given) {
    const std::vector<NamedFile> outputs = outputsOf(options);
    for (const NamedFile& output : outputs) {
        if (!output.path.empty()) {
            const OutputFile probe(output.path);
        }
    }
    std::vector<NamedFile> inputs = {{"--partition", given.at("partition").text()}};
    for (const std::string& path : options.scenePaths) {
        inputs.push_back({"SCENE", path});
    }
    for (const std::string& word : options.rays) {
        if (!isRaySetName(word)) {
            inputs.push_back({"--rays", word});
        }
    }
    checkOutputsDiffer(outputs, inputs);
}

void runTraversal(const TraversalOptions& options, const SettingList& given) {
    const glm::uvec2 size = options.bench.size;
    const AccelerationOptions& structureOptions = options.structure;
    checkStructure(structureOptions);
    for (const std::string& traversal : options.traversals) {
        render::requireTable(structureOptions.table, traversal);
    }
    checkOutputs(options, given);
    for (const std::string& word : options.rays) {
        if (!isRaySetName(word)) {
            bench::readRayFile(word); // before the long work
        }
    }
    const Threads threads(options.bench.threads);
    const vulkan::Context context;
    const std::vector<BenchDevice> devices = openDevices(context, options, structureOptions.table);

    const bench::Origin origin = originOfAll(options.bench, devices);
    RowSink sink;
    printResult(fmt::format("{} ({}), commit {}, {}\n{}\n{}\n", origin.device, origin.driver, origin.commit,
                            origin.date, bench::definitions(), bench::textHeadings()));
    for (const std::string& path : options.scenePaths) {
        Scene imported = loadScene(path, options.import);
        printWarnings(imported.warnings);
        checkOutputsDiffer(outputsOf(options), companionsOf(imported));
        bench::BenchScene scene(std::filesystem::path(path).filename().string(), std::move(imported),
                                structureOptions);
        printWarnings(render::warningsOf(scene.structure));
        benchScene(scene, options, size, devices, sink);
    }
    if (!options.jsonPath.empty()) {
        writeText(options.jsonPath, jsonText(origin, sink.rows));
    }
    if (!options.markdownPath.empty()) {
        writeText(options.markdownPath, bench::resultsPage(origin, sink.rows));
    }
    if (!sink.refused.empty()) {
        throw Error(ErrorKind::mismatch,
                    fmt::format("{} rows left out: {}", sink.refused.size(), fmt::join(sink.refused, "; ")));
    }
}

} // namespace

Command makeBenchTraversalCommand() {
    const auto options = std::make_shared<TraversalOptions>();
    options->rays = bench::raySetNames();
    Command command{"traversal", "Rays per second of every traversal, hits checked first", {}, {}, {}, {}};
    SettingList& settings = command.settings;
    settings.positionals("SCENE", options->scenePaths, "glTF, GLB, OBJ, PLY, OFF or STL files");
    settings
        .words("rays", options->rays,
               fmt::format("Ray sets ({}) and files of six float32 a ray, origin and direction; with commas "
                           "between (default: all sets)",
                           fmt::join(options->rays, " ")))
        .withValueName("NAME|FILE,...");
    settings
        .words("traversals", options->traversals,
               "Traversals, with commas between (default: all that a device can run, but brute_force)")
        .withValueName("NAME,...")
        .oneOf(traversalNames());
    settings
        .words("device", options->devices,
               "Vulkan devices, see `metamarch devices`, with commas between, or all")
        .withValueName("INDEX|NAME,...")
        .withOtherName("devices");
    settings.text("json", options->jsonPath, "Write the rows as JSON").withValueName("FILE");
    settings.text("markdown", options->markdownPath, "Write the rows as a Markdown page")
        .withValueName("FILE");
    options->bench.declare(settings);
    declareImport(settings, options->import);
    declareStructure(settings, options->structure);
    command.footer = "Example:\n  build/metamarch bench traversal scenes/objects.glb --rays close,diffuse "
                     "--traversals meta_table,kd_stack --size 160x120";
    command.run = [options](const SettingList& given) { runTraversal(*options, given); };
    return command;
}

} // namespace metamarch::cli

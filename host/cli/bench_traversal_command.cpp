#include "cli/bench_traversal_command.h"

#include "bench/ray_file.h"
#include "bench/traversal_bench.h"
#include "cli/bench_options.h"
#include "cli/structure_options.h"
#include "cli/warnings.h"
#include "error.h"
#include "image/output_file.h"
#include "scene/import.h"
#include "shader_library.h"
#ifdef METAMARCH_EMBREE
#include "bench/embree_peer.h"
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
    std::vector<std::string> traversals;
    std::vector<std::string> devices{""}; // the best one
    std::string jsonPath;
    std::string markdownPath;
    BenchOptions bench;
    StructureOptions structure;
};

// All but brute_force, which takes minutes where the others take milliseconds.
std::vector<std::string> defaultTraversals() {
    std::vector<std::string> names(traversals().begin(), traversals().end());
    std::erase(names, "brute_force");
    return names;
}

bool isRaySetName(const std::string& word) {
    return std::ranges::find(bench::kRaySetNames, word) != bench::kRaySetNames.end();
}

// The rows as they come: printed at once, written in the end. Rows whose hits were not the judge's are left
// out and told of.
class RowSink {
  public:
    template <class MakeRow>
    void add(const MakeRow& makeRow) {
        try {
            add(makeRow());
        } catch (const Error& error) {
            if (error.code != ExitCode::comparisonFailed) {
                throw;
            }
            refused.emplace_back(error.what());
        }
    }

    void add(const bench::Row& row) {
        fmt::print("{}\n", bench::toText(row));
        std::fflush(stdout);
        rows.push_back(row);
    }

    std::vector<bench::Row> rows;
    std::vector<std::string> refused;
};

void benchScene(bench::BenchScene& scene, const TraversalOptions& options, const glm::uvec2 size,
                const std::vector<std::unique_ptr<vulkan::Device>>& devices, RowSink& sink) {
    const bench::Protocol protocol = options.bench.protocol();
#ifdef METAMARCH_EMBREE
    const bench::EmbreePeer embree(scene);
#endif
    std::vector<std::unique_ptr<render::SceneBuffers>> buffers;
    for (const auto& device : devices) {
        buffers.push_back(std::make_unique<render::SceneBuffers>(*device, scene.structure, scene.shading));
    }
    for (const std::string& word : options.rays) {
        bench::RaySet set = isRaySetName(word)
                                ? bench::makeRaySet(word, scene.scene, scene.structure, size.x, size.y)
                                : bench::readRayFile(word);
        const bench::JudgedRays rays = bench::judgeRays(
            scene, isRaySetName(word) ? word : std::filesystem::path(word).filename().string(), "",
            std::move(set));
        for (std::size_t i = 0; i < devices.size(); ++i) {
            for (const std::string& traversal : options.traversals) {
                sink.add([&] {
                    return bench::benchOnDevice(scene, rays, traversal, *devices[i], *buffers[i], protocol);
                });
            }
        }
#ifdef METAMARCH_EMBREE
        for (const bench::Row& row : embree.bench(rays, protocol)) {
            sink.add(row);
        }
#endif
    }
}

// "all" or what --device takes, each once.
std::vector<std::unique_ptr<vulkan::Device>> openDevices(const vulkan::Context& context,
                                                         const std::vector<std::string>& selections) {
    std::vector<std::string> names = selections;
    if (names == std::vector<std::string>{"all"}) {
        names.clear();
        for (const vulkan::DeviceReport& report : vulkan::reportDevices(context)) {
            if (report.usable()) {
                names.push_back(fmt::to_string(report.index));
            }
        }
    }
    std::vector<std::unique_ptr<vulkan::Device>> devices;
    for (const std::string& name : names) {
        devices.push_back(std::make_unique<vulkan::Device>(context, name));
    }
    return devices;
}

bench::Origin originOfAll(const std::vector<std::unique_ptr<vulkan::Device>>& devices) {
    std::vector<std::string> names;
    std::vector<std::string> drivers;
    for (const auto& device : devices) {
        names.push_back(device->name());
        drivers.push_back(device->report().driverInfo);
    }
    return originOf(fmt::format("{}", fmt::join(names, "; ")), fmt::format("{}", fmt::join(drivers, "; ")));
}

void runTraversal(const TraversalOptions& options) {
    const glm::uvec2 size = options.bench.size();
    const AccelerationOptions structureOptions = options.structure.parse();
    for (const std::string& path : {options.jsonPath, options.markdownPath}) {
        if (!path.empty()) {
            const OutputFile probe(path);
        }
    }
    for (const std::string& word : options.rays) {
        if (!isRaySetName(word)) {
            bench::readRayFile(word); // before the long work
        }
    }
    const vulkan::Context context;
    const std::vector<std::unique_ptr<vulkan::Device>> devices = openDevices(context, options.devices);

    const bench::Origin origin = originOfAll(devices);
    RowSink sink;
    fmt::print("{} ({}), commit {}, {}\n{}\n{}\n", origin.device, origin.driver, origin.commit, origin.date,
               bench::definitions(), bench::textHeadings());
    for (const std::string& path : options.scenePaths) {
        Scene imported = loadScene(path, options.structure.scale());
        printWarnings(imported);
        bench::BenchScene scene(std::filesystem::path(path).filename().string(), std::move(imported),
                                structureOptions);
        printWarnings(scene.scene, scene.structure);
        benchScene(scene, options, size, devices, sink);
    }
    if (!options.jsonPath.empty()) {
        writeText(options.jsonPath, jsonText(origin, sink.rows));
    }
    if (!options.markdownPath.empty()) {
        writeText(options.markdownPath, bench::toMarkdown(origin, sink.rows));
    }
    if (!sink.refused.empty()) {
        throw Error(ExitCode::comparisonFailed,
                    fmt::format("{} rows left out: {}", sink.refused.size(), fmt::join(sink.refused, "; ")));
    }
}

} // namespace

void addBenchTraversalCommand(CLI::App& bench) {
    CLI::App* command =
        bench.add_subcommand("traversal", "Rays per second of every traversal, hits checked first");
    const auto options = std::make_shared<TraversalOptions>();
    options->rays.assign(bench::kRaySetNames.begin(), bench::kRaySetNames.end());
    options->traversals = defaultTraversals();
    command->add_option("SCENE", options->scenePaths, "glTF, GLB, OBJ, PLY, OFF or STL files")->required();
    command
        ->add_option("--rays", options->rays,
                     fmt::format("Ray sets ({}) and files of six float32 a ray, origin and direction; with "
                                 "commas between (default: all sets)",
                                 fmt::join(bench::kRaySetNames, " ")))
        ->type_name("NAME|FILE,...")
        ->delimiter(',');
    command
        ->add_option("--traversals", options->traversals,
                     "Traversals, with commas between (default: all but brute_force)")
        ->type_name("NAME,...")
        ->delimiter(',')
        ->check(CLI::IsMember(std::vector<std::string>(traversals().begin(), traversals().end())));
    command
        ->add_option("--device,--devices", options->devices,
                     "Vulkan devices, see `metamarch devices`, with commas between, or all")
        ->type_name("INDEX|NAME,...")
        ->delimiter(',');
    command->add_option("--json", options->jsonPath, "Write the rows as JSON")->type_name("FILE");
    command->add_option("--markdown", options->markdownPath, "Write the rows as a table for a README")
        ->type_name("FILE");
    options->bench.addTo(*command);
    options->structure.addTo(*command);
    command->footer("Example:\n  build/metamarch bench traversal scenes/objects.glb --rays close,diffuse "
                    "--traversals meta_table,kd_stack --size 160x120");
    command->callback([options] { runTraversal(*options); });
}

} // namespace metamarch::cli

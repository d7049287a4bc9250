// SPDX-License-Identifier: MIT
#include "metamarch/bench/paper_bench.h"
#include "metamarch/cli/bench_options.h"
#include "metamarch/cli/commands.h"
#include "metamarch/cli/device_settings.h"
#include "metamarch/cli/threads.h"
#include "metamarch/cli/warnings.h"
#include "metamarch/error/error.h"
#include "metamarch/file/output_file.h"
#include "metamarch/file/standard_stream.h"

#include <fmt/format.h>

#include <memory>

namespace metamarch::cli {
namespace {

struct PaperOptions {
    std::string scenes;
    std::string out;
    std::string device;
    BenchOptions bench;
};

void makeFolder(const std::filesystem::path& folder) {
    std::error_code failure;
    std::filesystem::create_directories(folder, failure);
    if (failure) {
        throw Error(ErrorKind::outputNotWritable, fmt::format("{}: {}", folder.string(), failure.message()));
    }
}

void runPaper(const PaperOptions& options) {
    const glm::uvec2 size = options.bench.size;
    const bench::Protocol protocol = options.bench.protocol();
    const Threads threads(options.bench.threads);
    const vulkan::Context context;
    const vulkan::Device device(context, options.device);
    std::vector<std::unique_ptr<bench::BenchScene>> scenes;
    for (const bench::PaperModel& model : bench::paperModels()) {
        scenes.push_back(bench::loadPaperModel(model, options.scenes));
        printWarnings(scenes.back()->scene.warnings);
    }
    const std::filesystem::path folder = options.out;
    makeFolder(folder);
    { const OutputFile probe(folder / "paper.json"); }

    const bench::Origin origin = options.bench.originOf(device.name(), device.report().driverText());
    printResult(fmt::format("{} ({}), commit {}, {}\n{}\n{}\n", origin.device, origin.driver, origin.commit,
                            origin.date, bench::definitions(), bench::textHeadings()));
    std::vector<bench::Row> rows;
    for (const std::unique_ptr<bench::BenchScene>& scene : scenes) {
        bench::benchPaperModel(*scene, device, size.x, size.y, protocol, [&](const bench::Row& row) {
            printResult(fmt::format("{}\n", bench::toText(row)));
            flushResults();
            rows.push_back(row);
        });
    }
    writeText(folder / "paper.json", jsonText(origin, rows));
    writeText(folder / "paper.csv", bench::toCsv(rows));
    printResult(fmt::format("\n{}\n{} and paper.csv written; tools/plot_bench draws them\n",
                            bench::compareWithClaims(rows), (folder / "paper.json").string()));
}

} // namespace

Command makeBenchPaperCommand() {
    const auto options = std::make_shared<PaperOptions>();
    Command command{
        "paper", "The paper's experiment: cow and bunny, stack traversal against meta table", {}, {}, {}, {}};
    SettingList& settings = command.settings;
    settings.text("scenes", options->scenes, "Folder with the models, see tools/fetch_scenes")
        .withValueName("DIR")
        .required();
    settings.text("out", options->out, "Folder for paper.json and paper.csv").withValueName("DIR").required();
    declareDevice(settings, options->device);
    options->bench.declare(settings);
    command.footer = "Example:\n  build/metamarch bench paper --scenes build/scenes --out build/paper";
    command.run = [options](const SettingList&) { runPaper(*options); };
    return command;
}

} // namespace metamarch::cli

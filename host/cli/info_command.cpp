// SPDX-License-Identifier: MIT
#include "metamarch/accel/structure_set.h"
#include "metamarch/cli/commands.h"
#include "metamarch/cli/scene_report.h"
#include "metamarch/cli/structure_report.h"
#include "metamarch/cli/threads.h"
#include "metamarch/cli/warnings.h"
#include "metamarch/file/standard_stream.h"
#include "metamarch/render/prepared_scene.h"
#include "metamarch/scene/import.h"
#include "metamarch/settings/render_settings.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>
#include <optional>
#include <string>

namespace metamarch::cli {
namespace {

struct InfoOptions {
    std::string scenePath;
    ImportOptions import;
    AccelerationOptions structure;
    std::optional<std::uint32_t> threads;
    bool json = false;
};

std::string triple(const nlohmann::ordered_json& values, const char* separator) {
    if (values.is_null()) {
        return "none";
    }
    return fmt::format("{}{}{}{}{}", values[0].dump(), separator, values[1].dump(), separator,
                       values[2].dump());
}

// A name in the file may hold bytes that are no UTF-8. They are replaced.
std::string textOf(const nlohmann::ordered_json& json) {
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

void printText(const nlohmann::ordered_json& report) {
    const auto line = [](const char* label, const std::string& value) {
        printResult(fmt::format("{:<12} {}\n", label, value));
    };
    const auto count = [&](const char* group, const char* key) {
        return report[group][key].get<std::uint64_t>();
    };
    const auto mebibytes = [](const nlohmann::ordered_json& bytes, const char* key) {
        return static_cast<double>(bytes[key].get<std::uint64_t>()) / 0x1p20;
    };
    const auto seconds = [&](const char* key) { return report["seconds"][key].get<double>(); };
    line("vertices", report["vertices"].dump());
    line("triangles", fmt::format("{} ({} degenerate, in no leaf)", report["triangles"].dump(),
                                  report["degenerateTriangles"].dump()));
    line("bounds", triple(report["bounds"]["min"], " ") + "  to  " + triple(report["bounds"]["max"], " "));
    line("lattice", fmt::format("{} = {} cells, unit {}", triple(report["lattice"]["resolution"], " x "),
                                count("table", "cells"), triple(report["lattice"]["unit"], " ")));
    if (report.contains("planes")) {
        line("planes", fmt::format("moved by at most {:.4g}, to multiples of {:.4g}; {} of them a cell",
                                   report["planes"]["movedAtMost"].get<double>(),
                                   report["planes"]["quantum"].get<double>(),
                                   triple(report["planes"]["quantaPerCell"], " x ")));
    }
    line("kd-tree", fmt::format("{} nodes, depth {}", count("tree", "nodes"), count("tree", "depth")));
    line("leaves", fmt::format("{} with {} triangle references, {} empty", count("tree", "leaves"),
                               count("tree", "references"), count("tree", "emptyLeaves")));
    line("table", fmt::format("{} cells, {} leaves", count("table", "cells"), count("table", "leaves")));
    const nlohmann::ordered_json& bytes = report["bytes"];
    line("memory",
         fmt::format("tree {:.1f} MiB, table {:.1f} MiB, exit boxes {:.1f} MiB, reference boxes {:.1f} MiB, "
                     "triangles {:.1f} MiB",
                     mebibytes(bytes, "tree"), mebibytes(bytes, "table"), mebibytes(bytes, "exitBoxes"),
                     mebibytes(bytes, "referenceBoxes"), mebibytes(bytes, "triangles")));
    line("built in",
         fmt::format("tree {:.3f} s, table {:.3f} s: {:.0f} triangles per second", seconds("tree"),
                     seconds("table"), report["trianglesPerSecond"].get<double>()));
    if (report.contains("rectilinear")) {
        const nlohmann::ordered_json& table = report["rectilinear"];
        line("rectilinear",
             fmt::format("{} planes of a tree of depth {}, {} cells, {} leaves with {} triangle references",
                         triple(table["planes"], " x "), table["depth"].dump(), table["cells"].dump(),
                         table["leaves"].dump(), table["references"].dump()));
        const nlohmann::ordered_json& parts = table["bytes"];
        line("",
             fmt::format("table {:.1f} MiB, exit boxes {:.1f} MiB, planes {:.1f} MiB, triangles "
                         "{:.1f} MiB, built in {:.3f} s",
                         mebibytes(parts, "table"), mebibytes(parts, "exitBoxes"), mebibytes(parts, "planes"),
                         mebibytes(parts, "triangles"), table["seconds"].get<double>()));
    }
}

void runInfo(const InfoOptions& options) {
    checkStructure(options.structure);
    const Threads threads(options.threads);
    const auto scene = std::make_shared<const Scene>(loadScene(options.scenePath, options.import));
    printWarnings(scene->warnings);
    const render::PreparedScene prepared(scene, options.structure);
    printWarnings(render::warningsOf(*prepared.structure));
    nlohmann::ordered_json report = reportStructure(*scene, *prepared.structure);
    if (options.structure.table == TableMethod::rectilinear) {
        report["rectilinear"] = reportRectilinear(StructureSet(*prepared.structure).rectilinearTable());
    }
    if (options.json) {
        report.update(reportContents(*scene));
        printResult(textOf(report) + "\n");
    } else {
        printText(report);
        printResult(contentsText(*scene));
    }
}

} // namespace

Command makeInfoCommand() {
    const auto options = std::make_shared<InfoOptions>();
    Command command{
        "info", "Show what a scene holds, with its names, and what tree and table cost", {}, {}, {}, {}};
    SettingList& settings = command.settings;
    settings.positional("SCENE", options->scenePath, "glTF, GLB, OBJ, PLY, OFF or STL file");
    settings.flag("json", options->json, "Print JSON");
    declareThreads(settings, options->threads);
    declareImport(settings, options->import);
    declareStructure(settings, options->structure);
    command.footer = "Example:\n  build/metamarch info scenes/objects.glb --cells 100000";
    command.run = [options](const SettingList&) { runInfo(*options); };
    return command;
}

} // namespace metamarch::cli

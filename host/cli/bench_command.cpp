// SPDX-License-Identifier: MIT
#include "metamarch/bench/ray_set.h"
#include "metamarch/cli/commands.h"
#include "metamarch/error/error.h"
#include "metamarch/file/standard_stream.h"
#include "metamarch/render/scene_buffers.h"
#include "metamarch/shaders/shader_library.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

namespace metamarch::cli {

namespace {

// Returns a line for each traversal that a device cannot run. Without a device there are none.
std::string notOffered() {
    std::string text;
    try {
        const vulkan::Context context;
        for (const vulkan::DeviceReport& device : vulkan::reportDevices(context)) {
            for (const std::string_view traversal : traversals()) {
                const std::vector<std::string> missing = render::missingFor(device, traversal);
                if (!missing.empty()) {
                    text += fmt::format("not on {} {}: {} (it lacks {})\n", device.index, device.name,
                                        traversal, fmt::join(missing, ", "));
                }
            }
        }
    } catch (const Error&) {
        // no Vulkan: the lists are the same
    }
    return text;
}

} // namespace

Command makeBenchCommand() {
    const auto list = std::make_shared<bool>(false);
    Command command{"bench", "Measure traversals and repeat the paper's experiment", {}, {}, {}, {}};
    command.settings.flag("list", *list, "List traversals and ray sets, and what a device cannot run");
    command.footer = "Example:\n  build/metamarch bench --list";
    command.commands.push_back(makeBenchTraversalCommand());
    command.commands.push_back(makeBenchPaperCommand());
    command.run = [list](const SettingList&) {
        if (!*list) {
            throw Error(ErrorKind::invalidArgument,
                        "bench: say what: traversal or paper, or --list (see `metamarch bench --help`)");
        }
        printResult(fmt::format("traversals: {}\nray sets: {}\n{}", fmt::join(traversals(), " "),
                                fmt::join(bench::raySetNames(), " "), notOffered()));
    };
    return command;
}

} // namespace metamarch::cli

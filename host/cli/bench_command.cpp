#include "metamarch/cli/bench_command.h"

#include "metamarch/bench/ray_set.h"
#include "metamarch/cli/bench_paper_command.h"
#include "metamarch/cli/bench_traversal_command.h"
#include "metamarch/error/error.h"
#include "metamarch/render/scene_buffers.h"
#include "metamarch/shaders/shader_library.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

namespace metamarch::cli {

namespace {

// What each device cannot run, a line each; nothing where there is no device.
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

void addBenchCommand(CLI::App& program) {
    CLI::App* command =
        program.add_subcommand("bench", "Measure traversals and repeat the paper's experiment");
    const auto list = std::make_shared<bool>(false);
    command->add_flag("--list", *list, "List traversals and ray sets, and what a device cannot run");
    addBenchTraversalCommand(*command);
    addBenchPaperCommand(*command);
    command->footer("Example:\n  build/metamarch bench --list");
    command->callback([command, list] {
        if (*list) {
            fmt::print("traversals: {}\nray sets: {}\n{}", fmt::join(traversals(), " "),
                       fmt::join(bench::raySetNames(), " "), notOffered());
        } else if (command->get_subcommands().empty()) {
            throw Error(ErrorKind::invalidArgument,
                        "bench: say what: traversal or paper, or --list (see `metamarch bench --help`)");
        }
    });
}

} // namespace metamarch::cli

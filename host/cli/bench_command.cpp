#include "cli/bench_command.h"

#include "bench/ray_set.h"
#include "cli/bench_paper_command.h"
#include "cli/bench_traversal_command.h"
#include "error.h"
#include "shader_library.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

namespace metamarch::cli {

void addBenchCommand(CLI::App& program) {
    CLI::App* command =
        program.add_subcommand("bench", "Measure traversals and repeat the paper's experiment");
    const auto list = std::make_shared<bool>(false);
    command->add_flag("--list", *list, "List traversals and ray sets");
    addBenchTraversalCommand(*command);
    addBenchPaperCommand(*command);
    command->footer("Example:\n  build/metamarch bench --list");
    command->callback([command, list] {
        if (*list) {
            fmt::print("traversals: {}\nray sets: {}\n", fmt::join(traversals(), " "),
                       fmt::join(bench::kRaySetNames, " "));
        } else if (command->get_subcommands().empty()) {
            throw Error(ExitCode::badArguments,
                        "bench: say what: traversal or paper, or --list (see `metamarch bench --help`)");
        }
    });
}

} // namespace metamarch::cli

// The program: parses the command line, runs one sub-command, turns every failure into one line and an exit
// code.
#include "metamarch/cli/bench_command.h"
#include "metamarch/cli/compare_command.h"
#include "metamarch/cli/devices_command.h"
#include "metamarch/cli/exit_code.h"
#include "metamarch/cli/info_command.h"
#include "metamarch/cli/nearest_word.h"
#include "metamarch/cli/render_command.h"
#include "metamarch/cli/version.h"
#include "metamarch/cli/view_command.h"
#include "metamarch/error/error.h"
#include "metamarch/vulkan/context.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <new>

namespace metamarch::cli {
namespace {

constexpr const char* kFooter = "Exit codes:\n"
                                "   0  done; for compare: within bounds\n"
                                "   1  compare: out of bounds\n"
                                "   2  bad arguments\n"
                                "   3  scene, picture or partition unreadable or refused\n"
                                "   4  no usable device, or device lost\n"
                                "   5  output not writable\n"
                                "   6  out of memory or over a limit\n"
                                "  70  internal error\n"
                                "Anything but 0 comes with one line on stderr.\n\n"
                                "Example:\n"
                                "  build/metamarch devices";

int report(const ExitCode code, const std::string& line) {
    fmt::print(stderr, "metamarch: {}\n", line);
    return static_cast<int>(code);
}

// "--tree-depth" of the library's "treeDepth".
std::string optionOf(const std::string& setting) {
    std::string option = "--";
    for (const char letter : setting) {
        if (letter >= 'A' && letter <= 'Z') {
            option += '-';
            option += static_cast<char>(letter - 'A' + 'a');
        } else {
            option += letter;
        }
    }
    return option;
}

int report(const Error& error) {
    std::vector<std::string> options;
    std::ranges::transform(error.settings, std::back_inserter(options), optionOf);
    return report(exitCodeOf(error.kind),
                  options.empty() ? error.what()
                                  : fmt::format("{} ({})", error.what(), fmt::join(options, ", ")));
}

std::vector<std::string> commandNames(const CLI::App& program) {
    std::vector<std::string> names;
    for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(command->get_name());
    return names;
}

std::vector<std::string> optionNames(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options())
        for (const std::string& name : option->get_lnames())
            names.push_back("--" + name);
    return names;
}

std::string suggestion(const std::string& word, const std::vector<std::string>& candidates) {
    const std::string nearest = nearestWord(word, candidates);
    return nearest.empty() ? "" : fmt::format("; did you mean `{}`?", nearest);
}

int reportUnknownWord(const CLI::App& program, const std::string& word) {
    if (word.starts_with('-'))
        return report(ExitCode::badArguments, fmt::format("unknown option `{}`{} (see `metamarch --help`)",
                                                          word, suggestion(word, optionNames(program))));
    const std::vector<std::string> names = commandNames(program);
    return report(ExitCode::badArguments,
                  fmt::format("unknown sub-command `{}`{} (see `metamarch --help`: {})", word,
                              suggestion(word, names), fmt::join(names, ", ")));
}

int reportBadArguments(const CLI::App& command, const CLI::ParseError& error) {
    std::string line = error.what();
    const std::vector<std::string> unexpected = command.remaining();
    if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr && !unexpected.empty())
        line = fmt::format("unknown argument `{}`{}", unexpected.front(),
                           suggestion(unexpected.front(), optionNames(command)));
    return report(ExitCode::badArguments, fmt::format("{}: {} (see `metamarch {} --help`)",
                                                      command.get_name(), line, command.get_name()));
}

int reportParseError(const CLI::App& program, const CLI::ParseError& error) {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) // --help or --version
        return program.exit(error);
    const std::vector<CLI::App*> commands = program.get_subcommands();
    if (!commands.empty())
        return reportBadArguments(*commands.front(), error);
    const std::vector<std::string> words = program.remaining();
    if (!words.empty())
        return reportUnknownWord(program, words.front());
    fmt::print("{}", program.help());
    return report(ExitCode::badArguments, "no sub-command given; see `metamarch SUBCOMMAND --help`");
}

int run(int argc, char** argv) {
    CLI::App program("Renders triangle scenes with Vulkan compute shaders.", "metamarch");
    program.set_version_flag("--version", versionText());
    program.require_subcommand(1);
    program.footer(kFooter);
    addRenderCommand(program);
    addViewCommand(program);
    addInfoCommand(program);
    addCompareCommand(program);
    addBenchCommand(program);
    addDevicesCommand(program);
    try {
        program.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return reportParseError(program, error);
    }
    return static_cast<int>(ExitCode::done);
}

// What sub-commands print stays in a buffer until here: a full disk may show only now.
void flushOutput() {
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
        throw Error(ErrorKind::outputNotWritable, "cannot write to standard output");
}

} // namespace
} // namespace metamarch::cli

int main(int argc, char** argv) {
    using namespace metamarch;
    try {
        const int code = cli::run(argc, argv);
        cli::flushOutput();
        // Validation is for developers, and a message a defect of the program.
        return vulkan::validationMessages() == 0
                   ? code
                   : cli::report(cli::ExitCode::internalError, "the validation layer complained; see above");
    } catch (const Error& error) {
        return cli::report(error);
    } catch (const std::bad_alloc&) {
        return cli::report(cli::ExitCode::outOfMemory, "out of memory");
    } catch (const std::exception& error) {
        return cli::report(cli::ExitCode::internalError, fmt::format("internal error: {}", error.what()));
    }
}

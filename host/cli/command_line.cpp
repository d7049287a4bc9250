// SPDX-License-Identifier: MIT
#include "metamarch/cli/command_line.h"

#include "metamarch/cli/nearest_word.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <iterator>

namespace metamarch::cli {
namespace {

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

// Sets the value. Where it is refused, the error names the option, unless it already names the file that the
// setting reads.
void assign(Setting& setting, const std::string& text) {
    try {
        setting.set(text);
    } catch (const Error& error) {
        if (!text.empty() && std::string_view(error.what()).starts_with(text + ": ")) {
            throw;
        }
        throw Error(error.kind, fmt::format("--{} {}: {}", setting.name(), text, error.what()));
    }
}

std::string optionNames(const Setting& setting) {
    if (setting.isPositional()) {
        return setting.name();
    }
    std::string names = setting.shortName().empty() ? "" : fmt::format("-{},", setting.shortName());
    names += "--" + setting.name();
    return setting.otherName().empty() ? names : fmt::format("{},--{}", names, setting.otherName());
}

std::string valueName(const Setting& setting) {
    if (!setting.valueName().empty() || setting.choices().empty()) {
        return setting.valueName();
    }
    return fmt::format("{}", fmt::join(setting.choices(), "|"));
}

bool showsDefault(const Setting& setting) {
    return setting.kind() != Setting::Kind::flag && !setting.defaultText().empty() &&
           setting.help().find("default") == std::string::npos;
}

void addSetting(CLI::App& app, Setting& setting) {
    CLI::Option* option = nullptr;
    if (setting.kind() == Setting::Kind::flag) {
        option = app.add_flag_callback(
            optionNames(setting), [&setting] { assign(setting, "on"); }, setting.help());
    } else {
        const bool isOne = setting.kind() != Setting::Kind::positionals;
        option = app.add_option(
            optionNames(setting),
            [&setting](const CLI::results_t& words) {
                for (const std::string& word : words) {
                    assign(setting, word);
                }
                return true;
            },
            setting.help());
        option->expected(1, isOne ? 1 : CLI::detail::expected_max_vector_size);
        option->type_name(valueName(setting));
    }
    option->required(setting.isRequired());
    if (!setting.group().empty()) {
        option->group(setting.group());
    }
    if (showsDefault(setting)) {
        option->default_str(setting.defaultText());
    }
}

// Throws Error(invalidArgument) where settings that were given exclude each other, or one lacks what it
// needs.
void checkTogether(const SettingList& list) {
    for (const Setting& setting : list.all()) {
        if (!setting.isGiven()) {
            continue;
        }
        for (const std::string& other : setting.excluded()) {
            if (list.at(other).isGiven()) {
                throw Error(ErrorKind::invalidArgument,
                            fmt::format("--{} and --{} exclude each other", setting.name(), other));
            }
        }
        for (const std::string& other : setting.needed()) {
            if (!list.at(other).isGiven()) {
                throw Error(ErrorKind::invalidArgument,
                            fmt::format("--{} needs --{}", setting.name(), other));
            }
        }
    }
}

void addCommand(CLI::App& parent, Command& command) {
    CLI::App* const app = parent.add_subcommand(command.name, command.summary);
    for (Setting& setting : command.settings.all()) {
        addSetting(*app, setting);
    }
    app->footer(command.footer);
    for (Command& nested : command.commands) {
        addCommand(*app, nested);
    }
    app->callback([&command, app] {
        checkTogether(command.settings);
        if (app->get_subcommands().empty()) {
            command.run(command.settings);
        }
    });
}

std::vector<std::string> commandNames(const CLI::App& program) {
    std::vector<std::string> names;
    for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; })) {
        names.push_back(command->get_name());
    }
    return names;
}

std::vector<std::string> optionNames(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames()) {
            names.push_back("--" + name);
        }
    }
    return names;
}

std::string suggestion(const std::string& word, const std::vector<std::string>& candidates) {
    const std::string nearest = nearestWord(word, candidates);
    return nearest.empty() ? "" : fmt::format("; did you mean `{}`?", nearest);
}

int reportUnknownWord(const CLI::App& program, const std::string& word) {
    if (word.starts_with('-')) {
        return report(ExitCode::badArguments, fmt::format("unknown option `{}`{} (see `metamarch --help`)",
                                                          word, suggestion(word, optionNames(program))));
    }
    const std::vector<std::string> names = commandNames(program);
    return report(ExitCode::badArguments,
                  fmt::format("unknown sub-command `{}`{} (see `metamarch --help`: {})", word,
                              suggestion(word, names), fmt::join(names, ", ")));
}

int reportBadArguments(const CLI::App& command, const CLI::ParseError& error) {
    std::string line = error.what();
    const std::vector<std::string> unexpected = command.remaining();
    if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr && !unexpected.empty()) {
        line = fmt::format("unknown argument `{}`{}", unexpected.front(),
                           suggestion(unexpected.front(), optionNames(command)));
    }
    return report(ExitCode::badArguments, fmt::format("{}: {} (see `metamarch {} --help`)",
                                                      command.get_name(), line, command.get_name()));
}

int reportParseError(const CLI::App& program, const CLI::ParseError& error) {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) { // --help or --version
        return program.exit(error);
    }
    const std::vector<CLI::App*> commands = program.get_subcommands();
    if (!commands.empty()) {
        return reportBadArguments(*commands.front(), error);
    }
    const std::vector<std::string> words = program.remaining();
    if (!words.empty()) {
        return reportUnknownWord(program, words.front());
    }
    fmt::print("{}", program.help());
    return report(ExitCode::badArguments, "no sub-command given; see `metamarch SUBCOMMAND --help`");
}

} // namespace

int runCommandLine(const int argc, const char* const* const argv, Command& program,
                   const std::string& version) {
    CLI::App app(program.summary, program.name);
    app.set_version_flag("--version", version);
    app.require_subcommand(1);
    app.footer(program.footer);
    for (Command& command : program.commands) {
        addCommand(app, command);
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return reportParseError(app, error);
    }
    return static_cast<int>(ExitCode::done);
}

int report(const ExitCode code, const std::string& line) {
    fmt::print(stderr, "metamarch: {}\n", line);
    return static_cast<int>(code);
}

int report(const Error& error) {
    std::vector<std::string> options;
    std::ranges::transform(error.settings, std::back_inserter(options), optionOf);
    return report(exitCodeOf(error.kind),
                  options.empty() ? std::string(error.what())
                                  : fmt::format("{} ({})", error.what(), fmt::join(options, ", ")));
}

} // namespace metamarch::cli

// SPDX-License-Identifier: MIT
#include "metamarch/cli/command_line.h"

#include "metamarch/cli/nearest_word.h"
#include "metamarch/cli/other_program_options.h"
#include "metamarch/file/standard_stream.h"
#include "metamarch/vulkan/refusal.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <exception>
#include <iterator>
#include <new>
#include <optional>
#include <sstream>
#include <system_error>

namespace metamarch::cli {
namespace {

constexpr std::size_t kHelpWidth = 100;
constexpr std::size_t kHelpColumn = 30; // where CLI11 begins the description of an option

// Breaks a line of help where it is wider than the page. The text of an option stays in its column.
std::string wrappedLine(std::string line) {
    const std::size_t blanks = std::min(line.find_first_not_of(' '), line.size());
    const std::string indent(blanks == 2 ? kHelpColumn : blanks, ' ');
    std::string text;
    while (line.size() > kHelpWidth) {
        std::size_t end = line.rfind(' ', kHelpWidth);
        std::size_t next = end + 1;
        if (end == std::string::npos || end <= indent.size()) { // a long list of choices has no blank
            end = next = line.rfind('|', kHelpWidth - 1) + 1;
        }
        if (end == 0 || end <= indent.size()) {
            break;
        }
        text += line.substr(0, end) + "\n";
        line.replace(0, next, indent);
    }
    return text + line;
}

std::string wrapped(const std::string& help) {
    std::string text;
    std::size_t begin = 0;
    while (begin < help.size()) {
        const std::size_t end = std::min(help.find('\n', begin), help.size());
        text += wrappedLine(help.substr(begin, end - begin)) + (end < help.size() ? "\n" : "");
        begin = end + 1;
    }
    return text;
}

// Returns "--tree-depth" for the library's "treeDepth".
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

std::string spelled(const std::string& setting) { return "--" + setting; }

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
            optionNames(setting), [&setting] { give(setting, "on", spelled); }, setting.help());
    } else {
        const bool isOne = setting.kind() != Setting::Kind::positionals;
        option = app.add_option(
            optionNames(setting),
            [&setting](const CLI::results_t& words) {
                for (const std::string& word : words) {
                    give(setting, word, spelled);
                }
                return true;
            },
            setting.help());
        option->expected(1, isOne ? 1 : CLI::detail::expected_max_vector_size);
        option->allow_extra_args(!isOne);
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
        command.settings.checkTogether(spelled);
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

bool contains(const std::vector<std::string>& words, const std::string_view word) {
    return std::ranges::find(words, word) != words.end();
}

// Returns what to say after an unknown word: its name in this program if another program has the word,
// otherwise the nearest candidate.
std::string suggestion(const std::string& word, const std::vector<std::string>& candidates) {
    const std::string_view answer = word.starts_with('-') ? answerTo(word) : std::string_view();
    if (answer.starts_with("`--")) {
        if (contains(candidates, answer.substr(1, answer.find_first_of(" `", 1) - 1))) {
            return fmt::format("; did you mean {}?", answer);
        }
    } else if (!answer.empty()) {
        return fmt::format("; {}", answer);
    }
    const std::string nearest = nearestWord(word.substr(0, word.find('=')), candidates);
    return nearest.empty() ? "" : fmt::format("; did you mean `{}`?", nearest);
}

// Returns the first option among the words, or the first word if there is no option.
std::string firstUnknown(const std::vector<std::string>& words) {
    const auto option =
        std::ranges::find_if(words, [](const std::string& word) { return word.starts_with('-'); });
    return option == words.end() ? words.front() : *option;
}

// Says that files stand where a sub-command is wanted. Most users want a picture then.
int reportNoCommand(const std::vector<std::string>& words) {
    return report(
        ExitCode::badArguments,
        fmt::format("no sub-command given; did you mean `metamarch render {}`? (see `metamarch --help`)",
                    fmt::join(words, " ")));
}

int reportUnknownWord(const CLI::App& program, const std::vector<std::string>& words) {
    const auto isFile = [](const std::string& word) {
        return !word.starts_with('-') && word.find('.') != std::string::npos;
    };
    if (std::ranges::any_of(words, isFile)) {
        return reportNoCommand(words);
    }
    const std::string& word = words.front();
    if (word.starts_with('-')) {
        const std::string meant = word == "-v" ? "-V" : word; // among sub-commands it is --verbose
        return report(ExitCode::badArguments, fmt::format("unknown option `{}`{} (see `metamarch --help`)",
                                                          word, suggestion(meant, optionNames(program))));
    }
    std::vector<std::string> names = commandNames(program);
    const std::string list = fmt::format("{}", fmt::join(names, ", "));
    const std::string asOption = "--" + word; // help, version
    const std::string hint = contains(optionNames(program), asOption)
                                 ? fmt::format("; did you mean `{}`?", asOption)
                                 : suggestion(word, names);
    return report(ExitCode::badArguments,
                  fmt::format("unknown sub-command `{}`{} (see `metamarch --help`: {})", word, hint, list));
}

// Returns the innermost sub-command that was given.
const CLI::App& innermost(const CLI::App& command) {
    const std::vector<CLI::App*> nested = command.get_subcommands();
    return nested.empty() ? command : innermost(*nested.front());
}

int reportBadArguments(const CLI::App& command, const CLI::ParseError& error) {
    std::string line = error.what();
    if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr &&
        line.find(": At Most") != std::string::npos) {
        line = line.substr(0, line.find(':')) + " is given more than once";
    }
    const CLI::App& meant = innermost(command);
    std::vector<std::string> unknown = meant.remaining();
    if (unknown.empty()) {
        unknown = command.remaining();
    }
    // If a required option is misspelt, CLI11 reports the required one. The misspelt one says more.
    const bool isAboutWords = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr ||
                              dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
    if (isAboutWords && !unknown.empty()) {
        const std::string word = firstUnknown(unknown);
        line = fmt::format("unknown argument `{}`{}", word, suggestion(word, optionNames(meant)));
    }
    return report(ExitCode::badArguments, fmt::format("{}: {} (see `metamarch {} --help`)",
                                                      command.get_name(), line, command.get_name()));
}

int reportParseError(const CLI::App& program, const CLI::ParseError& error) {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) { // --help or --version
        std::ostringstream text;
        const int code = program.exit(error, text, text);
        printResult(wrapped(text.str()));
        return code;
    }
    const std::vector<CLI::App*> commands = program.get_subcommands();
    if (!commands.empty()) {
        return reportBadArguments(*commands.front(), error);
    }
    const std::vector<std::string> words = program.remaining();
    if (!words.empty()) {
        return reportUnknownWord(program, words);
    }
    printResult(wrapped(program.help()));
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
    printError(fmt::format("metamarch: {}\n", line));
    return static_cast<int>(code);
}

int report(const Error& error) {
    std::vector<std::string> options;
    std::ranges::transform(error.settings, std::back_inserter(options), optionOf);
    return report(exitCodeOf(error.kind),
                  options.empty() ? std::string(error.what())
                                  : fmt::format("{} ({})", error.what(), fmt::join(options, ", ")));
}

int reportCurrentException() {
    const std::exception_ptr current = std::current_exception();
    if (current == nullptr) {
        return report(ExitCode::internalError, "internal error");
    }
    try {
        std::rethrow_exception(current);
    } catch (const Error& error) {
        return report(error);
    } catch (const std::bad_alloc&) {
        return report(ExitCode::outOfMemory, "out of memory");
    } catch (const std::system_error& error) {
        if (const std::optional<Error> refusal = vulkan::refusalOf(error, "Vulkan")) {
            return report(*refusal);
        }
        if (error.code() == std::errc::resource_unavailable_try_again) {
            return report(ExitCode::outOfMemory, "the system allows no more threads (see `ulimit -u`)");
        }
        return report(ExitCode::internalError, fmt::format("internal error: {}", error.what()));
    } catch (const std::exception& error) {
        return report(ExitCode::internalError, fmt::format("internal error: {}", error.what()));
    } catch (...) {
        return report(ExitCode::internalError, "internal error");
    }
}

} // namespace metamarch::cli

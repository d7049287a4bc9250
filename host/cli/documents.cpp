// SPDX-License-Identifier: MIT
#include "metamarch/cli/documents.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

namespace metamarch::cli {
namespace {

// Text as roff prints it: a backslash and a hyphen stand for themselves, and no line begins with a control
// character.
std::string roff(const std::string& text) {
    std::string escaped;
    for (const char letter : text) {
        const bool isLineStart = escaped.empty() || escaped.back() == '\n';
        if (isLineStart && (letter == '.' || letter == '\'')) {
            escaped += "\\&";
        }
        escaped += letter == '\\' ? "\\e" : letter == '-' ? "\\-" : std::string(1, letter);
    }
    return escaped;
}

std::string valueOf(const Setting& setting) {
    if (setting.kind() == Setting::Kind::flag) {
        return "";
    }
    return !setting.valueName().empty() || setting.choices().empty()
               ? setting.valueName()
               : fmt::format("{}", fmt::join(setting.choices(), "|"));
}

std::string entryOf(const Setting& setting) {
    std::string names;
    if (setting.isPositional()) {
        names = fmt::format("\\fI{}\\fR", roff(setting.name()));
    } else {
        names = setting.shortName().empty() ? "" : fmt::format("\\fB\\-{}\\fR, ", setting.shortName());
        names += fmt::format("\\fB\\-\\-{}\\fR", roff(setting.name()));
        if (const std::string value = valueOf(setting); !value.empty()) {
            names += fmt::format(" \\fI{}\\fR", roff(value));
        }
    }
    std::string entry = fmt::format(".TP\n{}\n{}", names, roff(setting.help()));
    if (setting.kind() == Setting::Kind::value && !setting.defaultText().empty() &&
        setting.help().find("default") == std::string::npos) {
        entry += fmt::format(" (default {})", roff(setting.defaultText()));
    }
    return entry + "\n";
}

std::string literal(const std::string& text) {
    return text.empty() ? "" : fmt::format(".PP\n.nf\n{}\n.fi\n", roff(text));
}

std::string sectionOf(const Command& command, const std::string& before) {
    const std::string name = before + command.name;
    std::string section =
        fmt::format(".SH {}\n.B metamarch {}\n.PP\n{}.\n", roff(name), roff(name), roff(command.summary));
    std::string group;
    for (const Setting& setting : command.settings.all()) {
        if (!setting.isPositional() && setting.group() != group) {
            group = setting.group();
            section += fmt::format(".SS {}\n", roff(group));
        }
        section += entryOf(setting);
    }
    section += literal(command.footer);
    for (const Command& nested : command.commands) {
        section += sectionOf(nested, name + " ");
    }
    return section;
}

std::vector<std::string> wordsOf(const Command& command) {
    std::vector<std::string> words;
    words.reserve(command.commands.size() + command.settings.all().size());
    for (const Command& nested : command.commands) {
        words.push_back(nested.name);
    }
    for (const Setting& setting : command.settings.all()) {
        if (!setting.isPositional()) {
            words.push_back("--" + setting.name());
        }
    }
    words.emplace_back("--help");
    return words;
}

// Appends the branches for a command and those in it. `path` has its name, after those of the commands around
// it.
void addBranches(const Command& command, const std::string& path, std::string& words, std::string& values) {
    words += fmt::format("        '{}') words='{}{}' ;;\n", path, fmt::join(wordsOf(command), " "),
                         path.empty() ? " --version" : "");
    for (const Setting& setting : command.settings.all()) {
        if (setting.isPositional() || setting.kind() == Setting::Kind::flag) {
            continue;
        }
        const std::string option =
            setting.shortName().empty()
                ? fmt::format("'{} --{}'", path, setting.name())
                : fmt::format("'{} --{}' | '{} -{}'", path, setting.name(), path, setting.shortName());
        values += fmt::format("        {}) values='{}' ;;\n", option, fmt::join(setting.choices(), " "));
    }
    for (const Command& nested : command.commands) {
        addBranches(nested, path.empty() ? nested.name : path + " " + nested.name, words, values);
    }
}

} // namespace

std::string manualPage(const Command& program, const std::string& version) {
    std::string page =
        fmt::format(".TH METAMARCH 1 \"\" \"{}\"\n.SH NAME\nmetamarch \\- {}\n"
                    ".SH SYNOPSIS\n.B metamarch\n\\fISUBCOMMAND\\fR [\\fIOPTION\\fR]...\n"
                    ".SH DESCRIPTION\n{}\nEach sub\\-command has a section below, and an "
                    "option \\fB\\-\\-help\\fR.\n{}",
                    roff(version), roff(program.summary), roff(program.summary), literal(program.footer));
    for (const Command& command : program.commands) {
        page += sectionOf(command, "");
    }
    return page;
}

std::string bashCompletion(const Command& program) {
    std::string words;
    std::string values;
    addBranches(program, "", words, values);
    std::vector<std::string> paths;
    for (const Command& command : program.commands) {
        paths.push_back("'" + command.name + "'");
        for (const Command& nested : command.commands) {
            paths.push_back("'" + command.name + " " + nested.name + "'");
        }
    }
    return fmt::format(R"(# SPDX-License-Identifier: MIT
# Completes the words of metamarch in bash. The program's declarations wrote this file.
_metamarch() {{
    local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}} command= words= values=none i
    for ((i = 1; i < COMP_CWORD; i++)); do
        case "${{command:+$command }}${{COMP_WORDS[i]}}" in
        {}) command="${{command:+$command }}${{COMP_WORDS[i]}}" ;;
        esac
    done
    case "$command" in
{}    esac
    case "$command $before" in
{}    esac
    if [ "$values" != none ]; then
        words=$values
    elif [ -n "$command" ] && [[ $word != -* ]] && [ "$command" != bench ]; then
        words=
    fi
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
}}
complete -o bashdefault -o default -F _metamarch metamarch
)",
                       fmt::join(paths, " | "), words, values);
}

} // namespace metamarch::cli

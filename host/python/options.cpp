// SPDX-License-Identifier: MIT
#include "metamarch/python/options.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace metamarch::python {
namespace {

// These belong to a program that ends with its picture.
constexpr std::string_view kOfTheProgram[] = {"output",   "stats",       "quiet",   "verbose",    "threads",
                                              "progress", "write-every", "samples", "checkpoint", "resume"};

template <class Declare>
std::vector<std::string> declared(const Declare& declare) {
    SettingList list;
    declare(list);
    std::vector<std::string> names;
    for (const Setting& setting : list.all()) {
        names.push_back(setting.name());
    }
    return names;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::ranges::find(names, name) != names.end();
}

std::array<std::vector<std::string>, 3> settingsOfCalls() {
    cli::RenderOptions options;
    const std::vector<std::string> load = declared([&](SettingList& list) {
        declareImport(list, options.import);
        declareStructure(list, options.structure);
    });
    std::vector<std::string> save = declared([&](SettingList& list) {
        declareStorage(list, options.storage);
        declareTone(list, options.tone);
    });
    save.emplace_back("stamp");
    std::array<std::vector<std::string>, 3> calls;
    const Choice all;
    for (const Setting& setting : all.settings.all()) {
        const std::string& name = setting.name();
        if (setting.isPositional() || std::ranges::find(kOfTheProgram, name) != std::end(kOfTheProgram)) {
            continue;
        }
        const Call call = contains(load, name)   ? Call::load
                          : contains(save, name) ? Call::save
                                                 : Call::render;
        calls[static_cast<std::size_t>(call)].push_back(name);
    }
    return calls;
}

} // namespace

std::string spelled(const std::string& setting) {
    std::string name;
    for (const char letter : setting) {
        if (std::isupper(static_cast<unsigned char>(letter)) != 0) {
            name += '_';
        }
        name += letter == '-' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    }
    return name;
}

void Choice::take(const Words& words) {
    for (const auto& [name, text] : words) {
        give(settings.at(name), text, spelled);
    }
}

void Choice::check() const {
    settings.checkTogether(spelled);
    cli::checkArguments(options);
}

const std::vector<std::string>& settingsOf(const Call call) {
    static const std::array<std::vector<std::string>, 3> kCalls = settingsOfCalls();
    return kCalls[static_cast<std::size_t>(call)];
}

} // namespace metamarch::python

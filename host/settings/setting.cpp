// SPDX-License-Identifier: MIT
#include "metamarch/settings/setting.h"

#include "metamarch/settings/number_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace metamarch {
namespace {

template <class T>
std::string textOf(const std::optional<T>& value) {
    return value ? fmt::format("{}", *value) : "";
}

std::string listText(const std::vector<std::string>& names) {
    if (names.size() < 2) {
        return fmt::format("{}", fmt::join(names, ""));
    }
    return fmt::format("{} or {}", fmt::join(names.begin(), names.end() - 1, ", "), names.back());
}

std::vector<std::string> splitAtCommas(const std::string& text) {
    std::vector<std::string> words;
    std::size_t start = 0;
    while (true) {
        const std::size_t comma = text.find(',', start);
        words.push_back(text.substr(start, comma - start));
        if (comma == std::string::npos) {
            return words;
        }
        start = comma + 1;
    }
}

template <class Settings>
auto& settingNamed(Settings& settings, const std::string_view name) {
    const auto found = std::ranges::find(settings, name, &Setting::name);
    if (found == settings.end()) {
        throw std::out_of_range("no setting " + std::string(name));
    }
    return *found;
}

// Returns the value quoted as a shell wants it.
std::string shellWord(const std::string& value) {
    if (value.find_first_of(" \t'\"$&;|<>()*?[]`\\") == std::string::npos) {
        return value;
    }
    std::string word = "'";
    for (const char letter : value) {
        word += letter == '\'' ? "'\\''" : std::string(1, letter);
    }
    return word + "'";
}

} // namespace

Setting::Setting(std::string settingName, const Kind settingKind, Access valueAccess, std::string helpText)
    : name_(std::move(settingName)), kind_(settingKind), access(std::move(valueAccess)),
      help_(std::move(helpText)), defaultText_(access.text()) {}

void Setting::set(const std::string& text) {
    if (!choices_.empty()) {
        const std::vector<std::string> words =
            kind_ == Kind::list ? splitAtCommas(text) : std::vector<std::string>{text};
        for (const std::string& word : words) {
            if (std::ranges::find(choices_, word) == choices_.end()) {
                throw Error(ErrorKind::invalidArgument, "give " + listText(choices_));
            }
        }
    }
    access.set(text);
    isGiven_ = true;
}

Setting& Setting::inGroup(const std::string& groupName) {
    group_ = groupName;
    return *this;
}
Setting& Setting::withValueName(const std::string& placeholder) {
    valueName_ = placeholder;
    return *this;
}
Setting& Setting::withShortName(const std::string& letter) {
    shortName_ = letter;
    return *this;
}
Setting& Setting::withOtherName(const std::string& otherName) {
    otherName_ = otherName;
    return *this;
}
Setting& Setting::oneOf(std::vector<std::string> names) {
    choices_ = std::move(names);
    return *this;
}
Setting& Setting::excludes(std::vector<std::string> others) {
    excluded_ = std::move(others);
    return *this;
}
Setting& Setting::needs(std::vector<std::string> others) {
    needed_ = std::move(others);
    return *this;
}
Setting& Setting::required() {
    isRequired_ = true;
    return *this;
}
Setting& Setting::optional() {
    isRequired_ = false;
    return *this;
}
Setting& Setting::slides(const Slider& range) {
    slider_ = range;
    return *this;
}

void give(Setting& setting, const std::string& text, const Spelling& spelling) {
    try {
        setting.set(text);
    } catch (const Error& error) {
        if (!text.empty() && std::string_view(error.what()).starts_with(text + ": ")) {
            throw;
        }
        throw Error(error.kind, fmt::format("{} {}: {}", spelling(setting.name()), text, error.what()));
    }
}

Setting& SettingList::add(const std::string& name, const Setting::Kind kind, Setting::Access access,
                          const std::string& help) {
    return settings.emplace_back(name, kind, std::move(access), help).inGroup(group);
}

Setting& SettingList::flag(const std::string& name, bool& value, const std::string& help) {
    return add(name, Setting::Kind::flag,
               {[&value](const std::string& text) { value = text != "off"; },
                [&value] { return std::string(value ? "on" : "off"); }},
               help);
}

Setting& SettingList::flagOff(const std::string& name, bool& value, const std::string& help) {
    return add(name, Setting::Kind::flag,
               {[&value](const std::string& text) { value = text == "off"; },
                [&value] { return std::string(value ? "off" : "on"); }},
               help);
}

Setting& SettingList::number(const std::string& name, double& value, const NumberRange& range,
                             const std::string& help) {
    return add(name, Setting::Kind::value,
               {[&value, range](const std::string& text) { value = parseNumber(text, range); },
                [&value] { return fmt::format("{}", value); }},
               help);
}

Setting& SettingList::number(const std::string& name, float& value, const NumberRange& range,
                             const std::string& help) {
    return add(name, Setting::Kind::value,
               {[&value, range](const std::string& text) { value = parseFloat(text, range); },
                [&value] { return fmt::format("{}", value); }},
               help);
}

Setting& SettingList::number(const std::string& name, std::optional<double>& value, const NumberRange& range,
                             const std::string& help) {
    return add(name, Setting::Kind::value,
               {[&value, range](const std::string& text) { value = parseNumber(text, range); },
                [&value] { return textOf(value); }},
               help);
}

Setting& SettingList::number(const std::string& name, std::optional<float>& value, const NumberRange& range,
                             const std::string& help) {
    return add(name, Setting::Kind::value,
               {[&value, range](const std::string& text) { value = parseFloat(text, range); },
                [&value] { return textOf(value); }},
               help);
}

Setting& SettingList::angle(const std::string& name, float& radians, const NumberRange& degrees,
                            const std::string& help) {
    const auto radiansOf = [degrees](const std::string& text) {
        const double turn = std::fmod(parseNumber(text, degrees), 360.0);
        return static_cast<float>(turn * std::numbers::pi / 180.0);
    };
    return add(name, Setting::Kind::value,
               {[&radians, radiansOf](const std::string& text) { radians = radiansOf(text); },
                [&radians, radiansOf] {
                    const double turn = static_cast<double>(radians) * 180.0 / std::numbers::pi;
                    return shortestText(
                        [&](const int digits) { return fmt::format("{:.{}g}", turn, digits); },
                        [&](const std::string& text) { return radiansOf(text) == radians; });
                }},
               help)
        .withValueName("DEG");
}

Setting& SettingList::count(const std::string& name, std::uint32_t& value, const std::uint32_t least,
                            const std::uint32_t most, const std::string& help) {
    return add(name, Setting::Kind::value,
               {[&value, least, most](const std::string& text) { value = parseCount(text, least, most); },
                [&value] { return fmt::format("{}", value); }},
               help)
        .withValueName("N");
}

Setting& SettingList::count(const std::string& name, std::optional<std::uint32_t>& value,
                            const std::uint32_t least, const std::uint32_t most, const std::string& help) {
    return add(name, Setting::Kind::value,
               {[&value, least, most](const std::string& text) { value = parseCount(text, least, most); },
                [&value] { return textOf(value); }},
               help)
        .withValueName("N");
}

Setting& SettingList::text(const std::string& name, std::string& value, const std::string& help) {
    return add(name, Setting::Kind::value,
               {[&value](const std::string& given) { value = given; }, [&value] { return value; }}, help);
}

Setting& SettingList::file(const std::string& name, std::filesystem::path& value, const std::string& help) {
    return add(name, Setting::Kind::value,
               {[&value](const std::string& given) { value = given; }, [&value] { return value.string(); }},
               help)
        .withValueName("FILE");
}

Setting& SettingList::point(const std::string& name, std::optional<glm::vec3>& value,
                            const std::string& help) {
    return add(name, Setting::Kind::value,
               {[&value](const std::string& text) { value = glm::vec3(parsePoint(text)); },
                [&value] { return value ? fmt::format("{},{},{}", value->x, value->y, value->z) : ""; }},
               help)
        .withValueName("x,y,z");
}

Setting& SettingList::size(const std::string& name, glm::uvec2& value, const std::string& help) {
    return add(name, Setting::Kind::value,
               {[&value](const std::string& text) { value = parseSize(text); },
                [&value] { return fmt::format("{}x{}", value.x, value.y); }},
               help)
        .withValueName("WxH");
}

Setting& SettingList::word(const std::string& name, std::string& value, std::vector<std::string> names,
                           const std::string& help) {
    return text(name, value, help).oneOf(std::move(names));
}

Setting& SettingList::words(const std::string& name, std::vector<std::string>& value,
                            const std::string& help) {
    return add(name, Setting::Kind::list,
               {[&value](const std::string& text) { value = splitAtCommas(text); },
                [&value] { return fmt::format("{}", fmt::join(value, ",")); }},
               help);
}

Setting& SettingList::positional(const std::string& name, std::string& value, const std::string& help) {
    return add(name, Setting::Kind::positional,
               {[&value](const std::string& given) { value = given; }, [&value] { return value; }}, help)
        .required();
}

Setting& SettingList::positionals(const std::string& name, std::vector<std::string>& value,
                                  const std::string& help) {
    return add(name, Setting::Kind::positionals,
               {[&value](const std::string& given) { value.push_back(given); },
                [&value] { return fmt::format("{}", fmt::join(value, " ")); }},
               help)
        .required();
}

Setting& SettingList::at(const std::string_view name) { return settingNamed(settings, name); }
const Setting& SettingList::at(const std::string_view name) const { return settingNamed(settings, name); }

void SettingList::checkTogether(const Spelling& spelling) const {
    for (const Setting& setting : settings) {
        if (!setting.isGiven()) {
            continue;
        }
        for (const std::string& other : setting.excluded()) {
            if (at(other).isGiven()) {
                throw Error(
                    ErrorKind::invalidArgument,
                    fmt::format("{} and {} exclude each other", spelling(setting.name()), spelling(other)));
            }
        }
        for (const std::string& other : setting.needed()) {
            if (!at(other).isGiven()) {
                throw Error(ErrorKind::invalidArgument,
                            fmt::format("{} needs {}", spelling(setting.name()), spelling(other)));
            }
        }
    }
}

std::string SettingList::changedText(const std::span<const std::string_view> without) const {
    std::string text;
    for (const Setting& setting : settings) {
        if (setting.isPositional() || !setting.isChanged() ||
            std::ranges::find(without, setting.name()) != without.end()) {
            continue;
        }
        text += fmt::format("{}--{}", text.empty() ? "" : " ", setting.name());
        if (setting.kind() != Setting::Kind::flag) {
            text += ' ' + shellWord(setting.text());
        }
    }
    return text;
}

} // namespace metamarch

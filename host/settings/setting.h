// SPDX-License-Identifier: MIT
// One declaration of each value that a user may set. The command line, its help, the viewer's panel, the
// statistics and the headers of pictures all read the same list of them.
#pragma once
#include "metamarch/error/error.h"
#include "metamarch/settings/number_text.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace metamarch {

// The part of a number's range that a slider in a panel covers.
struct Slider {
    double least;
    double most;
    const char* format = "%.2f"; // of printf
    bool isLogarithmic = false;
    bool isWhole = false; // whole numbers only
};

class Setting {
  public:
    // How the setting writes and reads its variable. `set` takes a value as text. It throws
    // Error(invalidArgument), saying what to give instead: "give a finite number". `text` returns the value
    // as text, and "" if nothing is chosen.
    struct Access {
        std::function<void(const std::string&)> set;
        std::function<std::string()> text;
    };

    enum class Kind { flag, value, list, positional, positionals };

    Setting(std::string settingName, Kind settingKind, Access valueAccess, std::string helpText);

    const std::string& name() const { return name_; } // words with hyphens between: "max-bounces"
    Kind kind() const { return kind_; }
    bool isPositional() const { return kind_ == Kind::positional || kind_ == Kind::positionals; }
    const std::string& help() const { return help_; }
    const std::string& group() const { return group_; }
    const std::string& valueName() const { return valueName_; }
    const std::string& shortName() const { return shortName_; }
    const std::string& otherName() const { return otherName_; }
    const std::vector<std::string>& choices() const { return choices_; }
    const std::vector<std::string>& excluded() const { return excluded_; }
    const std::vector<std::string>& needed() const { return needed_; }
    bool isRequired() const { return isRequired_; }
    const std::optional<Slider>& slider() const { return slider_; }

    void set(const std::string& text);
    std::string text() const { return access.text(); }
    const std::string& defaultText() const { return defaultText_; }
    bool isChanged() const { return text() != defaultText_; } // since its declaration
    bool isGiven() const { return isGiven_; }                 // set() was called

    // These complete the declaration.
    Setting& inGroup(const std::string& groupName);
    Setting& withValueName(const std::string& placeholder); // the value's name in the help: "DEG"
    Setting& withShortName(const std::string& letter);      // "o" for -o
    Setting& withOtherName(const std::string& otherName);   // a second name that users expect
    Setting& oneOf(std::vector<std::string> names);         // other values are refused
    Setting& excludes(std::vector<std::string> others);
    Setting& needs(std::vector<std::string> others); // all of them
    Setting& required();
    Setting& optional(); // a positional that may be left out
    Setting& slides(const Slider& range);

  private:
    std::string name_;
    Kind kind_;
    Access access;
    std::string help_;
    std::string group_;
    std::string valueName_;
    std::string shortName_;
    std::string otherName_;
    std::vector<std::string> choices_;
    std::vector<std::string> excluded_;
    std::vector<std::string> needed_;
    bool isRequired_ = false;
    std::optional<Slider> slider_;
    std::string defaultText_;
    bool isGiven_ = false;
};

// How a front end writes the name of a setting: "--max-bounces".
using Spelling = std::function<std::string(const std::string& name)>;

// Sets the value. A refusal names the setting and the text, unless it already begins with the text: the name
// of a file that the setting reads.
void give(Setting& setting, const std::string& text, const Spelling& spelling);

// Settings in the order of their declaration. They refer to the variables that they set, which must outlive
// the list and must not move.
class SettingList {
  public:
    // Puts the settings that are declared from now on into a group.
    void beginGroup(const std::string& name) { group = name; }

    Setting& flag(const std::string& name, bool& value, const std::string& help);
    // Declares a flag that turns the variable off.
    Setting& flagOff(const std::string& name, bool& value, const std::string& help);

    Setting& number(const std::string& name, double& value, const NumberRange& range,
                    const std::string& help);
    Setting& number(const std::string& name, float& value, const NumberRange& range, const std::string& help);
    Setting& number(const std::string& name, std::optional<double>& value, const NumberRange& range,
                    const std::string& help);
    Setting& number(const std::string& name, std::optional<float>& value, const NumberRange& range,
                    const std::string& help);
    // The user gives degrees; `radians` holds radians.
    Setting& angle(const std::string& name, float& radians, const NumberRange& degrees,
                   const std::string& help);

    // A whole number of [least, most].
    Setting& count(const std::string& name, std::uint32_t& value, std::uint32_t least, std::uint32_t most,
                   const std::string& help);
    Setting& count(const std::string& name, std::optional<std::uint32_t>& value, std::uint32_t least,
                   std::uint32_t most, const std::string& help);

    Setting& text(const std::string& name, std::string& value, const std::string& help);
    Setting& file(const std::string& name, std::filesystem::path& value, const std::string& help);
    Setting& point(const std::string& name, std::optional<glm::vec3>& value,
                   const std::string& help);                                            // x,y,z
    Setting& size(const std::string& name, glm::uvec2& value, const std::string& help); // WxH

    // `names` is an array of pairs of a name and a value. It outlives the list.
    template <class T, class Names>
    Setting& choice(const std::string& name, T& value, const Names& names, const std::string& help) {
        std::vector<std::string> words;
        for (const auto& [word, meaning] : names) {
            words.emplace_back(word);
        }
        return add(name, Setting::Kind::value,
                   {[&value, &names](const std::string& given) {
                        for (const auto& [word, meaning] : names) {
                            value = word == given ? meaning : value;
                        }
                    },
                    [&value, &names] {
                        std::string text;
                        for (const auto& [word, meaning] : names) {
                            text = meaning == value ? std::string(word) : text;
                        }
                        return text;
                    }},
                   help)
            .oneOf(std::move(words));
    }

    // The value is one of `names`, or empty if none is chosen.
    Setting& word(const std::string& name, std::string& value, std::vector<std::string> names,
                  const std::string& help);
    // The value is a list of words, with commas between them. oneOf() restricts the words.
    Setting& words(const std::string& name, std::vector<std::string>& value, const std::string& help);

    Setting& positional(const std::string& name, std::string& value, const std::string& help);
    Setting& positionals(const std::string& name, std::vector<std::string>& value, const std::string& help);

    // Declares a setting of any other kind: see Setting::Access.
    Setting& add(const std::string& name, Setting::Kind kind, Setting::Access access,
                 const std::string& help);

    std::list<Setting>& all() { return settings; }
    const std::list<Setting>& all() const { return settings; }
    Setting& at(std::string_view name); // throws std::out_of_range
    const Setting& at(std::string_view name) const;

    // Throws Error(invalidArgument) if settings that were given exclude each other, or if one lacks what it
    // needs.
    void checkTogether(const Spelling& spelling) const;

    // Returns the settings that differ from their defaults as the command line takes them: "--max-bounces 2
    // --sky". Leaves out positionals and the names in `without`.
    std::string changedText(std::span<const std::string_view> without = {}) const;

  private:
    std::list<Setting> settings; // a list: references stay good
    std::string group;
};

} // namespace metamarch

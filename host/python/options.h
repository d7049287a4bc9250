// SPDX-License-Identifier: MIT
// What a caller in Python gives by keyword: the settings of `metamarch render`, from their one declaration. A
// setting has its own name with underscores: max_bounces.
#pragma once
#include "metamarch/cli/render_options.h"
#include "metamarch/settings/setting.h"

#include <string>
#include <utility>
#include <vector>

namespace metamarch::python {

// The call that takes a setting.
enum class Call { load, render, save };

// Settings by their names in the declaration, with their values as text.
using Words = std::vector<std::pair<std::string, std::string>>;

std::string spelled(const std::string& setting); // "max_bounces" for "max-bounces" and for "maxBounces"

// The options of a render with the settings that set them.
struct Choice {
    Choice() { cli::declareRender(settings, options); }
    Choice(const Choice&) = delete; // the settings refer to the options
    Choice& operator=(const Choice&) = delete;

    // Throws Error(invalidArgument).
    void take(const Words& words);
    // Throws Error(invalidArgument) for settings that do not go together.
    void check() const;

    cli::RenderOptions options;
    SettingList settings;
};

// Returns the names in the declaration of the settings that the call takes, in their order. No call takes
// what belongs to a process, such as the threads, or to a file of sums.
const std::vector<std::string>& settingsOf(Call call);

} // namespace metamarch::python

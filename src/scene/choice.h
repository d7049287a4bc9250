// SPDX-License-Identifier: MIT
// Finds what the user selects, by name or index, among the elements of a scene or a file.
#pragma once
#include <string>
#include <vector>

namespace metamarch {

// Returns `selection` as an index, or the index of the first of `names` that equals it. Throws
// Error(invalidArgument) for anything else: "there is no camera side; the scene has 0 'front', 1 'top'",
// where `kind` is "camera" and `owner`, which has the names, is "scene".
std::size_t chooseIndex(const std::string& kind, const std::vector<std::string>& names,
                        const std::string& selection, const std::string& owner = "file");

} // namespace metamarch

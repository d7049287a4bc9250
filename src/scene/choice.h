// What the user asks for by name or place among what a scene has.
#pragma once
#include <string>
#include <vector>

namespace metamarch {

// The index that `selection` is, or of the first of `names` that equals it. Throws Error(invalidArgument),
// "there is no camera side; the scene has 0 'front', 1 'top'", for anything else; `kind` is "camera".
std::size_t chooseIndex(const std::string& kind, const std::vector<std::string>& names,
                        const std::string& selection);

} // namespace metamarch

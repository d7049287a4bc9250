// Which glTF extensions a file may require of us.
#pragma once
#include <string>

namespace metamarch {

// True for extensions that are read, and for those that say nothing of the scene.
bool isSupportedExtension(const std::string& name);

} // namespace metamarch

// Which glTF extensions a file may require of us.
#pragma once
#include <string>

namespace metamarch {

// True for extensions that are read, and for those about looks alone, which leave the geometry right when
// they are not.
bool isSupportedExtension(const std::string& name);

} // namespace metamarch

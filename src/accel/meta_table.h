// The meta table: for every cell of the lattice the leaf it belongs to.
#pragma once
#include "shared/scene_layout.h"

#include <cstdint>
#include <span>
#include <vector>

namespace metamarch {

// [cellIndex] -> leaf id, for leaves that tile the lattice.
std::vector<std::uint32_t> buildMetaTable(const Lattice& lattice, std::span<const Leaf> leaves);

} // namespace metamarch

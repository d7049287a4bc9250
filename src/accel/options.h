// What a user may ask of tree and table.
#pragma once
#include <glm/glm.hpp>

#include <cstdint>
#include <optional>

namespace metamarch {

struct AccelerationOptions {
    std::optional<glm::dvec3> unit; // unit length of the lattice per axis, in scene units; > 0
    std::optional<std::uint64_t>
        cells; // wanted number of cells, where no unit is given; the lattice has about as many
    std::optional<unsigned> treeDepth; // 0..kMaxTreeDepth
};

// The paper's setting: kd-tree depth 16.
inline constexpr unsigned kPaperTreeDepth = 16;

} // namespace metamarch

// SPDX-License-Identifier: MIT
// The list of twins against the list of traversals, whatever the order of either.
#include "metamarch/accel/structure.h"
#include "metamarch/reference/twins.h"
#include "metamarch/shaders/shader_library.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace metamarch::tests {
namespace {

using Names = std::multiset<std::string_view>;

TEST(Twins, areThoseOfTheTraversalsThatTheDriverDoesNotWalk) {
    Names expected;
    for (const std::string_view traversal : traversals()) {
        if (!findStructure(structureOf(traversal)).isWalkedByDriver) {
            expected.insert(traversal);
        }
    }
    Names found;
    for (const Twin& twin : twins()) {
        found.insert(twin.traversal);
    }
    EXPECT_EQ(found, expected);
}

// So a misspelt name in shaders/CMakeLists.txt is found without a device.
TEST(Structures, areDeclaredForEveryShader) {
    for (const Shader& shader : shaders()) {
        if (!shader.structure.empty()) {
            EXPECT_EQ(findStructure(shader.structure).name, shader.structure) << shader.kernel;
        }
    }
}

} // namespace
} // namespace metamarch::tests

// SPDX-License-Identifier: MIT
// Compares the lists of twins and of traversals, in any order.
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

// This finds a misspelt name in shaders/CMakeLists.txt without a device.
TEST(Structures, areDeclaredForEveryShader) {
    for (const Shader& shader : shaders()) {
        if (!shader.structure.empty()) {
            EXPECT_EQ(findStructure(shader.structure).name, shader.structure) << shader.kernel;
        }
    }
}

} // namespace
} // namespace metamarch::tests

// SPDX-License-Identifier: MIT
// The macros and names that let one header compile as GLSL and as C++ (with GLM).
#ifndef METAMARCH_SHARED_INTEROP_H
#define METAMARCH_SHARED_INTEROP_H

#ifdef __cplusplus
#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <type_traits>

#define SHARED_BEGIN namespace metamarch {
#define SHARED_END }
// Begins every shared function.
#define SHARED_FN inline
#define SHARED_ASSERT_SIZE(T, bytes)                                                                         \
    static_assert(sizeof(T) == (bytes) && std::is_trivially_copyable_v<T>,                                   \
                  #T ": layout differs from the shader's");
#define SHARED_ASSERT_OFFSET(T, member, bytes)                                                               \
    static_assert(offsetof(T, member) == (bytes), #T "." #member ": layout differs from the shader's");
namespace metamarch {
using uint = std::uint32_t;
using glm::abs, glm::clamp, glm::cross, glm::dot, glm::floor, glm::max, glm::min, glm::mix, glm::sqrt;
using glm::bvec3, glm::greaterThan, glm::ivec3, glm::uvec2, glm::uvec3, glm::uvec4, glm::vec2, glm::vec3,
    glm::vec4;
using glm::floatBitsToInt, glm::floatBitsToUint, glm::uintBitsToFloat;
} // namespace metamarch
#else
#define SHARED_BEGIN
#define SHARED_END
#define SHARED_FN
#define SHARED_ASSERT_SIZE(T, bytes)
#define SHARED_ASSERT_OFFSET(T, member, bytes)
#endif

#endif

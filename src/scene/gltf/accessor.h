// SPDX-License-Identifier: MIT
// Reads glTF accessors and checks them.
#pragma once
#include "metamarch/file/input_file.h"

#include <glm/glm.hpp>
#include <tiny_gltf.h>

#include <cstdint>
#include <string>
#include <vector>

namespace metamarch {

class GltfAccessor {
  public:
    // Checks everything that later reads rely on: indices of accessor, buffer views and buffers, offsets,
    // stride, count, component type and sparse indices. `label` starts the error messages ("mesh 'body'
    // primitive 0: POSITION"). `type` is the TINYGLTF_TYPE_… that the caller needs. Throws
    // Error(inputRefused).
    GltfAccessor(const tinygltf::Model& model, const InputFile& file, const std::string& label, int accessor,
                 int type);

    std::uint64_t count() const { return count_; }
    bool hasIntegers() const { return componentType_ != TINYGLTF_COMPONENT_TYPE_FLOAT; }
    bool hasUnsignedIntegers() const;

    // Return element `i < count()`. Normalised integers are mapped to [0, 1] or [-1, 1]; other values are
    // unchanged.
    double component(std::uint64_t i, int c) const;
    double scalar(std::uint64_t i) const { return component(i, 0); }
    glm::dvec2 vec2(std::uint64_t i) const { return {component(i, 0), component(i, 1)}; }
    glm::dvec3 vec3(std::uint64_t i) const { return {component(i, 0), component(i, 1), component(i, 2)}; }
    glm::dvec4 vec4(std::uint64_t i) const;
    glm::dmat4 mat4(std::uint64_t i) const;
    std::uint32_t index(std::uint64_t i) const; // for scalar accessors of unsigned integers

  private:
    // Elements lie at `data + i * stride`. Null data means that all elements are zero.
    struct Span {
        const unsigned char* data = nullptr;
        std::uint64_t stride = 0;
    };

    Span checkedSpan(const tinygltf::Model& model, int view, std::uint64_t offset, std::uint64_t count,
                     std::uint64_t elementSize) const;
    void readSparse(const tinygltf::Model& model, const tinygltf::Accessor& accessor);
    const unsigned char* element(std::uint64_t i) const;
    [[noreturn]] void refuse(const std::string& what) const;

    const InputFile& file_;
    std::string label_;
    std::uint64_t count_ = 0;
    int componentType_ = 0;
    std::uint64_t componentSize_ = 0;
    std::uint64_t elementSize_ = 0;
    bool normalized_ = false;
    Span dense_;
    Span sparse_;
    std::vector<std::uint32_t> sparseIndices_; // strictly increasing; the elements that sparse_ replaces
};

} // namespace metamarch

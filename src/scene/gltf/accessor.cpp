// SPDX-License-Identifier: MIT
#include "metamarch/scene/gltf/accessor.h"

#include "metamarch/scene/gltf/buffer.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace metamarch {
namespace {

// More elements than any scene can use. Below this, products with strides and offsets fit into 64 bits.
constexpr std::uint64_t kMaxElements = std::uint64_t{1} << 33;

// Limit of elements that are zero without any bytes in the file. A longer run is an attack rather than a
// mesh.
constexpr std::uint64_t kMaxImpliedElements = std::uint64_t{1} << 24;

// Returns the size in bytes, 0 for a type that glTF 2.0 does not have.
std::uint64_t sizeOfComponent(int componentType) {
    switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return 4;
    default:
        return 0;
    }
}

// Buffers guarantee no alignment.
template <typename T>
T load(const unsigned char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

// Normalises integers as in glTF 2.0, 3.11: c / 255, max(c / 127, -1) and so on.
template <typename T>
double loadInteger(const unsigned char* bytes, bool normalized) {
    const double value = static_cast<double>(load<T>(bytes));
    return normalized ? std::max(value / static_cast<double>(std::numeric_limits<T>::max()), -1.0) : value;
}

std::uint32_t loadIndex(const unsigned char* bytes, int componentType) {
    switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return load<std::uint8_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return load<std::uint16_t>(bytes);
    default:
        return load<std::uint32_t>(bytes);
    }
}

bool isUnsignedInteger(int componentType) {
    return componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
           componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

} // namespace

GltfAccessor::GltfAccessor(const tinygltf::Model& model, const InputFile& file, const std::string& label,
                           int accessor, int type)
    : file_(file), label_(label + ": accessor " + std::to_string(accessor)) {
    if (accessor < 0 || static_cast<std::size_t>(accessor) >= model.accessors.size()) {
        file_.refuse(label_ + " does not exist, there are " + std::to_string(model.accessors.size()));
    }
    const tinygltf::Accessor& source = model.accessors[static_cast<std::size_t>(accessor)];
    count_ = source.count;
    componentType_ = source.componentType;
    componentSize_ = sizeOfComponent(componentType_);
    normalized_ = source.normalized;
    if (componentSize_ == 0) {
        refuse("component type " + std::to_string(componentType_) + " is not one of glTF 2.0");
    }
    if (source.type != type) {
        refuse("has elements of the wrong type for this use");
    }
    if (count_ == 0) {
        refuse("is empty");
    }
    if (count_ > kMaxElements) {
        refuse("count " + std::to_string(count_) + " is absurd");
    }
    elementSize_ = componentSize_ * static_cast<std::uint64_t>(
                                        tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type)));

    if (source.bufferView >= 0) {
        dense_ = checkedSpan(model, source.bufferView, source.byteOffset, count_, elementSize_);
    } else if (!source.sparse.isSparse) {
        refuse("has no data");
    } else if (count_ > kMaxImpliedElements) {
        refuse("count " + std::to_string(count_) + " is absurd without a buffer view");
    }
    if (source.sparse.isSparse) {
        readSparse(model, source);
    }
}

bool GltfAccessor::hasUnsignedIntegers() const { return isUnsignedInteger(componentType_); }

GltfAccessor::Span GltfAccessor::checkedSpan(const tinygltf::Model& model, int view, std::uint64_t offset,
                                             std::uint64_t count, std::uint64_t elementSize) const {
    const std::string viewLabel = "buffer view " + std::to_string(view);
    const std::span<const unsigned char> bytes = bytesOfView(model, file_, label_, view);
    const tinygltf::BufferView& source = model.bufferViews[static_cast<std::size_t>(view)];
    const std::uint64_t stride = source.byteStride == 0 ? elementSize : source.byteStride;
    if (stride < elementSize) {
        refuse(viewLabel + ": stride " + std::to_string(stride) + " is less than an element of " +
               std::to_string(elementSize) + " bytes");
    }
    // The view's length is at most the size of a real buffer. Count and offset may be anything, so divide
    // rather than multiply: that cannot wrap around.
    if (offset > bytes.size() || bytes.size() - offset < elementSize ||
        (bytes.size() - offset - elementSize) / stride < count - 1) {
        refuse(viewLabel + ": " + std::to_string(count) + " elements at offset " + std::to_string(offset) +
               " with stride " + std::to_string(stride) + " reach past its " + std::to_string(bytes.size()) +
               " bytes");
    }
    return {bytes.data() + offset, stride};
}

void GltfAccessor::readSparse(const tinygltf::Model& model, const tinygltf::Accessor& accessor) {
    const auto& sparse = accessor.sparse;
    if (sparse.count < 0 || static_cast<std::uint64_t>(sparse.count) > count_) {
        refuse("sparse count " + std::to_string(sparse.count) + " is more than its count " +
               std::to_string(count_));
    }
    if (sparse.count == 0) {
        return;
    }
    if (!isUnsignedInteger(sparse.indices.componentType)) {
        refuse("sparse indices have component type " + std::to_string(sparse.indices.componentType));
    }
    // Newer versions of tinygltf have unsigned offsets.
    const auto isNegative = [](const auto offset) { return static_cast<std::int64_t>(offset) < 0; };
    if (isNegative(sparse.indices.byteOffset) || isNegative(sparse.values.byteOffset)) {
        refuse("sparse offset is negative");
    }

    const std::uint64_t replaced = static_cast<std::uint64_t>(sparse.count);
    const Span indices =
        checkedSpan(model, sparse.indices.bufferView, static_cast<std::uint64_t>(sparse.indices.byteOffset),
                    replaced, sizeOfComponent(sparse.indices.componentType));
    sparse_ = checkedSpan(model, sparse.values.bufferView,
                          static_cast<std::uint64_t>(sparse.values.byteOffset), replaced, elementSize_);
    sparseIndices_.reserve(replaced);
    for (std::uint64_t i = 0; i < replaced; ++i) {
        const std::uint32_t index =
            loadIndex(indices.data + i * indices.stride, sparse.indices.componentType);
        if (index >= count_) {
            refuse("sparse index " + std::to_string(index) + " is out of range, the count is " +
                   std::to_string(count_));
        }
        if (!sparseIndices_.empty() && index <= sparseIndices_.back()) {
            refuse("sparse indices do not increase at " + std::to_string(i));
        }
        sparseIndices_.push_back(index);
    }
}

const unsigned char* GltfAccessor::element(std::uint64_t i) const {
    const auto replaced = std::lower_bound(sparseIndices_.begin(), sparseIndices_.end(), i);
    if (replaced != sparseIndices_.end() && *replaced == i) {
        return sparse_.data + static_cast<std::uint64_t>(replaced - sparseIndices_.begin()) * sparse_.stride;
    }
    return dense_.data != nullptr ? dense_.data + i * dense_.stride : nullptr;
}

double GltfAccessor::component(std::uint64_t i, int c) const {
    const unsigned char* bytes = element(i);
    if (bytes == nullptr) {
        return 0.0;
    }
    bytes += static_cast<std::uint64_t>(c) * componentSize_;
    switch (componentType_) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return loadInteger<std::int8_t>(bytes, normalized_);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return loadInteger<std::uint8_t>(bytes, normalized_);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return loadInteger<std::int16_t>(bytes, normalized_);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return loadInteger<std::uint16_t>(bytes, normalized_);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return loadInteger<std::uint32_t>(bytes, normalized_);
    default:
        return static_cast<double>(load<float>(bytes));
    }
}

glm::dvec4 GltfAccessor::vec4(std::uint64_t i) const {
    return {component(i, 0), component(i, 1), component(i, 2), component(i, 3)};
}

glm::dmat4 GltfAccessor::mat4(std::uint64_t i) const {
    glm::dmat4 matrix;
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            matrix[column][row] = component(i, 4 * column + row);
        }
    }
    return matrix;
}

std::uint32_t GltfAccessor::index(std::uint64_t i) const {
    const unsigned char* bytes = element(i);
    return bytes != nullptr ? loadIndex(bytes, componentType_) : 0;
}

void GltfAccessor::refuse(const std::string& what) const { file_.refuse(label_ + ": " + what); }

} // namespace metamarch

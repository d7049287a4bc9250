// SPDX-License-Identifier: MIT
#include "metamarch/scene/gltf/draco.h"

#include "metamarch/scene/gltf/buffer.h"
#include "metamarch/scene/gltf/element.h"

#include <array>
#include <cstring>
#include <draco/attributes/attribute_octahedron_transform.h>
#include <draco/attributes/attribute_quantization_transform.h>
#include <draco/compression/attributes/normal_compression_utils.h>
#include <draco/compression/decode.h>
#include <draco/mesh/mesh.h>
#include <memory>

namespace metamarch {
namespace {

// Appends a buffer and a view of it; returns the view's index.
int addView(tinygltf::Model& model, std::vector<unsigned char> bytes) {
    tinygltf::BufferView view;
    view.buffer = static_cast<int>(model.buffers.size());
    view.byteLength = bytes.size();
    model.buffers.emplace_back().data = std::move(bytes);
    model.bufferViews.push_back(std::move(view));
    return static_cast<int>(model.bufferViews.size()) - 1;
}

int addAccessor(tinygltf::Model& model, tinygltf::Accessor accessor) {
    model.accessors.push_back(std::move(accessor));
    return static_cast<int>(model.accessors.size()) - 1;
}

// Returns the values of all points, converted to T, or nothing if Draco cannot convert them.
template <class T>
std::optional<std::vector<unsigned char>> valuesOf(const draco::Mesh& mesh,
                                                   const draco::PointAttribute& attribute) {
    const auto components = static_cast<std::int8_t>(attribute.num_components()); // Draco has both types
    const std::size_t stride = static_cast<unsigned char>(components);
    std::vector<T> values(stride * mesh.num_points());
    for (draco::PointIndex point(0); point < mesh.num_points(); ++point) {
        if (!attribute.ConvertValue<T>(attribute.mapped_index(point), components,
                                       &values[stride * point.value()])) {
            return std::nullopt;
        }
    }
    std::vector<unsigned char> bytes(values.size() * sizeof(T));
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

std::optional<std::vector<unsigned char>> valuesOf(int componentType, const draco::Mesh& mesh,
                                                   const draco::PointAttribute& attribute) {
    switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return valuesOf<std::int8_t>(mesh, attribute);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return valuesOf<std::uint8_t>(mesh, attribute);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return valuesOf<std::int16_t>(mesh, attribute);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return valuesOf<std::uint16_t>(mesh, attribute);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return valuesOf<std::uint32_t>(mesh, attribute);
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return valuesOf<float>(mesh, attribute);
    default:
        return std::nullopt;
    }
}

// Returns the attribute whose values `toFloats` makes of the integers of each entry.
template <class ToFloats>
std::unique_ptr<draco::PointAttribute> converted(const draco::Mesh& mesh,
                                                 const draco::PointAttribute& integers,
                                                 const std::int8_t components, const ToFloats& toFloats) {
    auto floats = std::make_unique<draco::PointAttribute>();
    floats->Init(integers.attribute_type(), components, draco::DT_FLOAT32, false, integers.size());
    if (!integers.is_mapping_identity()) {
        floats->SetExplicitMapping(mesh.num_points());
        for (draco::PointIndex point(0); point < mesh.num_points(); ++point) {
            floats->SetPointMapEntry(point, integers.mapped_index(point));
        }
    }
    std::vector<std::int32_t> from(static_cast<unsigned char>(integers.num_components()));
    std::vector<float> to(static_cast<unsigned char>(components));
    for (draco::AttributeValueIndex i(0); i < static_cast<std::uint32_t>(integers.size()); ++i) {
        if (!integers.ConvertValue<std::int32_t>(i, from.data())) {
            return nullptr;
        }
        toFloats(from, to);
        floats->SetAttributeValue(i, to.data());
    }
    return floats;
}

// Returns the floats of an attribute that Draco has left as integers, as AttributeQuantizationTransform and
// AttributeOctahedronTransform compute them; null if it holds its values. Draco as distributions compile it
// fuses multiplications with additions where the processor can, so its floats differ between processors.
std::unique_ptr<draco::PointAttribute> dequantized(const draco::Mesh& mesh,
                                                   const draco::PointAttribute& integers) {
    if (integers.GetAttributeTransformData() == nullptr) {
        return nullptr;
    }
    using Integers = std::vector<std::int32_t>;
    draco::AttributeQuantizationTransform steps;
    if (steps.InitFromAttribute(integers)) {
        const float step = steps.range() / static_cast<float>((1u << steps.quantization_bits()) - 1);
        return converted(mesh, integers, static_cast<std::int8_t>(integers.num_components()),
                         [&](const Integers& from, std::vector<float>& to) {
                             for (std::size_t i = 0; i < to.size(); ++i) {
                                 to[i] = static_cast<float>(from[i]) * step + steps.min_values()[i];
                             }
                         });
    }
    draco::AttributeOctahedronTransform octahedron;
    draco::OctahedronToolBox directions;
    if (integers.num_components() == 2 && octahedron.InitFromAttribute(integers) &&
        directions.SetQuantizationBits(octahedron.quantization_bits())) {
        return converted(mesh, integers, 3, [&](const Integers& from, std::vector<float>& to) {
            directions.QuantizedOctahedralCoordsToUnitVector(from[0], from[1], to.data());
        });
    }
    return nullptr;
}

class DracoPrimitive {
  public:
    // `accessors` is the number of accessors in the file, without those added for decoded data.
    DracoPrimitive(tinygltf::Model& model, std::size_t accessors, const InputFile& file,
                   const GltfElement& extension, tinygltf::Primitive& primitive)
        : model_(model), accessors_(accessors), file_(file), extension_(extension), primitive_(primitive) {}

    void decompress() {
        const std::unique_ptr<draco::Mesh> mesh = decode();
        for (auto& [name, accessor] : primitive_.attributes) {
            if (const std::optional<int> id = extension_.object("attributes").integer(name.c_str())) {
                accessor = readAttribute(*mesh, name, accessor, *id);
            }
        }
        primitive_.indices = readIndices(*mesh);
        primitive_.mode = TINYGLTF_MODE_TRIANGLES;
    }

  private:
    std::unique_ptr<draco::Mesh> decode() const {
        const std::span<const unsigned char> bytes =
            bytesOfView(model_, file_, extension_.label(), extension_.integer("bufferView").value_or(-1));
        draco::DecoderBuffer buffer;
        buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        draco::Decoder decoder;
        for (int type = 0; type < draco::GeometryAttribute::NAMED_ATTRIBUTES_COUNT; ++type) {
            decoder.SetSkipAttributeTransform(static_cast<draco::GeometryAttribute::Type>(type));
        }
        auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
        if (!decoded.ok()) {
            extension_.refuse("cannot be decoded: " + decoded.status().error_msg_string());
        }
        return std::move(decoded).value();
    }

    int readAttribute(const draco::Mesh& mesh, const std::string& name, int accessor, int id) {
        const auto index = static_cast<std::size_t>(accessor);
        if (accessor < 0 || index >= accessors_) {
            extension_.refuse(name + ": accessor " + std::to_string(accessor) +
                              " does not exist, there are " + std::to_string(accessors_));
        }
        const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(static_cast<std::uint32_t>(id));
        if (attribute == nullptr) {
            extension_.refuse(name + ": there is no attribute " + std::to_string(id));
        }
        const std::unique_ptr<draco::PointAttribute> floats = dequantized(mesh, *attribute);
        attribute = floats == nullptr ? attribute : floats.get();
        tinygltf::Accessor decoded = model_.accessors[index];
        if (attribute->num_components() !=
            tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(decoded.type))) {
            extension_.refuse(name + ": accessor " + std::to_string(accessor) + " has another type");
        }
        std::optional<std::vector<unsigned char>> values = valuesOf(decoded.componentType, mesh, *attribute);
        if (!values) {
            extension_.refuse(name + ": does not fit accessor " + std::to_string(accessor));
        }
        decoded.bufferView = addView(model_, std::move(*values));
        decoded.byteOffset = 0;
        decoded.count = mesh.num_points();
        decoded.sparse.isSparse = false;
        return addAccessor(model_, std::move(decoded));
    }

    int readIndices(const draco::Mesh& mesh) {
        std::vector<unsigned char> bytes;
        for (draco::FaceIndex face(0); face < mesh.num_faces(); ++face) {
            for (const draco::PointIndex& point : mesh.face(face)) {
                const std::uint32_t index = point.value();
                std::array<unsigned char, sizeof index> four;
                std::memcpy(four.data(), &index, sizeof index);
                bytes.insert(bytes.end(), four.begin(), four.end());
            }
        }
        tinygltf::Accessor indices;
        indices.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
        indices.type = TINYGLTF_TYPE_SCALAR;
        indices.count = std::size_t{3} * mesh.num_faces();
        indices.bufferView = addView(model_, std::move(bytes));
        return addAccessor(model_, std::move(indices));
    }

    tinygltf::Model& model_;
    std::size_t accessors_;
    const InputFile& file_;
    const GltfElement& extension_;
    tinygltf::Primitive& primitive_;
};

} // namespace

void decompressDraco(GltfDocument& document, const InputFile& file) {
    const std::vector<GltfElement> meshes = GltfElement(file, "", &document.json).objects("meshes", "mesh");
    tinygltf::Model& model = document.model;
    const std::size_t accessors = model.accessors.size();
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        const std::vector<GltfElement> primitives = meshes[m].objects("primitives", "primitive");
        for (std::size_t p = 0; p < primitives.size(); ++p) {
            if (const auto extension = primitives[p].extension("KHR_draco_mesh_compression")) {
                DracoPrimitive(model, accessors, file, *extension, model.meshes[m].primitives[p])
                    .decompress();
            }
        }
    }
}

} // namespace metamarch

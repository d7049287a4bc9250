// SPDX-License-Identifier: MIT
#include "metamarch/scene/gltf/instancing.h"

#include "metamarch/scene/gltf/accessor.h"
#include "metamarch/scene/gltf/node.h"

namespace metamarch {

std::vector<glm::dmat4> instanceMatrices(const tinygltf::Model& model, const InputFile& file,
                                         const GltfElement& node) {
    const std::optional<GltfElement> extension = node.extension("EXT_mesh_gpu_instancing");
    if (!extension) {
        return {glm::dmat4(1.0)};
    }
    const GltfElement attributes = extension->object("attributes");
    const auto accessor = [&](const char* name, int type) -> std::optional<GltfAccessor> {
        const std::optional<int> index = attributes.integer(name);
        if (!index) {
            return std::nullopt;
        }
        return GltfAccessor(model, file, extension->label() + ' ' + name, *index, type);
    };
    const std::optional<GltfAccessor> translation = accessor("TRANSLATION", TINYGLTF_TYPE_VEC3);
    const std::optional<GltfAccessor> rotation = accessor("ROTATION", TINYGLTF_TYPE_VEC4);
    const std::optional<GltfAccessor> scale = accessor("SCALE", TINYGLTF_TYPE_VEC3);

    std::optional<std::uint64_t> count;
    for (const std::optional<GltfAccessor>* attribute : {&translation, &rotation, &scale}) {
        if (*attribute && count.value_or((*attribute)->count()) != (*attribute)->count()) {
            extension->refuse("attributes of different counts");
        }
        if (*attribute) {
            count = (*attribute)->count();
        }
    }
    std::vector<glm::dmat4> matrices;
    for (std::uint64_t i = 0; i < count.value_or(0); ++i) {
        matrices.push_back(composed(translation ? translation->vec3(i) : glm::dvec3(0.0),
                                    rotation ? rotation->vec4(i) : glm::dvec4(0.0, 0.0, 0.0, 1.0),
                                    scale ? scale->vec3(i) : glm::dvec3(1.0)));
    }
    return matrices;
}

} // namespace metamarch

// SPDX-License-Identifier: MIT
#include "metamarch/scene/gltf/buffer.h"

#include <cstdint>

namespace metamarch {

std::span<const unsigned char> bytesOfView(const tinygltf::Model& model, const InputFile& file,
                                           const std::string& label, int view) {
    const std::string viewLabel = label + ": buffer view " + std::to_string(view);
    if (view < 0 || static_cast<std::size_t>(view) >= model.bufferViews.size()) {
        file.refuse(viewLabel + " does not exist, there are " + std::to_string(model.bufferViews.size()));
    }
    const tinygltf::BufferView& source = model.bufferViews[static_cast<std::size_t>(view)];
    if (source.buffer < 0 || static_cast<std::size_t>(source.buffer) >= model.buffers.size()) {
        file.refuse(viewLabel + ": buffer " + std::to_string(source.buffer) + " does not exist, there are " +
                    std::to_string(model.buffers.size()));
    }
    const std::span<const unsigned char> bytes = model.buffers[static_cast<std::size_t>(source.buffer)].data;
    const std::uint64_t offset = source.byteOffset;
    const std::uint64_t length = source.byteLength;
    if (offset > bytes.size() || length > bytes.size() - offset) {
        file.refuse(viewLabel + " reaches past the end of buffer " + std::to_string(source.buffer) +
                    " (offset " + std::to_string(offset) + ", length " + std::to_string(length) +
                    ", buffer " + std::to_string(bytes.size()) + " bytes)");
    }
    return bytes.subspan(offset, length);
}

} // namespace metamarch

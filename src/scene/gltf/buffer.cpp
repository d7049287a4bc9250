// SPDX-License-Identifier: MIT
#include "metamarch/scene/gltf/buffer.h"

#include "metamarch/scene/gltf/element.h"
#include "metamarch/scene/gltf/meshopt.h"
#include "metamarch/scene/gltf/uri.h"

#include <fmt/format.h>

#include <cstdint>
#include <map>
#include <numeric>

namespace metamarch {
namespace {

// Whether the buffer only stands for the decoded bytes of compressed views.
bool isFallback(const GltfElement& buffer) {
    const std::optional<GltfElement> meshopt =
        canDecompressMeshopt() ? meshoptExtension(buffer) : std::nullopt;
    return meshopt && meshopt->flag("fallback", false);
}

std::vector<unsigned char> dataOf(const GltfElement& buffer, const std::string& uri) {
    std::optional<std::vector<unsigned char>> bytes = bytesOfDataUri(uri);
    if (!bytes) {
        buffer.refuse("a data URI that is not base64");
    }
    return std::move(*bytes);
}

std::filesystem::path pathOf(InputFile& file, const GltfElement& buffer, const std::string& uri) {
    const std::string name = file.portableName(fileNameOfUri(uri));
    if (const std::string reason = file.whyNotReadable(name); !reason.empty()) {
        buffer.refuse('\'' + name + "' " + reason);
    }
    file.addCompanion(name);
    return std::filesystem::canonical(file.companion(name));
}

std::vector<unsigned char> contentOf(const GltfElement& buffer, const std::filesystem::path& path) {
    std::optional<std::vector<unsigned char>> bytes = readBytes(path);
    if (!bytes) {
        buffer.refuse('\'' + path.filename().string() + "' cannot be read");
    }
    return std::move(*bytes);
}

// Makes everything that refers to buffer i refer to `first[i]`.
void redirect(GltfDocument& document, const std::vector<std::size_t>& first) {
    for (tinygltf::BufferView& view : document.model.bufferViews) {
        if (view.buffer >= 0 && static_cast<std::size_t>(view.buffer) < first.size()) {
            view.buffer = static_cast<int>(first[static_cast<std::size_t>(view.buffer)]);
        }
    }
    const auto views = document.json.find("bufferViews");
    if (views == document.json.end()) {
        return;
    }
    for (nlohmann::json& view : *views) {
        for (const char* path :
             {"/extensions/EXT_meshopt_compression/buffer", "/extensions/KHR_meshopt_compression/buffer"}) {
            const nlohmann::json::json_pointer pointer(path);
            if (view.contains(pointer) && view[pointer].is_number_unsigned() &&
                view[pointer].get<std::uint64_t>() < first.size()) {
                view[pointer] = first[view[pointer].get<std::size_t>()];
            }
        }
    }
}

} // namespace

void readBuffers(GltfDocument& document, InputFile& file, std::span<const unsigned char> binary) {
    const std::vector<GltfElement> sources =
        GltfElement(file, "", &document.json).objects("buffers", "buffer");
    std::vector<tinygltf::Buffer>& buffers = document.model.buffers;
    buffers.assign(sources.size(), {});
    std::vector<std::size_t> first(sources.size());
    std::iota(first.begin(), first.end(), std::size_t{0});
    std::map<std::filesystem::path, std::size_t> firstOfFile;
    for (std::size_t i = 0; i < sources.size(); ++i) {
        if (isFallback(sources[i])) {
            continue;
        }
        const std::string uri = sources[i].text("uri");
        if (isDataUri(uri)) {
            buffers[i].data = dataOf(sources[i], uri);
        } else if (!uri.empty()) {
            const std::filesystem::path path = pathOf(file, sources[i], uri);
            first[i] = firstOfFile.try_emplace(path, i).first->second;
            if (first[i] == i) {
                buffers[i].data = contentOf(sources[i], path);
            }
        } else if (i == 0) {
            buffers[i].data.assign(binary.begin(), binary.end());
        }
        const double wanted = sources[i].number("byteLength", 0.0);
        const std::size_t found = buffers[first[i]].data.size();
        if (static_cast<double>(found) < wanted) {
            file.warn(fmt::format("{}: its byteLength is {:.0f}, but only {} bytes are there",
                                  sources[i].label(), wanted, found));
        }
    }
    redirect(document, first);
}

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

// SPDX-License-Identifier: MIT
#include "metamarch/scene/gltf/meshopt.h"

#include "metamarch/scene/gltf/element.h"

#ifdef METAMARCH_MESHOPT
#include <meshoptimizer.h>
#endif

#include <span>

namespace metamarch {

const nlohmann::json* meshoptExtension(const nlohmann::json& element) {
    const auto extensions = element.find("extensions");
    if (extensions == element.end() || !extensions->is_object()) {
        return nullptr;
    }
    for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
        if (const auto found = extensions->find(name); found != extensions->end()) {
            return &*found;
        }
    }
    return nullptr;
}

#ifdef METAMARCH_MESHOPT

namespace {

// Most decoded bytes per encoded byte: those of the densest of the three codecs (vertices, 2 bits for 16
// zeros).
constexpr std::uint64_t kMostBytesOfOne = 64;

class MeshoptView {
  public:
    MeshoptView(const tinygltf::Model& model, const GltfElement& extension)
        : extension_(extension), mode_(extension.text("mode")), filter_(extension.text("filter", "NONE")),
          count_(required("count")), stride_(required("byteStride")) {
        const auto buffer =
            static_cast<std::size_t>(extension.index("buffer", "buffer", model.buffers.size()).value_or(0));
        const std::span<const unsigned char> bytes = model.buffers[buffer].data;
        const std::uint64_t offset = static_cast<std::uint64_t>(extension.integer("byteOffset").value_or(0));
        const std::uint64_t length = required("byteLength");
        if (offset > bytes.size() || length > bytes.size() - offset) {
            extension.refuse("reaches past the end of buffer " + std::to_string(buffer));
        }
        bytes_ = bytes.subspan(offset, length);
        checkSizes();
    }

    bool isAttributes() const { return mode_ == "ATTRIBUTES"; }
    std::uint64_t stride() const { return stride_; }

    std::vector<unsigned char> decoded() const {
        std::vector<unsigned char> result(count_ * stride_);
        int failure = 0;
        if (isAttributes()) {
            failure =
                meshopt_decodeVertexBuffer(result.data(), count_, stride_, bytes_.data(), bytes_.size());
        } else if (mode_ == "TRIANGLES") {
            failure = meshopt_decodeIndexBuffer(result.data(), count_, stride_, bytes_.data(), bytes_.size());
        } else {
            failure =
                meshopt_decodeIndexSequence(result.data(), count_, stride_, bytes_.data(), bytes_.size());
        }
        if (failure != 0) {
            extension_.refuse("cannot be decoded");
        }
        applyFilter(result);
        return result;
    }

  private:
    std::uint64_t required(const char* key) const {
        const std::optional<int> value = extension_.integer(key);
        if (!value || *value == 0) {
            extension_.refuse(std::string("has no ") + key);
        }
        return static_cast<std::uint64_t>(*value);
    }

    // Checks what the decoders take for granted.
    void checkSizes() const {
        const bool isIndices = mode_ == "TRIANGLES" || mode_ == "INDICES";
        if (!isIndices && !isAttributes()) {
            extension_.refuse("mode '" + mode_ + "' is none of ATTRIBUTES, TRIANGLES, INDICES");
        }
        if (isIndices ? stride_ != 2 && stride_ != 4 : stride_ % 4 != 0 || stride_ > 256) {
            extension_.refuse("byteStride " + std::to_string(stride_) + " is none of mode " + mode_);
        }
        if (mode_ == "TRIANGLES" && count_ % 3 != 0) {
            extension_.refuse("count " + std::to_string(count_) + " is no whole number of triangles");
        }
        if (filter_ != "NONE" && filter_ != "OCTAHEDRAL" && filter_ != "QUATERNION" &&
            filter_ != "EXPONENTIAL") {
            extension_.refuse("filter '" + filter_ + "' is not supported");
        }
        if ((filter_ == "OCTAHEDRAL" && stride_ != 4 && stride_ != 8) ||
            (filter_ == "QUATERNION" && stride_ != 8) || (filter_ != "NONE" && isIndices)) {
            extension_.refuse("filter " + filter_ + " does not go with mode " + mode_ + " and byteStride " +
                              std::to_string(stride_));
        }
        if (count_ * stride_ / kMostBytesOfOne > bytes_.size()) {
            extension_.refuse("count " + std::to_string(count_) + " is more than " +
                              std::to_string(bytes_.size()) + " bytes can hold");
        }
    }

    void applyFilter(std::vector<unsigned char>& bytes) const {
        if (filter_ == "OCTAHEDRAL") {
            meshopt_decodeFilterOct(bytes.data(), count_, stride_);
        } else if (filter_ == "QUATERNION") {
            meshopt_decodeFilterQuat(bytes.data(), count_, stride_);
        } else if (filter_ == "EXPONENTIAL") {
            meshopt_decodeFilterExp(bytes.data(), count_, stride_);
        }
    }

    const GltfElement& extension_;
    std::string mode_;
    std::string filter_;
    std::uint64_t count_;
    std::uint64_t stride_;
    std::span<const unsigned char> bytes_;
};

} // namespace

bool canDecompressMeshopt() { return true; }

void decompressMeshopt(GltfDocument& document, const InputFile& file) {
    tinygltf::Model& model = document.model;
    const std::vector<GltfElement> views =
        GltfElement(file, "", &document.json).objects("bufferViews", "buffer view");
    for (std::size_t i = 0; i < views.size(); ++i) {
        const nlohmann::json* json = meshoptExtension(document.json["bufferViews"][i]);
        if (json == nullptr) {
            continue;
        }
        const GltfElement extension(file, views[i].label() + ": meshopt compression", json);
        const MeshoptView compressed(model, extension);
        std::vector<unsigned char> bytes = compressed.decoded();
        tinygltf::BufferView& view = model.bufferViews[i];
        view.buffer = static_cast<int>(model.buffers.size());
        view.byteOffset = 0;
        view.byteLength = bytes.size();
        view.byteStride = compressed.isAttributes() ? compressed.stride() : 0;
        model.buffers.emplace_back().data = std::move(bytes);
    }
}

#else

bool canDecompressMeshopt() { return false; }

void decompressMeshopt(GltfDocument&, const InputFile&) {}

#endif

} // namespace metamarch

// SPDX-License-Identifier: MIT
#include "metamarch/scene/gltf/meshopt.h"

#include "metamarch/scene/gltf/meshopt_attributes.h"

#include <fmt/format.h>

#ifdef METAMARCH_MESHOPT
#include <meshoptimizer.h>
#endif

#include <algorithm>
#include <array>
#include <initializer_list>
#include <span>
#include <string_view>

namespace metamarch {

std::optional<GltfElement> meshoptExtension(const GltfElement& element) {
    const std::optional<GltfElement> older = element.extension("EXT_meshopt_compression");
    return older ? older : element.extension("KHR_meshopt_compression");
}

#ifdef METAMARCH_MESHOPT

namespace {

// Most decoded bytes per encoded byte: those of the densest of the three codecs (attributes of version 1, a
// byte for 256 elements of four zeros).
constexpr std::uint64_t kMostBytesOfOne = 1024;

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
        if (!isAttributes()) {
            return decodedIndices();
        }
        std::optional<std::vector<unsigned char>> result = decodeMeshoptAttributes(bytes_, count_, stride_);
        if (!result) {
            refuseStream({0xa0, 0xa1});
        }
        applyFilter(*result);
        return std::move(*result);
    }

  private:
    std::vector<unsigned char> decodedIndices() const {
        std::vector<unsigned char> result(count_ * stride_);
        const bool isList = mode_ == "TRIANGLES";
        const int failure =
            isList
                ? meshopt_decodeIndexBuffer(result.data(), count_, stride_, bytes_.data(), bytes_.size())
                : meshopt_decodeIndexSequence(result.data(), count_, stride_, bytes_.data(), bytes_.size());
        if (failure != 0) {
            refuseStream(isList ? std::initializer_list<unsigned char>{0xe0, 0xe1}
                                : std::initializer_list<unsigned char>{0xd0, 0xd1});
        }
        return result;
    }

    // `headers`: the first bytes of streams that are read.
    [[noreturn]] void refuseStream(std::initializer_list<unsigned char> headers) const {
        if (std::ranges::find(headers, bytes_[0]) == headers.end()) {
            extension_.refuse(
                fmt::format("mode {} has no codec with the header byte {:#04x}", mode_, bytes_[0]));
        }
        extension_.refuse("cannot be decoded: the stream is broken or cut off");
    }

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
            extension_.refuse(fmt::format("byteStride {} is not {}, as mode {} wants", stride_,
                                          isIndices ? "2 or 4" : "a multiple of 4 up to 256", mode_));
        }
        if (mode_ == "TRIANGLES" && count_ % 3 != 0) {
            extension_.refuse("count " + std::to_string(count_) + " is no whole number of triangles");
        }
        constexpr std::array<std::string_view, 5> kFilters = {"NONE", "OCTAHEDRAL", "QUATERNION",
                                                              "EXPONENTIAL", "COLOR"};
        if (std::ranges::find(kFilters, filter_) == kFilters.end()) {
            extension_.refuse("filter '" + filter_ + "' is not supported");
        }
        const bool isEight = filter_ == "OCTAHEDRAL" || filter_ == "COLOR";
        if ((isEight && stride_ != 4 && stride_ != 8) || (filter_ == "QUATERNION" && stride_ != 8) ||
            (filter_ != "NONE" && isIndices)) {
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
        } else if (filter_ == "COLOR") {
            decodeMeshoptColors(bytes, stride_);
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
        const std::optional<GltfElement> extension = meshoptExtension(views[i]);
        if (!extension) {
            continue;
        }
        const MeshoptView compressed(model, *extension);
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

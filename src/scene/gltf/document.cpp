// SPDX-License-Identifier: MIT
#include "metamarch/scene/gltf/document.h"

#include "metamarch/scene/gltf/buffer.h"
#include "metamarch/scene/gltf/draco.h"
#include "metamarch/scene/gltf/extension.h"
#include "metamarch/scene/gltf/glb_container.h"
#include "metamarch/scene/gltf/meshopt.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <string_view>

namespace metamarch {
namespace {

using Json = nlohmann::json;

// glTF 2.0 needs a nesting depth of about ten. Up to this limit, recursion over the JSON is harmless.
constexpr int kMaxJsonDepth = 64;

// tinygltf keeps these members in 64 bits and every other integer in 32. JSON promises to carry integers up
// to 2^53 exactly.
constexpr std::array<std::string_view, 4> kSizeKeys = {"byteLength", "byteOffset", "byteStride", "count"};
constexpr std::uint64_t kMaxSize = std::uint64_t{1} << 53;

constexpr std::array<std::string_view, 13> kIndexKeys = {
    "attributes", "buffer", "bufferView", "camera", "children", "componentType", "indices",
    "material",   "mesh",   "mode",       "nodes",  "scene",    "skin"};

// kElementKeys are read by GltfElement in place of tinygltf; kSharedKeys by both, because of their
// extensions.
constexpr std::array<const char*, 8> kElementKeys = {"animations", "buffers",  "extensions", "images",
                                                     "materials",  "samplers", "skins",      "textures"};
constexpr std::array<const char*, 3> kSharedKeys = {"bufferViews", "meshes", "nodes"};

template <std::size_t N>
bool contains(const std::array<std::string_view, N>& keys, std::string_view key) {
    return std::find(keys.begin(), keys.end(), key) != keys.end();
}

// Returns the library's message without its "[json.exception.parse_error.101] ".
std::string reasonOf(const Json::exception& failure) {
    const std::string_view text = failure.what();
    const std::size_t end = text.find("] ");
    return std::string(end != std::string_view::npos ? text.substr(end + 2) : text);
}

Json parseJson(const InputFile& file, const unsigned char* begin, const unsigned char* end) {
    const auto keep = [&file](int depth, Json::parse_event_t event, Json& parsed) {
        if (depth > kMaxJsonDepth) {
            file.refuse("JSON is nested more than " + std::to_string(kMaxJsonDepth) + " deep");
        }
        return event != Json::parse_event_t::key || parsed != "extras";
    };
    try {
        Json root = Json::parse(begin, end, keep);
        if (!root.is_object()) {
            file.refuse("the JSON is not an object");
        }
        return root;
    } catch (const Json::exception& failure) {
        file.refuse("not glTF: " + reasonOf(failure));
    }
}

// `where` is the path so far ("accessors[3].count"); `key` is the nearest enclosing name.
void checkIntegers(const InputFile& file, const Json& value, std::string_view key, const std::string& where) {
    const bool isSize = contains(kSizeKeys, key);
    if (value.is_object()) {
        const bool namesIndices = key == "attributes";
        for (const auto& [name, member] : value.items()) {
            checkIntegers(file, member,
                          namesIndices && !member.is_structured() ? key : std::string_view(name),
                          where.empty() ? name : fmt::format("{}.{}", where, name));
        }
    } else if (value.is_array()) {
        for (std::size_t i = 0; i < value.size(); ++i) {
            checkIntegers(file, value[i], key, fmt::format("{}[{}]", where, i));
        }
    } else if (isSize || contains(kIndexKeys, key)) {
        const std::uint64_t limit = isSize ? kMaxSize : std::numeric_limits<std::int32_t>::max();
        if (!value.is_number_unsigned() || value.get<std::uint64_t>() > limit) {
            file.refuse(where + ": " + value.dump() + " is not an integer from 0 to " +
                        std::to_string(limit));
        }
    }
}

// Returns a version as text. One that is written as a number is taken for its text, after a warning.
std::string versionText(InputFile& file, const std::string& key, const Json& version) {
    if (version.is_string()) {
        return version.get<std::string>();
    }
    if (!version.is_number()) {
        file.refuse(key + ": " + version.dump() + " is not a version of glTF such as \"2.0\"");
    }
    std::string text = version.is_number_integer() ? version.dump() + ".0" : version.dump();
    file.warn(key + ": the number " + version.dump() + " is taken for the text \"" + text + '"');
    return text;
}

// Leaves the versions as text, which is how tinygltf wants them.
void checkVersion(InputFile& file, Json& root) {
    const auto asset = root.find("asset");
    if (asset == root.end() || !asset->is_object() || !asset->contains("version")) {
        file.refuse("asset.version is missing");
    }
    for (const std::string key : {"version", "minVersion"}) {
        if (!asset->contains(key)) {
            continue;
        }
        const std::string version = versionText(file, "asset." + key, (*asset)[key]);
        if (key == "minVersion" ? version != "2.0" : !version.starts_with("2.")) {
            file.refuse(fmt::format("asset.{}: glTF {} is not supported, glTF 2.0 is", key, version));
        }
        (*asset)[key] = version;
    }
}

std::vector<std::string> extensionNames(const InputFile& file, const Json& root, const char* key) {
    const auto names = root.find(key);
    if (names == root.end()) {
        return {};
    }
    if (!names->is_array() ||
        !std::ranges::all_of(*names, [](const Json& name) { return name.is_string(); })) {
        file.refuse(std::string(key) + " is not an array of strings");
    }
    return names->get<std::vector<std::string>>();
}

void checkExtensions(InputFile& file, const Json& root) {
    for (const std::string& name : extensionNames(file, root, "extensionsRequired")) {
        if (!isSupportedExtension(name)) {
            file.refuse("extensionsRequired: " + name + " is not supported");
        }
    }
    std::string unknown;
    for (const std::string& name : extensionNames(file, root, "extensionsUsed")) {
        if (!isSupportedExtension(name)) {
            unknown += (unknown.empty() ? "" : ", ") + name;
        }
    }
    if (!unknown.empty()) {
        file.warn("extensionsUsed: ignoring " + unknown);
    }
}

// tinygltf requires the indices of a primitive to have a buffer view even if they are compressed.
void eraseCompressedIndices(Json& root) {
    const auto meshes = root.find("meshes");
    if (meshes == root.end()) {
        return;
    }
    for (Json& mesh : *meshes) {
        const auto primitives = mesh.find("primitives");
        for (std::size_t i = 0; primitives != mesh.end() && i < primitives->size(); ++i) {
            Json& primitive = primitives->at(i);
            if (primitive.contains("/extensions/KHR_draco_mesh_compression"_json_pointer)) {
                primitive.erase("indices");
            }
        }
    }
}

void eraseExtensions(Json& value) {
    if (value.is_object()) {
        value.erase("extensions");
    }
    for (Json& member : value) {
        if (member.is_structured()) {
            eraseExtensions(member);
        }
    }
}

// tinygltf refuses strides that glTF 2.0 does not allow, although they can be read.
void eraseStrides(Json& root) {
    if (const auto views = root.find("bufferViews"); views != root.end()) {
        for (Json& view : *views) {
            view.erase("byteStride");
        }
    }
}

void restoreStrides(GltfDocument& document) {
    for (std::size_t i = 0; i < document.model.bufferViews.size(); ++i) {
        document.model.bufferViews[i].byteStride = document.json["bufferViews"][i].value("byteStride", 0u);
    }
}

bool isArrayOfObjects(const Json& value) {
    return value.is_array() &&
           std::ranges::all_of(value, [](const Json& element) { return element.is_object(); });
}

// These elements must be objects; otherwise a library would throw without naming the element.
void checkObjects(const InputFile& file, const Json& root) {
    for (const char* key : {"accessors", "animations", "buffers", "bufferViews", "cameras", "images",
                            "materials", "meshes", "nodes", "samplers", "scenes", "skins", "textures"}) {
        const auto elements = root.find(key);
        if (elements != root.end() && !isArrayOfObjects(*elements)) {
            file.refuse(std::string(key) + " is not an array of objects");
        }
    }
    for (std::size_t i = 0; root.contains("meshes") && i < root["meshes"].size(); ++i) {
        const Json& mesh = root["meshes"][i];
        if (mesh.contains("primitives") && !isArrayOfObjects(mesh["primitives"])) {
            file.refuse(fmt::format("meshes[{}].primitives is not an array of objects", i));
        }
    }
}

// Removes from `root` what tinygltf need not see, and returns it.
Json takeElements(Json& root) {
    Json elements = Json::object();
    for (const char* key : kElementKeys) {
        if (const auto found = root.find(key); found != root.end()) {
            elements[key] = std::move(*found);
            root.erase(found);
        }
    }
    for (const char* key : kSharedKeys) {
        if (const auto found = root.find(key); found != root.end()) {
            elements[key] = *found;
        }
    }
    return elements;
}

// Returns the elements; `text` receives the JSON that remains for tinygltf.
Json checkedJson(InputFile& file, Json root, std::string& text) {
    checkVersion(file, root);
    checkExtensions(file, root);
    checkObjects(file, root);
    Json elements = takeElements(root);
    eraseCompressedIndices(root);
    eraseExtensions(root);
    checkIntegers(file, root, "", "");
    eraseStrides(root);
    text = root.dump();
    return elements;
}

} // namespace

GltfDocument readGltf(InputFile& file) {
    const std::vector<unsigned char> bytes = file.read();
    const GlbChunks chunks = isGlb(bytes) ? glbChunks(file, bytes) : GlbChunks{{0, bytes.size()}, {}};
    GltfDocument document;
    std::string errors;
    std::string warnings;
    bool parsed = false;
    try {
        std::string checked;
        document.json = checkedJson(
            file, parseJson(file, bytes.data() + chunks.json.begin, bytes.data() + chunks.json.end), checked);
        if (checked.size() > std::numeric_limits<std::uint32_t>::max()) {
            file.refuse("more than 4 GiB of JSON");
        }
        parsed = tinygltf::TinyGLTF().LoadASCIIFromString(&document.model, &errors, &warnings, checked.data(),
                                                          static_cast<unsigned int>(checked.size()), "");
    } catch (const Json::exception& failure) {
        file.refuse("not glTF: " + reasonOf(failure));
    }
    // tinygltf continues after some errors; after one of them it drops the primitive with the error.
    if (!parsed || !errors.empty()) {
        file.refuse("not glTF: " + (errors.empty() ? std::string("no reason given") : errors));
    }
    restoreStrides(document);
    readBuffers(document, file,
                std::span(bytes).subspan(chunks.binary.begin, chunks.binary.end - chunks.binary.begin));
    decompressMeshopt(document, file);
    decompressDraco(document, file);
    return document;
}

} // namespace metamarch

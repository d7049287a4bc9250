// SPDX-License-Identifier: MIT
// Reads glTF's JSON with checks: each value has the type, length and range that the caller asked for.
#pragma once
#include "metamarch/file/input_file.h"

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace metamarch {

// A JSON object of a glTF file. An absent object is represented too; it has no members. Every reader throws
// Error(inputRefused), "<label>: <key> …", if a member has the wrong type or a number is not finite.
class GltfElement {
  public:
    // `json` must outlive the element; null means an absent object. The file's root has an empty label.
    GltfElement(const InputFile& file, std::string label, const nlohmann::json* json);

    const std::string& label() const { return label_; }
    bool has(const char* key) const { return member(key) != nullptr; }

    double number(const char* key, double fallback) const;
    bool flag(const char* key, bool fallback) const;
    std::string text(const char* key, const std::string& fallback = "") const;
    // integer() returns 0 to 2^31 - 1. index() returns an integer below `count`, the number of elements of
    // that `kind` ("texture"). Both return nothing if the member is absent.
    std::optional<int> integer(const char* key) const;
    std::optional<int> index(const char* key, const char* kind, std::size_t count) const;

    template <int N>
    glm::vec<N, double> vector(const char* key, const glm::vec<N, double>& fallback) const {
        glm::vec<N, double> result = fallback;
        const std::vector<double> numbers = vectorOf(key, N);
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            result[static_cast<int>(i)] = numbers[i];
        }
        return result;
    }

    // Returns a member object, labelled "<label>: <key>". If it is absent, the result has no members.
    GltfElement object(const char* key) const;
    // Returns the objects of a list, labelled by kind and by name or index: "mesh 'body' primitive 0".
    std::vector<GltfElement> objects(const char* key, const char* kind) const;
    std::vector<int> integers(const char* key) const;
    // Returns the extension, labelled "<label>: <name>", or nothing if it is absent.
    std::optional<GltfElement> extension(const char* name) const;

    [[noreturn]] void refuse(const std::string& what) const;

  private:
    std::string labelOf(const char* key) const;
    const nlohmann::json* member(const char* key) const;
    const nlohmann::json* list(const char* key) const;
    int checkedInteger(const char* key, const nlohmann::json& value) const;
    std::vector<double> vectorOf(const char* key, std::size_t length) const; // empty if absent

    const InputFile* file_;
    std::string label_;
    const nlohmann::json* json_;
};

} // namespace metamarch

// SPDX-License-Identifier: MIT
#include "metamarch/scene/gltf/element.h"

#include <cmath>
#include <limits>

namespace metamarch {
namespace {

using Json = nlohmann::json;

// The number must also be finite in single precision, to which it is converted later.
bool isFiniteNumber(const Json& value) {
    return value.is_number() && std::isfinite(static_cast<float>(value.get<double>()));
}

} // namespace

GltfElement::GltfElement(const InputFile& file, std::string label, const Json* json)
    : file_(&file), label_(std::move(label)), json_(json) {
    if (json_ != nullptr && !json_->is_object()) {
        refuse("is not an object");
    }
}

double GltfElement::number(const char* key, double fallback) const {
    const Json* value = member(key);
    if (value == nullptr) {
        return fallback;
    }
    if (!isFiniteNumber(*value)) {
        refuse(std::string(key) + ": " + value->dump() + " is not a finite number");
    }
    return value->get<double>();
}

bool GltfElement::flag(const char* key, bool fallback) const {
    const Json* value = member(key);
    if (value != nullptr && !value->is_boolean()) {
        refuse(std::string(key) + " is neither true nor false");
    }
    return value != nullptr ? value->get<bool>() : fallback;
}

std::string GltfElement::text(const char* key, const std::string& fallback) const {
    const Json* value = member(key);
    if (value != nullptr && !value->is_string()) {
        refuse(std::string(key) + " is not a string");
    }
    return value != nullptr ? value->get<std::string>() : fallback;
}

std::optional<int> GltfElement::integer(const char* key) const {
    const Json* value = member(key);
    return value != nullptr ? std::optional(checkedInteger(key, *value)) : std::nullopt;
}

std::optional<int> GltfElement::index(const char* key, const char* kind, std::size_t count) const {
    const std::optional<int> index = integer(key);
    if (index && static_cast<std::size_t>(*index) >= count) {
        refuse(std::string(kind) + ' ' + std::to_string(*index) + " does not exist, there are " +
               std::to_string(count));
    }
    return index;
}

GltfElement GltfElement::object(const char* key) const { return {*file_, labelOf(key), member(key)}; }

std::vector<GltfElement> GltfElement::objects(const char* key, const char* kind) const {
    std::vector<GltfElement> elements;
    const Json* values = list(key);
    for (std::size_t i = 0; values != nullptr && i < values->size(); ++i) {
        const Json& value = (*values)[i];
        std::string name;
        if (value.is_object() && value.contains("name") && value["name"].is_string()) {
            name = value["name"].get<std::string>();
        }
        elements.emplace_back(*file_, (label_.empty() ? "" : label_ + ' ') + elementName(kind, name, i),
                              &value);
    }
    return elements;
}

std::vector<int> GltfElement::integers(const char* key) const {
    std::vector<int> numbers;
    if (const Json* values = list(key)) {
        for (const Json& value : *values) {
            numbers.push_back(checkedInteger(key, value));
        }
    }
    return numbers;
}

std::optional<GltfElement> GltfElement::extension(const char* name) const {
    const GltfElement extensions = object("extensions");
    const Json* value = extensions.member(name);
    return value != nullptr ? std::optional(GltfElement(*file_, labelOf(name), value)) : std::nullopt;
}

void GltfElement::refuse(const std::string& what) const {
    file_->refuse(label_.empty() ? what : label_ + ": " + what);
}

std::string GltfElement::labelOf(const char* key) const { return label_.empty() ? key : label_ + ": " + key; }

const Json* GltfElement::member(const char* key) const {
    if (json_ == nullptr) {
        return nullptr;
    }
    const auto found = json_->find(key);
    return found != json_->end() ? &*found : nullptr;
}

const Json* GltfElement::list(const char* key) const {
    const Json* values = member(key);
    if (values != nullptr && !values->is_array()) {
        refuse(std::string(key) + " is not a list");
    }
    return values;
}

int GltfElement::checkedInteger(const char* key, const Json& value) const {
    constexpr int kLimit = std::numeric_limits<int>::max();
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() > kLimit) {
        refuse(std::string(key) + ": " + value.dump() + " is not an integer from 0 to " +
               std::to_string(kLimit));
    }
    return value.get<int>();
}

std::vector<double> GltfElement::vectorOf(const char* key, std::size_t length) const {
    std::vector<double> numbers;
    if (const Json* values = list(key)) {
        if (values->size() != length) {
            refuse(std::string(key) + " has " + std::to_string(values->size()) + " numbers, not " +
                   std::to_string(length));
        }
        for (const Json& value : *values) {
            if (!isFiniteNumber(value)) {
                refuse(std::string(key) + ": " + value.dump() + " is not a finite number");
            }
            numbers.push_back(value.get<double>());
        }
    }
    return numbers;
}

} // namespace metamarch

#include "voxelize/gltf_json.h"

#include <fmt/format.h>

#include <cmath>

#include "voxelize/load_mesh.h"

namespace voxilux {
namespace {

using nlohmann::json;

constexpr double kLargestCount = 9007199254740992.0;  // 2^53: whole numbers are exact in a double up to here

const json* find(const JsonItem& item, const char* key) {
    const auto found = item.json->find(key);
    return found == item.json->end() ? nullptr : &*found;
}

[[noreturn]] void refuse(const JsonItem& item, const char* key, const std::string& what) {
    throw MeshFault(fmt::format("{}{}{} {}", item.name, item.name.empty() ? "" : ".", key, what));
}

std::uint64_t count_of(const json& value, const JsonItem& item, const char* key) {
    if (!value.is_number()) refuse(item, key, "is not a number");
    const double number = value.get<double>();
    if (!(number >= 0.0) || number > kLargestCount || number != std::floor(number))
        refuse(item, key, "is not a whole number from 0 to 2^53");
    return static_cast<std::uint64_t>(number);
}

double number_of(const json& value, const JsonItem& item, const char* key) {
    if (!value.is_number()) refuse(item, key, "is not a number");
    const double number = value.get<double>();
    if (!std::isfinite(number)) refuse(item, key, "is not finite");
    return number;
}

const json* find_array(const JsonItem& item, const char* key) {
    const json* value = find(item, key);
    if (value != nullptr && !value->is_array()) refuse(item, key, "is not an array");
    return value;
}

std::size_t index_of(const json& value, const JsonItem& item, const char* key, const char* list,
                     std::size_t size) {
    const std::uint64_t index = count_of(value, item, key);
    if (index >= size) refuse(item, key, fmt::format("names {}[{}], but there are {}", list, index, size));
    return index;
}

}  // namespace

std::size_t list_size(const JsonItem& root, const char* key) {
    const json* list = find_array(root, key);
    return list == nullptr ? 0 : list->size();
}

JsonItem list_item(const JsonItem& root, const char* key, std::size_t index) {
    const json& value = find_array(root, key)->at(index);
    JsonItem item = {&value, fmt::format("{}{}{}[{}]", root.name, root.name.empty() ? "" : ".", key, index)};
    if (!value.is_object()) throw MeshFault(item.name + " is not an object");
    return item;
}

JsonItem child(const JsonItem& item, const char* key) {
    static const json kEmpty = json::object();
    const json* value = find(item, key);
    if (value != nullptr && !value->is_object()) refuse(item, key, "is not an object");
    return {value == nullptr ? &kEmpty : value,
            fmt::format("{}{}{}", item.name, item.name.empty() ? "" : ".", key)};
}

bool has(const JsonItem& item, const char* key) {
    return find(item, key) != nullptr;
}

JsonItem extension(const JsonItem& item, const char* key) {
    return child(child(item, "extensions"), key);
}

std::optional<std::uint64_t> read_count(const JsonItem& item, const char* key) {
    const json* value = find(item, key);
    if (value == nullptr) return std::nullopt;
    return count_of(*value, item, key);
}

std::uint64_t require_count(const JsonItem& item, const char* key) {
    const auto count = read_count(item, key);
    if (!count) refuse(item, key, "is missing");
    return *count;
}

std::optional<std::size_t> read_index(const JsonItem& item, const char* key, const JsonItem& root,
                                      const char* list) {
    const json* value = find(item, key);
    if (value == nullptr) return std::nullopt;
    return index_of(*value, item, key, list, list_size(root, list));
}

double read_number(const JsonItem& item, const char* key, double fallback) {
    const json* value = find(item, key);
    return value == nullptr ? fallback : number_of(*value, item, key);
}

bool read_flag(const JsonItem& item, const char* key, bool fallback) {
    const json* value = find(item, key);
    if (value == nullptr) return fallback;
    if (!value->is_boolean()) refuse(item, key, "is neither true nor false");
    return value->get<bool>();
}

std::string read_text(const JsonItem& item, const char* key, const std::string& fallback) {
    const json* value = find(item, key);
    if (value == nullptr) return fallback;
    if (!value->is_string()) refuse(item, key, "is not a text");
    return value->get_ref<const std::string&>();
}

bool read_numbers(const JsonItem& item, const char* key, std::span<double> wanted) {
    const json* list = find_array(item, key);
    if (list == nullptr) return false;
    if (list->size() != wanted.size())
        refuse(item, key, fmt::format("has {} numbers, not {}", list->size(), wanted.size()));
    for (std::size_t i = 0; i < wanted.size(); ++i)
        wanted[i] = number_of((*list)[i], item, key);
    return true;
}

std::vector<std::size_t> read_indices(const JsonItem& item, const char* key, const JsonItem& root,
                                      const char* list) {
    std::vector<std::size_t> indices;
    const json* values = find_array(item, key);
    if (values == nullptr) return indices;
    const std::size_t size = list_size(root, list);
    for (const json& value : *values)
        indices.push_back(index_of(value, item, key, list, size));
    return indices;
}

}  // namespace voxilux

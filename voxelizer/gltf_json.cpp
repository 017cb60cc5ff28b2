#include "voxelizer/gltf_json.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "voxelizer/load_mesh.h"

namespace voxilux {
namespace {

using nlohmann::json;

constexpr double kLargestWhole = 9007199254740992.0;  // 2^53: integers up to here are exact in a double

const json* find(const JsonItem& item, const char* key) {
    const auto found = item.json->find(key);
    return found == item.json->end() ? nullptr : &*found;
}

std::uint64_t whole_of(const json& value, const JsonItem& item, const char* key) {
    if (!value.is_number()) refuse(item, key, "is not a number");
    const double number = value.get<double>();
    if (!(number >= 0.0) || number > kLargestWhole || number != std::floor(number))
        refuse(item, key, "is not a whole number from 0 to 2^53");
    return static_cast<std::uint64_t>(number);
}

int int_of(const json& value, const JsonItem& item, const char* key) {
    const std::uint64_t whole = whole_of(value, item, key);
    if (whole > static_cast<std::uint64_t>(std::numeric_limits<int>::max()))
        refuse(item, key, fmt::format("is {}: numbers from 2^31 on are not read here", whole));
    return static_cast<int>(whole);
}

double number_of(const json& value, const JsonItem& item, const char* key) {
    if (!value.is_number()) refuse(item, key, "is not a number");
    const double number = value.get<double>();
    if (!std::isfinite(number)) refuse(item, key, "is not finite");
    return number;
}

const std::string& text_of(const json& value, const JsonItem& item, const char* key) {
    if (!value.is_string()) refuse(item, key, "is not a text");
    return value.get_ref<const std::string&>();
}

const json& array_at(const JsonItem& item, const char* key) {
    const json& value = item.json->at(key);
    if (!value.is_array()) refuse(item, key, "is not an array");
    return value;
}

}  // namespace

void refuse(const JsonItem& item, const char* key, const std::string& what) {
    throw MeshFault(fmt::format("{}{}{} {}", item.name, item.name.empty() ? "" : ".", key, what));
}

std::size_t list_size(const JsonItem& item, const char* key) {
    return has(item, key) ? array_at(item, key).size() : 0;
}

JsonItem list_item(const JsonItem& item, const char* key, std::size_t index) {
    const json& value = array_at(item, key).at(index);
    JsonItem found = {&value, fmt::format("{}{}{}[{}]", item.name, item.name.empty() ? "" : ".", key, index)};
    if (!value.is_object()) throw MeshFault(found.name + " is not an object");
    return found;
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

std::uint64_t read_whole(const JsonItem& item, const char* key) {
    return whole_of(item.json->at(key), item, key);
}

int read_int(const JsonItem& item, const char* key) {
    return int_of(item.json->at(key), item, key);
}

std::vector<int> read_ints(const JsonItem& item, const char* key) {
    std::vector<int> numbers;
    for (const json& value : array_at(item, key))
        numbers.push_back(int_of(value, item, key));
    return numbers;
}

double read_number(const JsonItem& item, const char* key) {
    return number_of(item.json->at(key), item, key);
}

std::vector<double> read_numbers(const JsonItem& item, const char* key, std::size_t size) {
    const json& list = array_at(item, key);
    if (list.size() != size) refuse(item, key, fmt::format("has {} numbers, not {}", list.size(), size));
    std::vector<double> numbers;
    for (const json& value : list)
        numbers.push_back(number_of(value, item, key));
    return numbers;
}

bool read_flag(const JsonItem& item, const char* key) {
    const json& value = item.json->at(key);
    if (!value.is_boolean()) refuse(item, key, "is neither true nor false");
    return value.get<bool>();
}

const std::string& read_text(const JsonItem& item, const char* key) {
    return text_of(item.json->at(key), item, key);
}

std::vector<std::string> read_texts(const JsonItem& item, const char* key) {
    std::vector<std::string> texts;
    for (const json& value : array_at(item, key))
        texts.push_back(text_of(value, item, key));
    return texts;
}

}  // namespace voxilux

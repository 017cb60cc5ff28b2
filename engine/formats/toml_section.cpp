#include "formats/toml_section.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "base/nearest_name.h"
#include "base/printable.h"

namespace voxilux {
namespace {

// "(0, 180)": round where the end itself is not allowed.
std::string written(Range range) {
    return fmt::format("{}{}, {}{}", range.open_low ? '(' : '[', range.low, range.high,
                       range.open_high ? ')' : ']');
}

// What a person reads as the value: scalars as written, the rest by its kind.
std::string shown(const toml::node& node) {
    if (const auto* text = node.as_string()) return fmt::format("the text \"{}\"", text->get().substr(0, 40));
    if (const auto* list = node.as_array()) return fmt::format("a list of {}", list->size());
    if (node.is_table()) return "a table";
    if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
    if (const auto* number = node.as_integer()) return fmt::format("{}", number->get());
    if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
    return "a date or time";
}

}  // namespace

bool Range::holds(double value) const {
    return std::isfinite(value) && (open_low ? value > low : value >= low) &&
           (open_high ? value < high : value <= high);
}

std::string place_of(const toml::source_region& source) {
    const std::string path = source.path ? *source.path : "scene";
    if (path.starts_with("-D ") || source.begin.line == 0) return path;
    return fmt::format("{}:{}:{}", path, source.begin.line, source.begin.column);
}

void refuse_at(const toml::source_region& source, const std::string& what) {
    throw Error(ExitCode::input_refused,
                fmt::format("{}: {}", printable(place_of(source), kUncut), printable(what)));
}

TomlSection::TomlSection(const toml::table& table, std::string name, std::span<const std::string_view> keys)
    : table_(table), name_(std::move(name)), keys_(keys.begin(), keys.end()) {
    for (const auto& [key, value] : table_) {
        if (std::ranges::find(keys_, key.str()) != keys_.end()) continue;
        // The value's place is the same line and survives -D, which keeps the key object of the file.
        const bool same =
            key.source().path && value.source().path && *key.source().path == *value.source().path;
        refuse_at(same ? key.source() : value.source(),
                  fmt::format("unknown key '{}' in {}{}", key.str(), name_, name_hint(key.str(), keys_)));
    }
}

const toml::node* TomlSection::find(std::string_view key) const {
    VX_ASSERT(std::ranges::find(keys_, key) != keys_.end());
    return table_.get(key);
}

void TomlSection::refuse(const std::string& what) const {
    refuse_at(table_.source(), fmt::format("{} {}", name_, what));
}

void TomlSection::refuse(std::string_view key, const std::string& what) const {
    const toml::node* node = find(key);
    refuse_at(node != nullptr ? node->source() : table_.source(),
              fmt::format("'{}' in {} {}", key, name_, what));
}

void TomlSection::refuse_value(std::string_view key, const toml::node& node,
                               const std::string& expected) const {
    refuse_at(node.source(), fmt::format("'{}' in {} must be {}, not {}", key, name_, expected, shown(node)));
}

double TomlSection::checked_number(std::string_view key, const toml::node& node, Range range,
                                   const std::string& expected) const {
    const auto value = node.is_number() ? node.value<double>() : std::nullopt;
    if (!value || !range.holds(*value)) refuse_value(key, node, expected);
    return *value;
}

std::int64_t TomlSection::checked_integer(std::string_view key, const toml::node& node, Range range,
                                          const std::string& expected) const {
    // Every integer range of a scene is far inside the 2^53 that a double holds exactly.
    const auto* value = node.as_integer();
    if (value == nullptr || !range.holds(static_cast<double>(value->get())))
        refuse_value(key, node, expected);
    return value->get();
}

const toml::array* TomlSection::list(std::string_view key, std::size_t count,
                                     const std::string& expected) const {
    const toml::node* node = find(key);
    if (node == nullptr) return nullptr;
    const toml::array* array = node->as_array();
    if (array == nullptr || array->size() != count) refuse_value(key, *node, expected);
    return array;
}

std::optional<double> TomlSection::number(std::string_view key, Range range) const {
    const toml::node* node = find(key);
    if (node == nullptr) return std::nullopt;
    return checked_number(key, *node, range, "a number in " + written(range));
}

std::optional<std::int64_t> TomlSection::integer(std::string_view key, std::int64_t low,
                                                 std::int64_t high) const {
    const toml::node* node = find(key);
    if (node == nullptr) return std::nullopt;
    return checked_integer(key, *node, {static_cast<double>(low), static_cast<double>(high)},
                           fmt::format("a whole number in [{}, {}]", low, high));
}

std::optional<bool> TomlSection::boolean(std::string_view key) const {
    const toml::node* node = find(key);
    if (node == nullptr) return std::nullopt;
    if (!node->is_boolean()) refuse_value(key, *node, "true or false");
    return node->as_boolean()->get();
}

std::optional<std::string> TomlSection::text(std::string_view key) const {
    const toml::node* node = find(key);
    if (node == nullptr) return std::nullopt;
    if (!node->is_string()) refuse_value(key, *node, "a text in quotes");
    return node->as_string()->get();
}

std::optional<std::vector<std::string>> TomlSection::texts(std::string_view key) const {
    const toml::node* node = find(key);
    if (node == nullptr) return std::nullopt;
    if (!node->is_array()) return std::vector{*text(key)};
    std::vector<std::string> result;
    for (const toml::node& element : *node->as_array()) {
        if (!element.is_string()) refuse_value(key, element, "a text in quotes or a list of them");
        result.push_back(element.as_string()->get());
    }
    return result;
}

std::optional<std::size_t> TomlSection::choice(std::string_view key,
                                               std::span<const std::string_view> names) const {
    const auto value = text(key);
    if (!value) return std::nullopt;
    const auto found = std::ranges::find(names, *value);
    if (found == names.end())
        refuse(key,
               fmt::format("must be one of '{}', not '{}'", fmt::join(names, "', '"), value->substr(0, 40)));
    return static_cast<std::size_t>(found - names.begin());
}

std::optional<glm::dvec3> TomlSection::numbers3(std::string_view key, Range range) const {
    const std::string expected = "[x, y, z] with numbers in " + written(range);
    const toml::array* array = list(key, 3, expected);
    if (array == nullptr) return std::nullopt;
    glm::dvec3 result;
    for (std::size_t i = 0; i < 3; ++i)
        result[static_cast<int>(i)] = checked_number(key, (*array)[i], range, expected);
    return result;
}

std::optional<glm::ivec3> TomlSection::integers3(std::string_view key, int low, int high) const {
    const std::string expected = fmt::format("[x, y, z] with whole numbers in [{}, {}]", low, high);
    const toml::array* array = list(key, 3, expected);
    if (array == nullptr) return std::nullopt;
    glm::ivec3 result;
    for (std::size_t i = 0; i < 3; ++i)
        result[static_cast<int>(i)] =
            static_cast<int>(checked_integer(key, (*array)[i], {double(low), double(high)}, expected));
    return result;
}

std::optional<glm::ivec2> TomlSection::integers2(std::string_view key, int low, int high) const {
    const std::string expected = fmt::format("two whole numbers in [{}, {}]", low, high);
    const toml::array* array = list(key, 2, expected);
    if (array == nullptr) return std::nullopt;
    glm::ivec2 result;
    for (std::size_t i = 0; i < 2; ++i)
        result[static_cast<int>(i)] =
            static_cast<int>(checked_integer(key, (*array)[i], {double(low), double(high)}, expected));
    return result;
}

}  // namespace voxilux

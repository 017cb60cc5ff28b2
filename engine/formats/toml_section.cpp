#include "formats/toml_section.h"

#include <algorithm>
#include <cctype>
#include <charconv>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/colour.h"
#include "base/error.h"
#include "base/nearest_name.h"
#include "base/printable.h"

namespace voxilux {
namespace {

// The value as messages show it: scalars as written, the rest by its kind.
std::string shown(const toml::node& node) {
    if (const auto* text = node.as_string()) return fmt::format("the text \"{}\"", text->get().substr(0, 40));
    if (const auto* list = node.as_array()) return fmt::format("a list of {}", list->size());
    if (node.is_table()) return "a table";
    if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
    if (const auto* number = node.as_integer()) return fmt::format("{}", number->get());
    if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
    return "a date or time";
}

template <class T>
constexpr bool kIsVector = false;
template <glm::length_t N, class T>
constexpr bool kIsVector<glm::vec<N, T>> = true;

// What a value of type T may be, for messages.
template <class T>
std::string expected_of(Range range) {
    if constexpr (std::is_same_v<T, bool>) {
        return "true or false";
    } else if constexpr (std::is_same_v<T, std::string>) {
        return "a text in quotes";
    } else if constexpr (kIsVector<T>) {
        return fmt::format("{} {}numbers in {}", T::length() == 3 ? "[x, y, z] with" : "two",
                           std::is_integral_v<typename T::value_type> ? "whole " : "", to_string(range));
    } else {
        return fmt::format("a {}number in {}", std::is_integral_v<T> ? "whole " : "", to_string(range));
    }
}

// The value of the node, nothing when it has another type or is out of range.
template <class T>
std::optional<T> value_of(const toml::node& node, Range range) {
    if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, std::string>) {
        return node.value_exact<T>();
    } else {
        // Every range of integers is far inside the 2^53 that a double holds exactly.
        const bool fits = std::is_integral_v<T> ? node.is_integer() : node.is_number();
        const auto value = fits ? node.value<double>() : std::nullopt;
        return value && range.holds(*value) ? std::optional(static_cast<T>(*value)) : std::nullopt;
    }
}

}  // namespace

std::string place_of(const toml::source_region& source) {
    const std::string path = source.path ? *source.path : "scene";
    if (path.starts_with("-D ") || source.begin.line == 0) return path;
    return fmt::format("{}:{}:{}", path, source.begin.line, source.begin.column);
}

void refuse_at(const toml::source_region& source, const std::string& what) {
    throw Error(ExitCode::input_refused,
                fmt::format("{}: {}", printable(place_of(source), kUncut), printable(what)));
}

TomlSection::TomlSection(const toml::table& table, std::string name, std::vector<std::string_view> keys)
    : table_(table), name_(std::move(name)), keys_(std::move(keys)) {
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

template <class T>
std::optional<T> TomlSection::get(std::string_view key, Range range) const {
    const toml::node* node = find(key);
    if (node == nullptr) return std::nullopt;
    const auto checked = [&]<class Part>(const toml::node& part, Part& value) {
        const auto found = value_of<Part>(part, range);
        if (!found) refuse_value(key, part, expected_of<T>(range));
        value = *found;
    };
    T result;
    if constexpr (kIsVector<T>) {
        const toml::array* list = node->as_array();
        if (list == nullptr || list->size() != std::size_t{T::length()})
            refuse_value(key, *node, expected_of<T>(range));
        for (glm::length_t i = 0; i < T::length(); ++i)
            checked((*list)[static_cast<std::size_t>(i)], result[i]);
    } else {
        checked(*node, result);
    }
    return result;
}
template std::optional<bool> TomlSection::get(std::string_view, Range) const;
template std::optional<std::string> TomlSection::get(std::string_view, Range) const;
template std::optional<int> TomlSection::get(std::string_view, Range) const;
template std::optional<std::int64_t> TomlSection::get(std::string_view, Range) const;
template std::optional<std::uint32_t> TomlSection::get(std::string_view, Range) const;
template std::optional<float> TomlSection::get(std::string_view, Range) const;
template std::optional<double> TomlSection::get(std::string_view, Range) const;
template std::optional<glm::ivec2> TomlSection::get(std::string_view, Range) const;
template std::optional<glm::ivec3> TomlSection::get(std::string_view, Range) const;
template std::optional<glm::vec3> TomlSection::get(std::string_view, Range) const;
template std::optional<glm::dvec3> TomlSection::get(std::string_view, Range) const;

void TomlSection::read(const Setting& row, HexColour colour) const {
    const auto text = get<std::string>(row.name);
    if (!text) return;
    if (has(colour.linear_key)) refuse(row.name, fmt::format("excludes '{}'", colour.linear_key));
    std::uint32_t rrggbb = 0;
    const char* end = text->data() + text->size();
    const bool shaped = text->size() == 7 && text->front() == '#';
    const auto parsed =
        shaped ? std::from_chars(text->data() + 1, end, rrggbb, 16) : std::from_chars_result{};
    if (!shaped || parsed.ec != std::errc() || parsed.ptr != end)
        refuse(row.name, fmt::format("must be \"#rrggbb\" (sRGB), not \"{}\"", text->substr(0, 40)));
    colour.linear = linear_from_srgb_hex(rrggbb);
}

std::optional<std::vector<std::string>> TomlSection::texts(std::string_view key) const {
    const toml::node* node = find(key);
    if (node == nullptr) return std::nullopt;
    if (!node->is_array()) return std::vector{*get<std::string>(key)};
    std::vector<std::string> result;
    for (const toml::node& element : *node->as_array()) {
        if (!element.is_string()) refuse_value(key, element, "a text in quotes or a list of them");
        result.push_back(element.as_string()->get());
    }
    return result;
}

std::optional<std::size_t> TomlSection::choice(std::string_view key,
                                               std::span<const std::string_view> names) const {
    const auto value = get<std::string>(key);
    if (!value) return std::nullopt;
    const auto found = std::ranges::find(names, *value);
    if (found == names.end())
        refuse(key,
               fmt::format("must be one of '{}', not '{}'", fmt::join(names, "', '"), value->substr(0, 40)));
    return static_cast<std::size_t>(found - names.begin());
}

}  // namespace voxilux

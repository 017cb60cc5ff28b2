#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <toml++/toml.h>
#include <glm/glm.hpp>

#include "scene/settings.h"

namespace voxilux {

// "FILE:LINE:COLUMN", or the -D option that the value came from.
[[nodiscard]] std::string place_of(const toml::source_region& source);

// Throws Error(input_refused) with "PLACE: what".
[[noreturn]] void refuse_at(const toml::source_region& source, const std::string& what);

// One table of a scene file. Its constructor refuses keys that are not in `keys`. Each reader returns the
// value of a key, nothing when the key is absent, and refuses any other type or a value out of range: one
// line with the place, what was found and what is allowed. Reading a key that is not in `keys` is a defect
// (asserted).
class TomlSection {
  public:
    // `name` is how messages call it: "[sun]". The table must outlive the section.
    TomlSection(const toml::table& table, std::string name, std::vector<std::string_view> keys);

    [[nodiscard]] bool has(std::string_view key) const { return find(key) != nullptr; }
    [[nodiscard]] const toml::node* find(std::string_view key) const;

    // T: bool, std::string; or in `range` an integer, a floating-point number, a glm vector of them.
    template <class T>
    [[nodiscard]] std::optional<T> get(std::string_view key, Range range = {}) const;
    // One string, or a list of strings.
    [[nodiscard]] std::optional<std::vector<std::string>> texts(std::string_view key) const;
    // The position in `names` of the string.
    [[nodiscard]] std::optional<std::size_t> choice(std::string_view key,
                                                    std::span<const std::string_view> names) const;

    // The value, or a refusal that names the missing key.
    template <class T>
    [[nodiscard]] T require(std::optional<T> value, std::string_view key) const {
        if (!value) refuse("needs '" + std::string(key) + "'");
        return *std::move(value);
    }

    // Reads the key of a row. An absent key leaves the member as it is.
    template <class T>
    void read(const Setting& row, T& value) const {
        if (!has(row.name)) {
            if (row.is_required) refuse("needs '" + std::string(row.name) + "'");
        } else if constexpr (std::is_enum_v<T>) {
            value = static_cast<T>(*choice(row.name, row.choices));
        } else if constexpr (std::is_same_v<T, bool>) {
            value = row.choices.empty() ? *get<bool>(row.name) : *choice(row.name, row.choices) == 1;
        } else {
            value = *get<T>(row.name, row.range);
        }
    }
    template <class T>
    void read(const Setting& row, std::optional<T>& value) const {
        if (has(row.name)) read(row, value.emplace());
    }
    void read(const Setting& row, HexColour colour) const;

    // At the section: "[sun] WHAT".
    [[noreturn]] void refuse(const std::string& what) const;
    // At the value of a key: "'key' in [sun] WHAT".
    [[noreturn]] void refuse(std::string_view key, const std::string& what) const;

  private:
    [[noreturn]] void refuse_value(std::string_view key, const toml::node& node,
                                   const std::string& expected) const;

    const toml::table& table_;
    std::string name_;
    std::vector<std::string_view> keys_;
};

// Reads a section that may have a key for each row of the settings, and `others`. Its values go to the
// settings.
template <class Settings>
TomlSection read_settings(const toml::table& table, std::string name, Settings& settings,
                          std::initializer_list<std::string_view> others = {}) {
    std::vector<std::string_view> keys;
    visit_settings(settings, [&](const Setting& row, auto&&) { keys.push_back(row.name); });
    keys.insert(keys.end(), others);
    TomlSection section(table, std::move(name), std::move(keys));
    visit_settings(settings, [&](const Setting& row, auto&& value) { section.read(row, value); });
    return section;
}

}  // namespace voxilux

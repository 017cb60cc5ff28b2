#pragma once

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <toml++/toml.h>
#include <glm/glm.hpp>

namespace voxilux {

// Allowed values of a number; infinities and NaN never are.
struct Range {
    double low = 0.0;
    double high = 0.0;
    bool open_low = false;
    bool open_high = false;

    [[nodiscard]] bool holds(double value) const;
};

// "FILE:LINE:COLUMN", or the -D option that the value came from.
[[nodiscard]] std::string place_of(const toml::source_region& source);

// Throws Error(input_refused) with "PLACE: what".
[[noreturn]] void refuse_at(const toml::source_region& source, const std::string& what);

// One table of a scene file. Its constructor refuses keys that are not in `keys`. Each reader returns the
// value of a key, nothing when the key is absent, and refuses any other type or a value out of range: one
// line with the place, what was found and what is allowed. Reading a key that is not in `keys` is our
// mistake.
class TomlSection {
  public:
    // `name` is how messages call it: "[sun]". The table must outlive the section.
    TomlSection(const toml::table& table, std::string name, std::span<const std::string_view> keys);
    TomlSection(const toml::table& table, std::string name, std::initializer_list<std::string_view> keys)
        : TomlSection(table, std::move(name), std::span(keys.begin(), keys.size())) {}

    [[nodiscard]] bool has(std::string_view key) const { return find(key) != nullptr; }
    [[nodiscard]] const toml::node* find(std::string_view key) const;

    [[nodiscard]] std::optional<double> number(std::string_view key, Range range) const;
    [[nodiscard]] std::optional<std::int64_t> integer(std::string_view key, std::int64_t low,
                                                      std::int64_t high) const;
    [[nodiscard]] std::optional<bool> boolean(std::string_view key) const;
    [[nodiscard]] std::optional<std::string> text(std::string_view key) const;
    // One string, or a list of strings.
    [[nodiscard]] std::optional<std::vector<std::string>> texts(std::string_view key) const;
    // The position in `names` of the string.
    [[nodiscard]] std::optional<std::size_t> choice(std::string_view key,
                                                    std::span<const std::string_view> names) const;
    [[nodiscard]] std::optional<glm::dvec3> numbers3(std::string_view key, Range range) const;
    [[nodiscard]] std::optional<glm::ivec3> integers3(std::string_view key, int low, int high) const;
    [[nodiscard]] std::optional<glm::ivec2> integers2(std::string_view key, int low, int high) const;

    // The value, or a refusal that names the missing key.
    template <class T>
    [[nodiscard]] T require(std::optional<T> value, std::string_view key) const {
        if (!value) refuse("needs '" + std::string(key) + "'");
        return *std::move(value);
    }

    // At the section: "[sun] WHAT".
    [[noreturn]] void refuse(const std::string& what) const;
    // At the value of a key: "'key' in [sun] WHAT".
    [[noreturn]] void refuse(std::string_view key, const std::string& what) const;

  private:
    [[noreturn]] void refuse_value(std::string_view key, const toml::node& node,
                                   const std::string& expected) const;
    [[nodiscard]] const toml::array* list(std::string_view key, std::size_t count,
                                          const std::string& expected) const;
    [[nodiscard]] double checked_number(std::string_view key, const toml::node& node, Range range,
                                        const std::string& expected) const;
    [[nodiscard]] std::int64_t checked_integer(std::string_view key, const toml::node& node, Range range,
                                               const std::string& expected) const;

    const toml::table& table_;
    std::string name_;
    std::vector<std::string_view> keys_;
};

}  // namespace voxilux

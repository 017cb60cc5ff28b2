#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace voxilux {

// A JSON object of a glTF file, and what to call it in messages: "accessors[3]". Nothing that the functions
// below give has a wrong type or lies outside its list: they throw MeshFault instead.
struct JsonItem {
    const nlohmann::json* json = nullptr;
    std::string name;
};

// The number of objects in the list `key` of the file; 0 where there is none.
[[nodiscard]] std::size_t list_size(const JsonItem& root, const char* key);

[[nodiscard]] JsonItem list_item(const JsonItem& root, const char* key, std::size_t index);

// The object `key` of `item`; an empty object where there is none.
[[nodiscard]] JsonItem child(const JsonItem& item, const char* key);

[[nodiscard]] bool has(const JsonItem& item, const char* key);

// An extension's object, an empty one where it is not there.
[[nodiscard]] JsonItem extension(const JsonItem& item, const char* key);

// A whole number from 0 to 2^53.
[[nodiscard]] std::optional<std::uint64_t> read_count(const JsonItem& item, const char* key);
[[nodiscard]] std::uint64_t require_count(const JsonItem& item, const char* key);

// An index into the list `list` of `root`.
[[nodiscard]] std::optional<std::size_t> read_index(const JsonItem& item, const char* key,
                                                    const JsonItem& root, const char* list);

[[nodiscard]] double read_number(const JsonItem& item, const char* key, double fallback);
[[nodiscard]] bool read_flag(const JsonItem& item, const char* key, bool fallback);
[[nodiscard]] std::string read_text(const JsonItem& item, const char* key, const std::string& fallback);

// Exactly `wanted.size()` numbers; false, and nothing written, where the key is not there.
bool read_numbers(const JsonItem& item, const char* key, std::span<double> wanted);

// The indices into the list `list` of `root` that the array `key` holds; none where it is not there.
[[nodiscard]] std::vector<std::size_t> read_indices(const JsonItem& item, const char* key,
                                                    const JsonItem& root, const char* list);

}  // namespace voxilux

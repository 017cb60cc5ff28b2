#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace voxilux {

// A JSON object of a glTF file, and its name in messages: "accessors[3]". The functions below throw MeshFault
// where a value has the wrong type.
struct JsonItem {
    const nlohmann::json* json = nullptr;
    std::string name;
};

// The number of objects in the list `key` of `item`; 0 where there is none.
[[nodiscard]] std::size_t list_size(const JsonItem& item, const char* key);

[[nodiscard]] JsonItem list_item(const JsonItem& item, const char* key, std::size_t index);

// The object `key` of `item`; an empty object where there is none.
[[nodiscard]] JsonItem child(const JsonItem& item, const char* key);

[[nodiscard]] bool has(const JsonItem& item, const char* key);

// Throws MeshFault: "accessors[3].count is missing".
[[noreturn]] void refuse(const JsonItem& item, const char* key, const std::string& what);

// The functions below read a key that must exist.

// An integer from 0 to 2^53.
[[nodiscard]] std::uint64_t read_whole(const JsonItem& item, const char* key);

// An integer that an int holds.
[[nodiscard]] int read_int(const JsonItem& item, const char* key);
[[nodiscard]] std::vector<int> read_ints(const JsonItem& item, const char* key);

[[nodiscard]] double read_number(const JsonItem& item, const char* key);

// Exactly `size` numbers.
[[nodiscard]] std::vector<double> read_numbers(const JsonItem& item, const char* key, std::size_t size);

[[nodiscard]] bool read_flag(const JsonItem& item, const char* key);
[[nodiscard]] const std::string& read_text(const JsonItem& item, const char* key);
[[nodiscard]] std::vector<std::string> read_texts(const JsonItem& item, const char* key);

}  // namespace voxilux

#pragma once

// JSON in and out, for both forms of nlohmann's type. What is written is always valid UTF-8: a file name may
// hold any bytes, and those that are not UTF-8 become U+FFFD. What is read may be hostile: the library's
// recursive parts (copy, dump) would run out of stack on text that is nested without bound.

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace voxilux {

inline constexpr int kMaxJsonDepth = 64;  // our reports have 6

template <class Json>
[[nodiscard]] std::string json_text(const Json& json, int indent = -1) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

// How deep the brackets of a JSON text nest, not counting those in strings.
[[nodiscard]] inline int json_depth(std::string_view text) {
    int depth = 0, deepest = 0;
    bool is_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (is_string && c == '\\') ++i;
        if (c == '"') is_string = !is_string;
        if (is_string) continue;
        if (c == '[' || c == '{') deepest = std::max(deepest, ++depth);
        if (c == ']' || c == '}') --depth;
    }
    return deepest;
}

// Nothing for a text that is not JSON or is nested deeper than kMaxJsonDepth.
template <class Json>
[[nodiscard]] std::optional<Json> parse_json(std::string_view text) {
    if (json_depth(text) > kMaxJsonDepth) return std::nullopt;
    Json json = Json::parse(text, nullptr, false);
    if (json.is_discarded()) return std::nullopt;
    return json;
}

}  // namespace voxilux

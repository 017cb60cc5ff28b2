#pragma once

#include <array>
#include <charconv>
#include <optional>
#include <string_view>

namespace voxilux {

// The four whole numbers of "x0,y0,x1,y1", or nothing when the text is something else.
[[nodiscard]] inline std::optional<std::array<int, 4>> parse_box(std::string_view text) {
    std::array<int, 4> edges{};
    const char* at = text.data();
    const char* const end = at + text.size();
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const auto [rest, error] = std::from_chars(at, end, edges[i]);
        const bool is_last = i + 1 == edges.size();
        if (error != std::errc() || (is_last ? rest != end : rest == end || *rest != ',')) return {};
        at = is_last ? end : rest + 1;
    }
    return edges;
}

}  // namespace voxilux

#include "formats/toml_colour.h"

#include <charconv>

#include <fmt/format.h>

#include "base/colour.h"

namespace voxilux {

std::optional<glm::vec3> read_colour(const TomlSection& section, std::string_view key) {
    const auto text = section.text(key);
    if (!text) return std::nullopt;
    std::uint32_t rrggbb = 0;
    const char* end = text->data() + text->size();
    const bool shaped = text->size() == 7 && text->front() == '#';
    const auto parsed =
        shaped ? std::from_chars(text->data() + 1, end, rrggbb, 16) : std::from_chars_result{};
    if (!shaped || parsed.ec != std::errc() || parsed.ptr != end)
        section.refuse(key, fmt::format("must be \"#rrggbb\" (sRGB), not \"{}\"", text->substr(0, 40)));
    return linear_from_srgb_hex(rrggbb);
}

}  // namespace voxilux

#include "base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace voxilux {
namespace {

constexpr std::size_t kQuotedLength = 80;

// A character of a text: how many bytes it takes, and its code point; `is_valid` is false for a byte that is
// not part of valid UTF-8.
struct Character {
    std::size_t bytes = 1;
    char32_t code = 0;
    bool is_valid = false;
};

// Source: Unicode Standard 15, table 3-7: no overlong forms, no surrogates, nothing above U+10FFFF.
Character first_character(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char lead = byte(0);
    if (lead < 0x80) return {1, lead, true};
    const std::size_t size = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
    if (lead < 0xC2 || lead > 0xF4 || text.size() < size) return {1, lead, false};
    char32_t code = lead & (0xFFu >> (size + 1));
    for (std::size_t i = 1; i < size; ++i) {
        if ((byte(i) & 0xC0) != 0x80) return {1, lead, false};
        code = code << 6 | (byte(i) & 0x3Fu);
    }
    const bool is_overlong = (size == 3 && code < 0x800) || (size == 4 && code < 0x10000);
    if (is_overlong || (code >= 0xD800 && code <= 0xDFFF) || code > 0x10FFFF) return {1, lead, false};
    return {size, code, true};
}

// Control characters, and formatting characters that change the order or the lines of the text.
bool is_hidden(char32_t code) {
    constexpr std::array<std::array<char32_t, 2>, 9> kRanges = {{{0, 0x1F},
                                                                 {0x7F, 0x9F},
                                                                 {0xAD, 0xAD},
                                                                 {0x061C, 0x061C},
                                                                 {0x200B, 0x200F},
                                                                 {0x2028, 0x202E},
                                                                 {0x2060, 0x206F},
                                                                 {0xFEFF, 0xFEFF},
                                                                 {0xE0000, 0xE0FFF}}};
    return std::ranges::any_of(kRanges, [&](const auto& r) { return code >= r[0] && code <= r[1]; });
}

std::string shown(std::string_view bytes, const Character& character) {
    if (!character.is_valid || character.code < 0x20 || character.code == 0x7F)
        return fmt::format("\\x{:02x}", static_cast<unsigned>(character.code));
    if (is_hidden(character.code)) return fmt::format("\\u{{{:x}}}", static_cast<unsigned>(character.code));
    return std::string(bytes);
}

}  // namespace

std::string printable(std::string_view text, std::size_t longest) {
    constexpr std::string_view kDots = "...";
    std::string result;
    std::size_t length = 0;  // characters of `result`
    std::size_t cut_at = 0;  // bytes of it that leave room for the dots
    while (!text.empty()) {
        const Character character = first_character(text);
        const std::string part = shown(text.substr(0, character.bytes), character);
        const std::size_t added = part.size() == character.bytes ? 1 : part.size();
        if (added > longest - length) return result.substr(0, cut_at).append(kDots);
        result += part;
        length += added;
        if (length + kDots.size() <= longest) cut_at = result.size();
        text.remove_prefix(character.bytes);
    }
    return result;
}

std::string quoted_name(std::string_view text) {
    return fmt::format("'{}'", printable(text, kQuotedLength));
}

}  // namespace voxilux

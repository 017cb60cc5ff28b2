#pragma once

// Text from files, made fit for messages, reports and headers. A terminal obeys control characters (ESC ]0;
// sets its title, the bidirectional ones hide what is written), JSON needs valid UTF-8, and nobody reads a
// name of 100,000 characters. Every name and word from a file passes through here before it is shown.

#include <cstddef>
#include <string>
#include <string_view>

namespace voxilux {

inline constexpr std::size_t kPrintableLength = 300;  // characters
inline constexpr std::size_t kUncut = std::string::npos;

// `text` as valid UTF-8 of at most `longest` characters, the last three of which are dots where it was cut.
// Bytes that are not UTF-8 and ASCII control characters become \x1b, other control and formatting characters
// \u{202e}. A backslash stays, so that a second pass changes nothing.
[[nodiscard]] std::string printable(std::string_view text, std::size_t longest = kPrintableLength);

// The same in single quotes, for a name inside a sentence; shorter, because a sentence may hold several.
[[nodiscard]] std::string quoted_name(std::string_view text);

}  // namespace voxilux

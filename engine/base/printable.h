#pragma once

// Text that a file holds, fit for a message, a report and a header. A terminal obeys control characters (ESC
// ]0; sets its title, the bidirectional ones hide what is written), JSON needs valid UTF-8, and a person
// reads no name of 100,000 characters. Every name and word of a file goes through here on its way out.

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

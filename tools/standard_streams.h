#pragma once

// "-" as the name of an input or an output.

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace voxilux {

inline constexpr std::string_view kStandardStream = "-";

// All of standard input. Throws Error(input_refused) when it cannot be read or is over `limit_bytes`.
[[nodiscard]] std::vector<std::byte> read_standard_input(std::size_t limit_bytes = std::size_t{8} << 30);

// Writes to standard output. Throws Error(cannot_write).
void write_standard_output(std::span<const std::byte> bytes);

}  // namespace voxilux

#pragma once

// Printing. A full disk, a closed pipe or a lost terminal does not end a render: text that cannot be printed
// is dropped here. The stream remembers the failure, and main() checks standard output at the end.

#include <cstdio>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace voxilux {

inline void print_text(std::FILE* stream, const std::string& text) {
    (void)std::fwrite(text.data(), 1, text.size(), stream);
}

// To standard output: what the command was asked for.
template <class... Values>
void print_result(fmt::format_string<Values...> form, Values&&... values) {
    print_text(stdout, fmt::format(form, std::forward<Values>(values)...));
}

// To standard error: notes, warnings, progress.
template <class... Values>
void print_message(fmt::format_string<Values...> form, Values&&... values) {
    print_text(stderr, fmt::format(form, std::forward<Values>(values)...));
}

}  // namespace voxilux

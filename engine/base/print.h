#pragma once

// What is printed. A full disk, a closed pipe or a lost terminal never ends the work: the picture counts, so
// that a text which cannot be printed is dropped here. The stream remembers that; main() looks at standard
// output once everything else is done.

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

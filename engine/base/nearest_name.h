#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace voxilux {

// How many letters must be inserted, deleted, replaced or swapped with their neighbour to turn `a` into `b`.
// Source: the optimal string alignment distance (Damerau 1964) by the dynamic programming of Wagner and
// Fischer 1974.
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

// The name that a person who typed `typed` most likely meant: the nearest one, if at most two or a third of
// its letters are wrong. Of equally near names, the first.
[[nodiscard]] std::optional<std::string_view> nearest_name(std::string_view typed,
                                                           std::span<const std::string_view> names);

// "; did you mean 'x'?" or, when nothing is near, "; known: 'a', 'b'". Empty when there are no names.
[[nodiscard]] std::string name_hint(std::string_view typed, std::span<const std::string_view> names);

}  // namespace voxilux

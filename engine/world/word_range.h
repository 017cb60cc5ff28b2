#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace voxilux {

// The words first <= i < end of an array.
struct WordRange {
    std::size_t first = 0;
    std::size_t end = 0;
};

// Ascending ranges that cover all of these. Those with few words between them are joined.
[[nodiscard]] std::vector<WordRange> joined_ranges(std::vector<WordRange> ranges);

// Ascending ranges that cover all words in which two arrays of one size differ.
[[nodiscard]] std::vector<WordRange> differing_words(std::span<const std::uint32_t> a,
                                                     std::span<const std::uint32_t> b);

}  // namespace voxilux

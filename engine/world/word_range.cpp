#include "world/word_range.h"

#include <algorithm>

#include "base/assert.h"

namespace voxilux {
namespace {

// Copying so many words costs less than an upload of its own.
constexpr std::size_t kMaxGap = 256;

}  // namespace

std::vector<WordRange> joined_ranges(std::vector<WordRange> ranges) {
    std::ranges::sort(ranges, {}, &WordRange::first);
    std::size_t count = 0;
    for (const WordRange& range : ranges) {
        if (count > 0 && range.first <= ranges[count - 1].end + kMaxGap)
            ranges[count - 1].end = std::max(ranges[count - 1].end, range.end);
        else
            ranges[count++] = range;
    }
    ranges.resize(count);
    return ranges;
}

std::vector<WordRange> differing_words(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
    VX_ASSERT_EQ(a.size(), b.size());
    std::vector<WordRange> ranges;
    for (std::size_t i = 0; i < a.size(); ++i) {
        i = static_cast<std::size_t>(std::mismatch(a.begin() + static_cast<std::ptrdiff_t>(i), a.end(),
                                                   b.begin() + static_cast<std::ptrdiff_t>(i))
                                         .first -
                                     a.begin());
        if (i == a.size()) break;
        if (!ranges.empty() && i <= ranges.back().end + kMaxGap)
            ranges.back().end = i + 1;
        else
            ranges.push_back({i, i + 1});
    }
    return ranges;
}

}  // namespace voxilux

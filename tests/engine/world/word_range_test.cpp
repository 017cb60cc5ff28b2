#include "world/word_range.h"

#include <gtest/gtest.h>

#include <random>

namespace voxilux {
namespace {

// Whether ranges ascend and cover exactly the words that they must, but for gaps.
void expect_covers(const std::vector<WordRange>& ranges, const std::vector<bool>& wanted) {
    std::vector<bool> covered(wanted.size());
    std::size_t last = 0;
    for (const WordRange& range : ranges) {
        ASSERT_LE(last, range.first);
        ASSERT_LT(range.first, range.end);
        last = range.end;
        EXPECT_TRUE(wanted[range.first] && wanted[range.end - 1]) << "ranges begin and end at such words";
        std::fill(covered.begin() + static_cast<std::ptrdiff_t>(range.first),
                  covered.begin() + static_cast<std::ptrdiff_t>(range.end), true);
    }
    for (std::size_t i = 0; i < wanted.size(); ++i)
        EXPECT_TRUE(covered[i] || !wanted[i]) << i;
}

TEST(WordRange, ranges_cover_all_words_that_differ) {
    std::mt19937 dice(5);
    for (const unsigned rarity : {2u, 50u, 900u, 100000u}) {
        std::vector<std::uint32_t> a(20000, 7), b = a;
        std::vector<bool> differs(a.size());
        std::vector<WordRange> words;
        for (std::size_t i = 0; i < a.size(); ++i) {
            if (dice() % rarity != 0) continue;
            b[i] = 8;
            differs[i] = true;
            words.insert(words.begin() + static_cast<std::ptrdiff_t>(dice() % (words.size() + 1)),
                         {i, i + 1});
        }
        expect_covers(differing_words(a, b), differs);
        expect_covers(joined_ranges(words), differs);
        EXPECT_EQ(differing_words(a, b).size(), joined_ranges(words).size());
    }
    EXPECT_TRUE(differing_words({}, {}).empty());
    EXPECT_TRUE(joined_ranges({}).empty());
    EXPECT_EQ(joined_ranges({{500, 900}, {0, 3}, {600, 700}}).size(), 2u);
}

}  // namespace
}  // namespace voxilux

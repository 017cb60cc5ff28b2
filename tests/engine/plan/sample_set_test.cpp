// Sets of samples, compared with sets of numbers.

#include "plan/sample_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <random>
#include <set>

namespace voxilux::test {
namespace {

using Numbers = std::set<std::uint32_t>;

Numbers numbers_of(const SampleSet& set) {
    Numbers numbers;
    for (std::uint32_t i = 0; i < set.size(); ++i)
        numbers.insert(set.sample(i));
    EXPECT_EQ(numbers.size(), set.size());
    return numbers;
}

SampleSet set_of(const Numbers& numbers) {
    SampleSet set;
    for (const std::uint32_t number : numbers)
        set.add(SampleSet::shard(number, 1, number + 1));
    return set;
}

Numbers some_numbers(std::mt19937& random) {
    Numbers numbers;
    for (std::uint32_t n = random() % 12; n > 0; --n)
        numbers.insert(random() % 24);
    return numbers;
}

TEST(SampleSet, operations_are_those_of_sets_of_numbers) {
    std::mt19937 random(1);
    for (int round = 0; round < 2000; ++round) {
        const Numbers a = some_numbers(random), b = some_numbers(random);
        const SampleSet set = set_of(a), other = set_of(b);
        ASSERT_EQ(numbers_of(set), a);
        Numbers both, all = a, lacking;
        std::ranges::set_intersection(a, b, std::inserter(both, both.end()));
        all.insert(b.begin(), b.end());
        SampleSet sum = set;
        sum.add(other);
        ASSERT_EQ(numbers_of(sum), all);
        ASSERT_EQ(sum, set_of(all)) << "one form for one set";
        ASSERT_EQ(set.common(other).has_value(), !both.empty());
        if (!both.empty()) ASSERT_EQ(*set.common(other), *both.begin());
        for (std::uint32_t i = 0; i < 20; ++i) {
            if (!a.contains(i)) lacking.insert(i);
        }
        ASSERT_EQ(numbers_of(set.missing(20)), lacking);
        ASSERT_EQ(set.is_leading(), a.empty() || *a.rbegin() + 1 == a.size());
    }
}

TEST(SampleSet, text_gives_back_the_set) {
    std::mt19937 random(2);
    for (int round = 0; round < 2000; ++round) {
        const SampleSet set = set_of(some_numbers(random));
        if (set.empty()) continue;
        ASSERT_EQ(SampleSet::parse(set.text()), set) << set.text();
    }
    EXPECT_EQ(SampleSet::leading(8).text(), "0-7");
    EXPECT_EQ(SampleSet::shard(1, 3, 12).text(), "1-10x3");
    EXPECT_EQ(set_of({0, 1, 4, 6, 8, 10, 11}).text(), "0-1,4-8x2,10-11");
    EXPECT_EQ(set_of({3, 5}).text(), "3,5");
    EXPECT_EQ(SampleSet().text(), "");
}

TEST(SampleSet, other_texts_are_none) {
    for (const char* text :
         {"", "-1", "1-", "3-2", "0-3,", ",1", "0-3,2", "0 - 3", "1x", "1-5x0", "a", "0-3;5", "4294967296",
          "0-4294967295", "0-4000000000x2", "1,,2", "+1", "0-7x2,6"})
        EXPECT_FALSE(SampleSet::parse(text)) << text;
    EXPECT_EQ(SampleSet::parse("5x2"), SampleSet::parse("5"));
    EXPECT_EQ(SampleSet::parse("4,0-3"), SampleSet::leading(5)) << "in any order";
}

TEST(SampleSet, text_in_any_order_is_read_in_time_in_proportion) {
    EXPECT_EQ(SampleSet::parse("9,0-2,4-5"), SampleSet::parse("0-2,4-5,9"));
    EXPECT_FALSE(SampleSet::parse("4-9,0-4").has_value());
    std::string text = "0";
    for (int i = 1; i < 200000; ++i)
        text += "," + std::to_string(7 * i % 200003 * 2);  // each even number at most once, in no order
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(SampleSet::parse(text)->size(), 200000u);
    // Takes a tenth of a second; comparing each number with all before it would take minutes.
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

TEST(SampleSet, first_samples_and_their_parity_are_those_one_by_one) {
    for (std::uint32_t count = 1; count <= 6; ++count) {
        for (std::uint32_t index = 0; index < count; ++index) {
            const SampleSet set = SampleSet::shard(index, count, 20);
            std::uint32_t even = 0;
            for (std::uint32_t done = 0; done < set.size(); ++done) {
                ASSERT_EQ(set.sample(done), index + count * done);
                ASSERT_EQ(set.even_samples(done), even);
                ASSERT_EQ(set.prefix(done), SampleSet::shard(index, count, index + count * done));
                even += set.sample(done) % 2 == 0 ? 1 : 0;
            }
        }
    }
}

// A film that goes past its last sample, and one of all samples, which is the empty set.
TEST(SampleSet, numbers_go_on_after_its_last) {
    const SampleSet set = set_of({2, 5});
    EXPECT_EQ(set.sample(2), 6u);
    EXPECT_EQ(set.prefix(4), set_of({2, 5, 6, 7}));
    EXPECT_EQ(set.even_samples(4), 2u);
    EXPECT_EQ(SampleSet().sample(7), 7u);
    EXPECT_EQ(SampleSet().prefix(7), SampleSet::leading(7));
    const std::uint32_t most = std::numeric_limits<std::uint32_t>::max();
    EXPECT_EQ(SampleSet().even_samples(most), most / 2 + 1);
    EXPECT_EQ(SampleSet::leading(most).size(), most);
}

}  // namespace
}  // namespace voxilux::test

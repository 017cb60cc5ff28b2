#include "scene/alias_table.h"

#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "support/statistics.h"

namespace voxilux {
namespace {

std::vector<double> random_powers(std::size_t count) {
    test::TestRandom random(8);
    std::vector<double> powers(count);
    for (double& power : powers)
        power = std::exp(random.uniform(-3.0, 3.0));
    return powers;
}

// Pearson's statistic of draws against what the powers promise.
double chi_square_of(const std::vector<double>& powers, const std::vector<double>& promised) {
    const auto table = build_alias_table(powers);
    constexpr int kDraws = 1000000;
    test::TestRandom random(17);
    std::vector<std::uint64_t> seen(powers.size(), 0);
    for (int i = 0; i < kDraws; ++i) {
        const std::uint32_t bucket =
            gpu::alias_bucket(random.bits32(), static_cast<std::uint32_t>(table.size()));
        const auto u = static_cast<float>(random.bits32() >> 8) * 0x1p-24f;
        ++seen.at(gpu::alias_choice(table.at(bucket), bucket, u));
    }
    double sum = 0.0;
    for (const double power : promised)
        sum += power;
    std::vector<double> expected;
    for (const double power : promised)
        expected.push_back(kDraws * power / sum);
    return test::chi_square(seen, expected);
}

TEST(AliasTable, draws_by_power) {
    const std::vector<double> powers = random_powers(200);
    EXPECT_LT(chi_square_of(powers, powers), test::chi_square_critical_99(199));
    const std::vector<double> equal(1000, 4.5);
    EXPECT_LT(chi_square_of(equal, equal), test::chi_square_critical_99(999));
}

TEST(AliasTable, powers_off_by_a_twentieth_are_caught) {
    const std::vector<double> powers = random_powers(200);
    std::vector<double> moved = powers;
    for (std::size_t i = 0; i < moved.size(); i += 2)
        moved[i] *= 1.05;
    EXPECT_GT(chi_square_of(powers, moved), test::chi_square_critical_99(199));
}

// The probabilities that the table really gives, from its buckets alone.
std::vector<double> exact_probabilities(const std::vector<gpu::AliasEntry>& table) {
    std::vector<double> probabilities(table.size(), 0.0);
    for (std::size_t i = 0; i < table.size(); ++i) {
        const double keep = table[i].keep;
        probabilities[i] += keep / static_cast<double>(table.size());
        probabilities.at(table[i].other) += (1.0 - keep) / static_cast<double>(table.size());
    }
    return probabilities;
}

void expect_sound(const std::vector<double>& powers) {
    const auto table = build_alias_table(powers);
    ASSERT_EQ(table.size(), powers.size());
    const std::vector<double> exact = exact_probabilities(table);
    const auto count = static_cast<double>(powers.size());
    double total = 0.0, sum = 0.0;
    for (const double power : powers)
        total += power / count;
    for (std::size_t i = 0; i < table.size(); ++i) {
        EXPECT_NEAR(table[i].pdf, exact[i], 1e-7 * exact[i]) << i;
        EXPECT_EQ(table[i].pdf > 0.0f, powers[i] > 0.0) << i;
        EXPECT_EQ(table[i].keep * 0x1p24f, std::floor(table[i].keep * 0x1p24f)) << i;
        const double want = powers[i] / count / total;
        EXPECT_NEAR(exact[i], want, 0x1p-24 + 1e-12) << i;
        sum += exact[i];
    }
    EXPECT_NEAR(sum, 1.0, 1e-10);
}

TEST(AliasTable, extreme_powers_have_a_sound_pdf) {
    expect_sound({1.0});
    expect_sound({1e-30});
    expect_sound({1e30, 1e-30});
    expect_sound({0.0, 1e-30, 1e30, 1.0, 0.0});
    expect_sound({0.0, 0.0, 5.0});
    expect_sound(std::vector<double>(64, 1e308));
    expect_sound(random_powers(1000));
    std::vector<double> one_in_many(100000, 0.0);
    one_in_many[77777] = 3.0;
    expect_sound(one_in_many);
}

TEST(AliasTable, no_power_gives_no_table) {
    EXPECT_TRUE(build_alias_table({}).empty());
    EXPECT_TRUE(build_alias_table(std::vector<double>(5, 0.0)).empty());
}

TEST(AliasBucket, is_the_high_word_of_the_product) {
    test::TestRandom random(2);
    for (int i = 0; i < 100000; ++i) {
        const std::uint32_t bits = i == 0 ? 0xFFFFFFFFu : random.bits32();
        const std::uint32_t n = i % 2 == 0 ? 0xFFFFFFFFu : random.bits32() >> (random.bits32() % 32);
        EXPECT_EQ(gpu::alias_bucket(bits, n),
                  static_cast<std::uint32_t>((static_cast<std::uint64_t>(bits) * n) >> 32));
    }
}

}  // namespace
}  // namespace voxilux

#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

// Statistics for tests of random numbers, all in double.
namespace voxilux::test {

// A test at significance 0.01 fails by chance in one run of a hundred. Seeds are fixed, so a test that passes
// keeps passing.
inline constexpr double kNormalQuantile99 = 2.3263478740408408;

// Pearson's statistic: sum of (seen - expected)^2 / expected. Both spans have one entry per bin, expected >
// 0.
inline double chi_square(std::span<const std::uint64_t> seen, std::span<const double> expected) {
    double sum = 0.0;
    for (std::size_t bin = 0; bin < seen.size(); ++bin) {
        const double difference = static_cast<double>(seen[bin]) - expected[bin];
        sum += difference * difference / expected[bin];
    }
    return sum;
}

// The value that Pearson's statistic passes with probability 0.01. Source: Wilson and Hilferty 1931, good to
// 3 digits from 10 degrees of freedom on.
inline double chi_square_critical_99(std::size_t degrees_of_freedom) {
    const double k = static_cast<double>(degrees_of_freedom);
    const double cube_root = 1.0 - 2.0 / (9.0 * k) + kNormalQuantile99 * std::sqrt(2.0 / (9.0 * k));
    return k * cube_root * cube_root * cube_root;
}

// SplitMix64 (Steele, Lea and Flood 2014): the tests' own source of inputs, unrelated to the hashes under
// test.
class TestRandom {
  public:
    explicit TestRandom(std::uint64_t seed) : state_(seed) {}

    std::uint64_t bits64() {
        state_ += 0x9E3779B97F4A7C15ull;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
        return z ^ (z >> 31);
    }
    std::uint32_t bits32() { return static_cast<std::uint32_t>(bits64() >> 32); }
    // Uniform in [low, high).
    double uniform(double low, double high) {
        return low + (high - low) * static_cast<double>(bits64() >> 11) * 0x1p-53;
    }

  private:
    std::uint64_t state_;
};

}  // namespace voxilux::test

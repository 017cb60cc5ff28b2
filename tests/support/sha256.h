#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

// SHA-256 in hexadecimal, FIPS 180-4, for comparing bytes with digests that others have computed. The
// constants are computed as the standard defines them: fractional parts of roots of the first primes.
namespace sha256 {

// First 32 bits of the fraction of the `root`-th root (2 or 3) of `prime`, by integer bisection: exact.
inline std::uint32_t root_fraction(std::uint64_t prime, int root) {
    using Wide = unsigned __int128;
    std::uint64_t low = 0, high = std::uint64_t{1} << 37;  // the root, scaled by 2^32
    while (high - low > 1) {
        const std::uint64_t middle = (low + high) / 2;
        const Wide square = Wide{middle} * middle;
        // Compares middle^root with prime * 2^(32 root), without overflow: 2^111 for cubes.
        const bool is_below =
            root == 2 ? square <= (Wide{prime} << 64) : square * middle <= (Wide{prime} << 96);
        (is_below ? low : high) = middle;
    }
    return static_cast<std::uint32_t>(low);
}

inline std::vector<std::uint64_t> first_primes(std::size_t count) {
    std::vector<std::uint64_t> primes;
    for (std::uint64_t n = 2; primes.size() < count; ++n) {
        bool is_prime = true;
        for (const std::uint64_t p : primes)
            is_prime = is_prime && n % p != 0;
        if (is_prime) primes.push_back(n);
    }
    return primes;
}

inline void compress(std::array<std::uint32_t, 8>& state, const std::uint8_t* block,
                     const std::array<std::uint32_t, 64>& k) {
    std::array<std::uint32_t, 64> w{};
    for (std::size_t i = 0; i < 16; ++i) {
        for (std::size_t b = 0; b < 4; ++b)
            w[i] = w[i] << 8 | block[4 * i + b];
    }
    for (std::size_t i = 16; i < 64; ++i) {
        const std::uint32_t s0 = std::rotr(w[i - 15], 7) ^ std::rotr(w[i - 15], 18) ^ (w[i - 15] >> 3);
        const std::uint32_t s1 = std::rotr(w[i - 2], 17) ^ std::rotr(w[i - 2], 19) ^ (w[i - 2] >> 10);
        w[i] = w[i - 16] + s0 + w[i - 7] + s1;
    }
    auto [a, b, c, d, e, f, g, h] = state;
    for (std::size_t i = 0; i < 64; ++i) {
        const std::uint32_t s1 = std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25);
        const std::uint32_t t1 = h + s1 + ((e & f) ^ (~e & g)) + k[i] + w[i];
        const std::uint32_t s0 = std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22);
        const std::uint32_t t2 = s0 + ((a & b) ^ (a & c) ^ (b & c));
        h = g, g = f, f = e, e = d + t1, d = c, c = b, b = a, a = t1 + t2;
    }
    const std::uint32_t added[8] = {a, b, c, d, e, f, g, h};
    for (std::size_t i = 0; i < 8; ++i)
        state[i] += added[i];
}

inline std::string hex(std::span<const std::uint8_t> data) {
    std::array<std::uint32_t, 64> k{};
    std::array<std::uint32_t, 8> state{};
    const auto primes = first_primes(64);
    for (std::size_t i = 0; i < 64; ++i)
        k[i] = root_fraction(primes[i], 3);
    for (std::size_t i = 0; i < 8; ++i)
        state[i] = root_fraction(primes[i], 2);
    std::vector<std::uint8_t> padded(data.begin(), data.end());
    padded.push_back(0x80);
    while (padded.size() % 64 != 56)
        padded.push_back(0);
    for (int shift = 56; shift >= 0; shift -= 8)
        padded.push_back(static_cast<std::uint8_t>(std::uint64_t{data.size()} * 8 >> shift));
    for (std::size_t i = 0; i < padded.size(); i += 64)
        compress(state, padded.data() + i, k);
    std::string out;
    for (const std::uint32_t word : state)
        out += fmt::format("{:08x}", word);
    return out;
}

}  // namespace sha256

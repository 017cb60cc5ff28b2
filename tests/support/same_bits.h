#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

#include <fmt/format.h>

namespace voxilux::test {

// What a comparison of two arrays of structs found: how many elements differ, and which is the first.
struct BitDifference {
    std::size_t count = 0;
    std::size_t first = 0;
    std::string detail;  // the first differing 32-bit word of that element, both ways
};

// Compares word by word; the structs must be made of 32-bit words without padding.
template <typename Struct>
BitDifference differing_bits(std::span<const Struct> got, std::span<const Struct> want) {
    static_assert(sizeof(Struct) % 4 == 0);
    BitDifference result;
    for (std::size_t i = 0; i < want.size(); ++i) {
        if (i < got.size() && std::memcmp(&got[i], &want[i], sizeof(Struct)) == 0) continue;
        if (result.count++ > 0) continue;
        result.first = i;
        std::vector<std::uint32_t> a(sizeof(Struct) / 4);
        std::vector<std::uint32_t> b(sizeof(Struct) / 4);
        if (i < got.size()) std::memcpy(a.data(), &got[i], sizeof(Struct));
        std::memcpy(b.data(), &want[i], sizeof(Struct));
        const auto word =
            static_cast<std::size_t>(std::mismatch(a.begin(), a.end(), b.begin()).first - a.begin());
        result.detail = fmt::format("word {}: got {:#010x} ({}), want {:#010x} ({})", word, a[word],
                                    std::bit_cast<float>(a[word]), b[word], std::bit_cast<float>(b[word]));
    }
    return result;
}

}  // namespace voxilux::test

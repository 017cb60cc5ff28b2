#pragma once

#include <cstdint>

namespace voxilux {

// The hash of Fowler, Noll and Vo, variant 1a with 64 bits, over units of any size: start with kFnvStart and
// add one unit after the other. Each step is a bijection of the state, so that one changed unit always
// changes the hash. It detects damage, not forgery.
inline constexpr std::uint64_t kFnvStart = 0xcbf29ce484222325u;

[[nodiscard]] constexpr std::uint64_t fnv1a(std::uint64_t hash, std::uint64_t unit) {
    return (hash ^ unit) * 0x100000001b3u;
}

}  // namespace voxilux

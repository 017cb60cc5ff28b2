#pragma once

#include <cstdint>

namespace voxilux {

inline constexpr std::uint32_t kMaxShards = 1u << 20;

// A share of a render: of its samples 0, 1, 2, ... every `count`th one from number `index` on. A render that
// is not shared is shard 0 of 1. Samples depend on their number alone, so the sums of all shards add up to
// those of the whole render.
struct Shard {
    std::uint32_t index = 0;  // below count
    std::uint32_t count = 1;

    bool operator==(const Shard&) const = default;

    [[nodiscard]] bool is_whole() const { return count == 1; }

    // How many of the first `spp` samples of the render are in it.
    [[nodiscard]] std::uint32_t samples(std::uint32_t spp) const {
        return spp > index ? (spp - index - 1) / count + 1 : 0;
    }

    // The number, in the render, of its sample `done`.
    [[nodiscard]] std::uint32_t sample(std::uint32_t done) const { return index + count * done; }

    // How many of its first `done` samples have an even number in the render.
    [[nodiscard]] std::uint32_t even_samples(std::uint32_t done) const {
        if (count % 2 == 0) return index % 2 == 0 ? done : 0;
        return index % 2 == 0 ? done - done / 2 : done / 2;
    }
};

}  // namespace voxilux

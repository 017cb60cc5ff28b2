#pragma once

#include <cstdint>

#include <glm/glm.hpp>

namespace voxilux {

// The cells lo <= c < hi.
struct Box {
    glm::ivec3 lo{0};
    glm::ivec3 hi{0};

    bool operator==(const Box&) const = default;

    [[nodiscard]] bool empty() const { return lo.x >= hi.x || lo.y >= hi.y || lo.z >= hi.z; }
    // Up to 2^31 per axis, hence 64 bits.
    [[nodiscard]] glm::i64vec3 extent() const { return glm::i64vec3(hi) - glm::i64vec3(lo); }
    // Below 2^63 cells, and not empty.
    [[nodiscard]] std::int64_t volume() const {
        const glm::i64vec3 e = extent();
        return e.x * e.y * e.z;
    }
};

// The smallest box that holds both; an empty one adds nothing.
[[nodiscard]] inline Box united(const Box& a, const Box& b) {
    if (a.empty()) return b;
    if (b.empty()) return a;
    return {glm::min(a.lo, b.lo), glm::max(a.hi, b.hi)};
}

}  // namespace voxilux

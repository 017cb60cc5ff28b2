#include "voxelizer/linear_to_srgb.h"

#include <array>
#include <cmath>
#include <limits>

#include "base/colour.h"

namespace voxilux {
namespace {

constexpr int kBuckets = 4096;

struct Table {
    std::array<float, 257> from;                   // the smallest linear value that rounds to each byte
    std::array<std::uint8_t, kBuckets + 1> start;  // the byte at the low end of a bucket
};

Table make_table() {
    Table table;
    for (int byte = 0; byte < 256; ++byte)
        table.from[static_cast<std::size_t>(byte)] = static_cast<float>(decode_srgb((byte - 0.5) / 255.0));
    table.from[256] = std::numeric_limits<float>::infinity();
    std::uint8_t byte = 0;
    for (int bucket = 0; bucket <= kBuckets; ++bucket) {
        const float low = static_cast<float>(bucket) / kBuckets;
        while (byte < 255 && table.from[byte + std::size_t{1}] <= low)
            ++byte;
        table.start[static_cast<std::size_t>(bucket)] = byte;
    }
    return table;
}

const Table kTable = make_table();

std::uint8_t srgb_byte(float linear) {
    const float inside = linear > 0.0f ? std::min(linear, 1.0f) : 0.0f;  // NaN also gives 0
    const std::uint8_t byte = kTable.start[static_cast<std::size_t>(inside * kBuckets)];
    // A bucket contains at most one step: steps are at least 1 / (12.92 * 255) apart.
    return static_cast<std::uint8_t>(byte + (kTable.from[byte + std::size_t{1}] <= inside ? 1 : 0));
}

}  // namespace

glm::u8vec3 srgb_bytes(glm::vec3 linear) {
    return {srgb_byte(linear.r), srgb_byte(linear.g), srgb_byte(linear.b)};
}

}  // namespace voxilux

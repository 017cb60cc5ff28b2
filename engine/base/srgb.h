#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace voxilux {

// The transfer function of IEC 61966-2-1 (sRGB), both ways, for values in [0,1]. Thresholds are the
// standard's.
[[nodiscard]] inline float encode_srgb(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

[[nodiscard]] inline float decode_srgb(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

// The linear value of each 8-bit sRGB code.
[[nodiscard]] inline std::array<float, 256> decoded_srgb_codes() {
    std::array<float, 256> decoded;
    for (std::size_t code = 0; code < decoded.size(); ++code)
        decoded[code] = decode_srgb(static_cast<float>(code) / 255.0f);
    return decoded;
}

// The nearest 8-bit sRGB code of a linear value: below 0 and NaN give 0, above 1 gives 255.
[[nodiscard]] inline std::uint8_t srgb_code(float linear) {
    if (!(linear > 0.0f)) return 0;
    if (linear >= 1.0f) return 255;
    return static_cast<std::uint8_t>(encode_srgb(linear) * 255.0f + 0.5f);
}

}  // namespace voxilux

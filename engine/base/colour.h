#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <glm/glm.hpp>

#include "shared/tone_curve.h"

namespace voxilux {

// Relative luminance of a linear Rec. 709 colour (ITU-R BT.709-6, item 3.2), in the precision of its
// components.
template <class Rgb>
[[nodiscard]] constexpr auto luminance(const Rgb& rgb) {
    using Float = std::remove_cvref_t<decltype(rgb[0])>;
    return Float(0.2126) * rgb[0] + Float(0.7152) * rgb[1] + Float(0.0722) * rgb[2];
}

// The inverse of gpu::encode_srgb, whose thresholds are those of the standard, for values in [0,1].
[[nodiscard]] inline double decode_srgb(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

// The linear value of an 8-bit sRGB code.
[[nodiscard]] inline float linear_from_srgb(std::uint8_t code) {
    return static_cast<float>(decode_srgb(code / 255.0));
}

// Linear Rec. 709 of 0xRRGGBB.
[[nodiscard]] inline glm::vec3 linear_from_srgb_hex(std::uint32_t rrggbb) {
    const auto component = [&](int shift) {
        return linear_from_srgb(static_cast<std::uint8_t>(rrggbb >> shift));
    };
    return {component(16), component(8), component(0)};
}

// The linear value of each 8-bit sRGB code.
[[nodiscard]] inline std::array<float, 256> decoded_srgb_codes() {
    std::array<float, 256> decoded;
    for (std::size_t code = 0; code < decoded.size(); ++code)
        decoded[code] = linear_from_srgb(static_cast<std::uint8_t>(code));
    return decoded;
}

// The nearest 8-bit sRGB code of a linear value: below 0 and NaN give 0, above 1 gives 255.
[[nodiscard]] inline std::uint8_t srgb_code(float linear) {
    if (!(linear > 0.0f)) return 0;
    if (linear >= 1.0f) return 255;
    return static_cast<std::uint8_t>(gpu::encode_srgb(linear) * 255.0f + 0.5f);
}

}  // namespace voxilux

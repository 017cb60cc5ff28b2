#pragma once

#include <glm/glm.hpp>

namespace voxilux {

// Oklab of an sRGB colour. Equal steps look about equal, and straight lines keep their hue. Source: B.
// Ottosson, "A perceptual color space for image processing", 2020.
[[nodiscard]] glm::vec3 oklab_of(glm::u8vec3 srgb);
// `srgb` in [0, 255], not rounded.
[[nodiscard]] glm::vec3 oklab_of(glm::vec3 srgb);

// The nearest sRGB colour.
[[nodiscard]] glm::u8vec3 srgb_of_oklab(glm::vec3 oklab);

// CIELAB under D65 (CIE 15:2004) of an sRGB colour.
[[nodiscard]] glm::dvec3 cielab_of(glm::u8vec3 srgb);

// The distance of two colours in CIELAB, dE76.
[[nodiscard]] double colour_difference(glm::u8vec3 a, glm::u8vec3 b);

}  // namespace voxilux

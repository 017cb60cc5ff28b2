#include "scene/colour.h"

#include <cmath>

namespace voxilux {

float linear_from_srgb(std::uint8_t component) {
    const double s = component / 255.0;
    return static_cast<float>(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
}

glm::vec3 linear_from_srgb_hex(std::uint32_t rrggbb) {
    const auto component = [&](int shift) {
        return linear_from_srgb(static_cast<std::uint8_t>(rrggbb >> shift));
    };
    return {component(16), component(8), component(0)};
}

}  // namespace voxilux

#include "voxelizer/colour_spaces.h"

#include <array>
#include <cmath>

#include "base/colour.h"
#include "voxelizer/linear_to_srgb.h"

namespace voxilux {
namespace {

const std::array<float, 256> kLinear = decoded_srgb_codes();

// Interpolates linearly between the bytes: for means of bytes that are close to each other.
float linear_at(float srgb) {
    const float inside = glm::clamp(srgb, 0.0f, 255.0f);
    const auto low = static_cast<std::size_t>(inside);
    const std::size_t high = std::min<std::size_t>(low + 1, 255);
    return glm::mix(kLinear[low], kLinear[high], inside - static_cast<float>(low));
}

glm::vec3 oklab_of_linear(glm::vec3 c) {
    const float l = std::cbrt(0.4122214708f * c.r + 0.5363325363f * c.g + 0.0514459929f * c.b);
    const float m = std::cbrt(0.2119034982f * c.r + 0.6806995451f * c.g + 0.1073969566f * c.b);
    const float s = std::cbrt(0.0883024619f * c.r + 0.2817188376f * c.g + 0.6299787005f * c.b);
    return {0.2104542553f * l + 0.7936177850f * m - 0.0040720468f * s,
            1.9779984951f * l - 2.4285922050f * m + 0.4505937099f * s,
            0.0259040371f * l + 0.7827717662f * m - 0.8086757660f * s};
}

// CIE 15:2004, section 8.2.1.1.
double lab_response(double x) {
    constexpr double kLimit = 216.0 / 24389.0;
    constexpr double kSlope = 24389.0 / 27.0;
    return x > kLimit ? std::cbrt(x) : (kSlope * x + 16.0) / 116.0;
}

}  // namespace

glm::vec3 oklab_of(glm::u8vec3 srgb) {
    return oklab_of_linear({kLinear[srgb.r], kLinear[srgb.g], kLinear[srgb.b]});
}

glm::vec3 oklab_of(glm::vec3 srgb) {
    return oklab_of_linear({linear_at(srgb.r), linear_at(srgb.g), linear_at(srgb.b)});
}

glm::u8vec3 srgb_of_oklab(glm::vec3 c) {
    const auto cube = [](float x) { return x * x * x; };
    const float l = cube(c.x + 0.3963377774f * c.y + 0.2158037573f * c.z);
    const float m = cube(c.x - 0.1055613458f * c.y - 0.0638541728f * c.z);
    const float s = cube(c.x - 0.0894841775f * c.y - 1.2914855480f * c.z);
    return srgb_bytes({4.0767416621f * l - 3.3077115913f * m + 0.2309699292f * s,
                       -1.2684380046f * l + 2.6097574011f * m - 0.3413193965f * s,
                       -0.0041960863f * l - 0.7034186147f * m + 1.7076147010f * s});
}

glm::dvec3 cielab_of(glm::u8vec3 srgb) {
    const glm::dvec3 c(kLinear[srgb.r], kLinear[srgb.g], kLinear[srgb.b]);
    // Rec. 709 primaries to XYZ, relative to the D65 white.
    const double x = lab_response((0.4124564 * c.r + 0.3575761 * c.g + 0.1804375 * c.b) / 0.95047);
    const double y = lab_response(0.2126729 * c.r + 0.7151522 * c.g + 0.0721750 * c.b);
    const double z = lab_response((0.0193339 * c.r + 0.1191920 * c.g + 0.9503041 * c.b) / 1.08883);
    return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

double colour_difference(glm::u8vec3 a, glm::u8vec3 b) {
    return glm::distance(cielab_of(a), cielab_of(b));
}

}  // namespace voxilux

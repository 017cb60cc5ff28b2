#include "jobs/price_list/difference_map.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/assert.h"
#include "base/colour.h"
#include "estimators/metrics.h"
#include "shared/false_colour.h"

namespace voxilux {
namespace {

constexpr double kDecades = 3.0;  // range of the scale, below 100 %

}  // namespace

std::array<int, 3> difference_colour(double difference) {
    const double place =
        difference > 0.0 ? std::clamp(1.0 + std::log10(difference) / kDecades, 0.0, 1.0) : 0.0;
    const gpu::vec3 codes = gpu::false_colour(static_cast<float>(place));
    std::array<int, 3> colour{};
    for (int c = 0; c < 3; ++c)
        colour[static_cast<std::size_t>(c)] = static_cast<int>(std::lround(255.0f * codes[c]));
    return colour;
}

Image difference_map(const Image& picture, const Image& reference) {
    const auto x = colour_planes(picture), r = colour_planes(reference);
    VX_ASSERT(x && r && pixel_count(picture) == pixel_count(reference));
    const std::array<std::string, 3> names = {"R", "G", "B"};
    Image map = make_image(picture.width, picture.height, names);
    map.display_referred = true;
    const std::array<float, 256> decoded = decoded_srgb_codes();
    for (std::size_t i = 0; i < pixel_count(picture); ++i) {
        double square = 0.0;
        for (std::size_t c = 0; c < 3; ++c) {
            const double want = static_cast<double>((*r)[c][i]);
            const double off = static_cast<double>((*x)[c][i]) - want;
            square += off * off / (want * want + kRelMseEpsilon) / 3.0;
        }
        const std::array<int, 3> colour = difference_colour(std::sqrt(square));
        for (std::size_t c = 0; c < 3; ++c)
            map.channels[names[c]].pixels[i] = decoded[static_cast<std::size_t>(colour[c])];
    }
    return map;
}

}  // namespace voxilux

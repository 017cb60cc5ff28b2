#include "film/tonemap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/assert.h"
#include "base/colour.h"
#include "shared/tone_curve.h"

namespace voxilux {
namespace {

void count(float value, DisplayImage& display) {
    if (std::isnan(value)) {
        ++display.nan;
    } else if (std::isinf(value)) {
        ++display.infinite;
    } else if (value < 0.0f) {
        ++display.negative;
    }
}

// A colour divided by its alpha.
float straight(float value, float alpha) {
    return alpha > 0.0f ? value / alpha : 0.0f;
}

// The code of a displayed value that covers the fraction `alpha` of a pixel in front of a background.
std::uint8_t code_over(float shown, float alpha, float background) {
    const float behind = gpu::encode_srgb(glm::clamp(background, 0.0f, 1.0f));
    const float code = alpha * gpu::encode_srgb(shown) + (1.0f - alpha) * behind;
    return static_cast<std::uint8_t>(std::clamp(code, 0.0f, 1.0f) * 255.0f + 0.5f);
}

}  // namespace

float tone_map(float linear, ToneMap curve) {
    if (!(linear > 0.0f)) return 0.0f;
    return curve == ToneMap::filmic ? gpu::filmic_curve(linear) : std::min(linear, 1.0f);
}

float automatic_exposure_ev(const Image& image) {
    constexpr double kMiddleGrey = 0.18;
    const auto planes = colour_planes(image);
    VX_ASSERT(planes.has_value());
    double stops = 0.0, count = 0.0;
    for (std::size_t i = 0; i < (*planes)[0].size(); ++i) {
        const double light =
            luminance(std::array<double, 3>{(*planes)[0][i], (*planes)[1][i], (*planes)[2][i]});
        if (!(light > 0.0) || std::isinf(light)) continue;
        stops += std::log2(light);
        count += 1.0;
    }
    return count > 0.0 ? static_cast<float>(std::log2(kMiddleGrey) - stops / count) : 0.0f;
}

DisplayImage to_display(const Image& image, const ToneMapOptions& options) {
    const auto planes = colour_planes(image);
    VX_ASSERT(planes.has_value());
    const std::array<std::string, 3> names = {"R", "G", "B"};
    DisplayImage display{.image = make_image(image.width, image.height, names)};
    display.image.display_referred = true;
    const float ev = options.exposure_ev ? *options.exposure_ev : automatic_exposure_ev(image);
    const float scale = std::min(std::exp2(ev), std::numeric_limits<float>::max());
    const std::array<float, 256> decoded = decoded_srgb_codes();
    const auto coverage = image.channels.find("A");
    const std::vector<float>* alpha = coverage != image.channels.end() ? &coverage->second.pixels : nullptr;
    if (alpha != nullptr && !options.background) display.image.channels["A"].pixels = *alpha;
    const std::array<float, 3> magenta = {1.0f, 0.0f, 1.0f};
    for (std::size_t c = 0; c < names.size(); ++c) {
        std::vector<float>& shown = display.image.channels[names[c]].pixels;
        for (std::size_t i = 0; i < shown.size(); ++i) {
            const float value = (*planes)[c][i];
            count(value, display);
            const bool has_nan =
                options.debug_nan &&
                (std::isnan((*planes)[0][i]) || std::isnan((*planes)[1][i]) || std::isnan((*planes)[2][i]));
            if (has_nan) {
                shown[i] = magenta[c];
                continue;
            }
            const float own = alpha != nullptr ? straight(value, (*alpha)[i]) : value;
            const float mapped = tone_map(own * scale, options.curve);
            const bool is_laid = alpha != nullptr && options.background.has_value();
            shown[i] =
                decoded[is_laid ? code_over(mapped, (*alpha)[i], (*options.background)[static_cast<int>(c)])
                                : srgb_code(mapped)];
        }
    }
    return display;
}

}  // namespace voxilux

// FLIP in two halves that meet in one exponent. Colour: both images go to the opponent space YCxCz, are
// blurred by the contrast sensitivity of the eye at the viewing distance, and their distance is measured in
// Hunt-adjusted CIELab with the HyAB metric. Features: edges and points are found in the luminance by
// derivatives of a Gaussian as wide as the eye resolves. error = colour^(1 - feature). Every kernel is a
// product (or, for Cz, a sum of two products) of 1D kernels, so images are filtered row- and columnwise;
// borders repeat the outermost pixel. Symbols are those of Andersson et al. 2020.

#include "estimators/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/assert.h"
#include "base/colour.h"
#include "base/statistics.h"
#include "estimators/flip_colour.h"
#include "estimators/flip_filter.h"

namespace voxilux {
namespace {

using flip_colour::hunt_lab_of;
using flip_colour::Vec3;
using flip_filter::filter;
using flip_filter::Kernels;
using flip_filter::Plane;

constexpr double kColourExponent = 0.7;    // q_c
constexpr double kColourKnee = 0.4;        // p_c, share of the largest distance where the remapping bends
constexpr double kColourKneeValue = 0.95;  // p_t, the error there
constexpr double kFeatureExponent = 0.5;   // q_f

// HDR-FLIP: the tone curve (Narkowicz 2016 with pre-exposure 0.6) as (a x^2 + b x) / (d x^2 + e x + f), and
// the displayed luminance that the darkest and the brightest exposure give to the maximum and the median.
constexpr double kCurveA = 0.6 * 0.6 * 2.51, kCurveB = 0.6 * 0.03;
constexpr double kCurveD = 0.6 * 0.6 * 2.43, kCurveE = 0.6 * 0.59, kCurveF = 0.14;
constexpr double kShownLuminance = 0.85;
constexpr double kMinMedian = std::numeric_limits<float>::epsilon();  // luminance; keeps the exposures finite
constexpr int kMaxExposures = 64;  // 2^-23 to 2^41 between median and maximum; no image has more

// HyAB distance raised to q_c.
double colour_distance(const Vec3& a, const Vec3& b) {
    return std::pow(std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]), kColourExponent);
}

// Redistributes the error: small distances get most of the range, and those that saturate anyway get the
// rest.
double remap_distance(double distance, double largest) {
    const double knee = kColourKnee * largest;
    if (distance < knee) return distance * kColourKneeValue / knee;
    return kColourKneeValue + (distance - knee) / (largest - knee) * (1.0 - kColourKneeValue);
}

// An image in the opponent colour space, one plane for each component.
struct Opponent {
    int width = 0, height = 0;
    std::array<Plane, 3> planes;
};

Opponent to_opponent(const std::array<Plane, 3>& rgb, int width, int height) {
    Opponent result{.width = width, .height = height};
    for (Plane& plane : result.planes)
        plane.resize(rgb[0].size());
    for (std::size_t i = 0; i < rgb[0].size(); ++i) {
        const Vec3 value = flip_colour::opponent_of({rgb[0][i], rgb[1][i], rgb[2][i]});
        for (std::size_t c = 0; c < 3; ++c)
            result.planes[c][i] = static_cast<float>(value[c]);
    }
    return result;
}

// What the eye sees of an image: blurred, back to displayable colour, in Hunt-adjusted CIELab.
std::vector<Vec3> perceived_colours(const Opponent& image, const Kernels& k) {
    const int w = image.width, h = image.height;
    const Plane y = filter(image.planes[0], w, h, k.achromatic, k.achromatic);
    const Plane cx = filter(image.planes[1], w, h, k.red_green, k.red_green);
    const Plane cz1 = filter(image.planes[2], w, h, k.blue_yellow_1, k.blue_yellow_1);
    const Plane cz2 = filter(image.planes[2], w, h, k.blue_yellow_2, k.blue_yellow_2);
    std::vector<Vec3> result(y.size());
    for (std::size_t i = 0; i < y.size(); ++i) {
        Vec3 rgb = flip_colour::rgb_of({y[i], cx[i], double{cz1[i]} + cz2[i]});
        for (double& c : rgb)
            c = std::clamp(c, 0.0, 1.0);
        result[i] = hunt_lab_of(rgb);
    }
    return result;
}

// Lengths of the gradient and of the second derivatives of the luminance, per pixel.
struct Features {
    Plane edge, point;
};

Plane lengths(const Plane& x, const Plane& y) {
    Plane result(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
        result[i] = std::hypot(x[i], y[i]);
    return result;
}

Features find_features(const Opponent& image, const Kernels& k) {
    const int w = image.width, h = image.height;
    Plane luminance = image.planes[0];
    for (float& v : luminance)
        v = (v + 16.0f) / 116.0f;
    return {lengths(filter(luminance, w, h, k.edge, k.gauss), filter(luminance, w, h, k.gauss, k.edge)),
            lengths(filter(luminance, w, h, k.point, k.gauss), filter(luminance, w, h, k.gauss, k.point))};
}

Plane compare_opponents(const Opponent& reference, const Opponent& test, const Kernels& kernels) {
    const std::vector<Vec3> reference_colours = perceived_colours(reference, kernels);
    const std::vector<Vec3> test_colours = perceived_colours(test, kernels);
    const Features a = find_features(reference, kernels);
    const Features b = find_features(test, kernels);
    const double largest = colour_distance(hunt_lab_of({0.0, 1.0, 0.0}), hunt_lab_of({0.0, 0.0, 1.0}));
    Plane error(reference_colours.size());
    for (std::size_t i = 0; i < error.size(); ++i) {
        const double colour = remap_distance(colour_distance(reference_colours[i], test_colours[i]), largest);
        const double edge = std::abs(a.edge[i] - b.edge[i]), point = std::abs(a.point[i] - b.point[i]);
        const double feature = std::pow(std::max(edge, point) / std::numbers::sqrt2, kFeatureExponent);
        error[i] = static_cast<float>(std::clamp(std::pow(colour, 1.0 - feature), 0.0, 1.0));
    }
    return error;
}

using ColourPlanes = std::array<std::span<const float>, 3>;

// The colours of an image, or nothing when a value is not finite.
std::optional<ColourPlanes> finite_colours(const Image& image) {
    const auto planes = colour_planes(image);
    if (!planes) return {};
    for (const auto& plane : *planes) {
        if (!std::all_of(plane.begin(), plane.end(), [](float v) { return std::isfinite(v); })) return {};
    }
    return planes;
}

template <class Curve>
Opponent shown(const Image& image, const ColourPlanes& colours, Curve curve) {
    std::array<Plane, 3> rgb;
    for (std::size_t c = 0; c < 3; ++c) {
        rgb[c].resize(colours[c].size());
        std::transform(colours[c].begin(), colours[c].end(), rgb[c].begin(), curve);
    }
    return to_opponent(rgb, image.width, image.height);
}

float expose(float value, double scale_factor) {
    const double x =
        std::min(std::max(double{value}, 0.0) * scale_factor, 1e6);  // far past white, squares finite
    const double shown_value = x * (kCurveA * x + kCurveB) / (x * (kCurveD * x + kCurveE) + kCurveF);
    return static_cast<float>(std::min(shown_value, 1.0));
}

}  // namespace

std::optional<FlipExposures> flip_exposures(const Image& reference) {
    const auto colours = finite_colours(reference);
    if (!colours) return {};
    std::vector<double> luminances(pixel_count(reference));
    for (std::size_t i = 0; i < luminances.size(); ++i) {
        Vec3 positive;
        for (std::size_t c = 0; c < 3; ++c)
            positive[c] = std::max((*colours)[c][i], 0.0f);
        luminances[i] = luminance(positive);
    }
    const double brightest = *std::max_element(luminances.begin(), luminances.end());
    if (!(brightest > kMinMedian)) return {};
    const auto middle = luminances.begin() + static_cast<std::ptrdiff_t>(luminances.size() / 2);
    std::nth_element(luminances.begin(), middle, luminances.end());
    const double median = std::max(*middle, kMinMedian);
    // The input that the curve shows as kShownLuminance: the positive root of a quadratic.
    const double a = kCurveA - kShownLuminance * kCurveD, b = kCurveB - kShownLuminance * kCurveE,
                 c = -kShownLuminance * kCurveF;
    const double half = -0.5 * b / a;
    const double input = half + std::sqrt(half * half - c / a);
    FlipExposures result{.start = std::log2(input / brightest), .stop = std::log2(input / median)};
    result.count = std::clamp(static_cast<int>(std::ceil(result.stop - result.start)), 2, kMaxExposures);
    return result;
}

std::optional<FlipResult> ldr_flip(const Image& reference, const Image& test) {
    VX_ASSERT(reference.width == test.width && reference.height == test.height);
    const auto r = finite_colours(reference), t = finite_colours(test);
    if (!r || !t) return {};
    const auto clamped = [](float v) { return std::clamp(v, 0.0f, 1.0f); };
    return FlipResult{compare_opponents(shown(reference, *r, clamped), shown(test, *t, clamped),
                                        flip_filter::make_kernels(kFlipPixelsPerDegree)),
                      0};
}

std::optional<FlipResult> hdr_flip(const Image& reference, const Image& test) {
    VX_ASSERT(reference.width == test.width && reference.height == test.height);
    const auto r = finite_colours(reference), t = finite_colours(test);
    const auto exposures = flip_exposures(reference);
    if (!r || !t || !exposures) return {};
    const Kernels kernels = flip_filter::make_kernels(kFlipPixelsPerDegree);
    FlipResult result{Plane(pixel_count(reference), 0.0f), exposures->count};
    for (int i = 0; i < exposures->count; ++i) {
        const double step = (exposures->stop - exposures->start) / (exposures->count - 1);
        const double factor = std::exp2(exposures->start + i * step);
        const auto curve = [&](float v) { return expose(v, factor); };
        const Plane error = compare_opponents(shown(reference, *r, curve), shown(test, *t, curve), kernels);
        std::transform(error.begin(), error.end(), result.error.begin(), result.error.begin(),
                       [](float a, float b) { return std::max(a, b); });
    }
    return result;
}

std::optional<FlipResult> flip(const Image& reference, const Image& test) {
    return reference.display_referred && test.display_referred ? ldr_flip(reference, test)
                                                               : hdr_flip(reference, test);
}

double mean_flip(const FlipResult& result, const std::vector<std::size_t>& pixels) {
    CompensatedSum sum;
    for (const std::size_t i : pixels)
        sum.add(result.error[i]);
    return sum.value() / static_cast<double>(pixels.size());
}

}  // namespace voxilux

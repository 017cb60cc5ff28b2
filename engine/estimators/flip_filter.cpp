// The kernels of FLIP. The blurs are the contrast sensitivity functions of Johnson and Fairchild as FLIP uses
// them: a sum of two Gaussians a sqrt(pi/b) exp(-pi^2 d^2 / b) with d in degrees (Andersson et al. 2020,
// spatial filtering). Weights are made in double and applied in float.

#include "estimators/flip_filter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "base/statistics.h"

namespace voxilux::flip_filter {
namespace {

constexpr double kPi = std::numbers::pi;

// The constants a and b of the paper's table; the second term of Y and of Cx has a = 0.
constexpr double kAchromaticB = 0.0047;
constexpr double kRedGreenB = 0.0053;
constexpr double kBlueYellowA1 = 34.1, kBlueYellowB1 = 0.04;
constexpr double kBlueYellowA2 = 13.5, kBlueYellowB2 = 0.025;
constexpr double kWidestB = kBlueYellowB1;
constexpr double kFeatureWidth = 0.082;  // degrees: the width of a line that the eye just resolves as an edge

Kernel sampled_gaussian(double amplitude, double b, int radius, double pixels_per_degree) {
    Kernel kernel;
    for (int i = -radius; i <= radius; ++i) {
        const double degrees = i / pixels_per_degree;
        kernel.push_back(static_cast<float>(amplitude * std::exp(-kPi * kPi * degrees * degrees / b)));
    }
    return kernel;
}

double sum_of(const Kernel& kernel) {
    CompensatedSum sum;
    for (const float w : kernel)
        sum.add(w);
    return sum.value();
}

void scale(Kernel& kernel, double factor) {
    for (float& w : kernel)
        w = static_cast<float>(w * factor);
}

void make_blurs(Kernels& kernels, double ppd) {
    const int radius = static_cast<int>(std::ceil(3.0 * std::sqrt(kWidestB / (2.0 * kPi * kPi)) * ppd));
    kernels.achromatic = sampled_gaussian(1.0, kAchromaticB, radius, ppd);
    kernels.red_green = sampled_gaussian(1.0, kRedGreenB, radius, ppd);
    scale(kernels.achromatic, 1.0 / sum_of(kernels.achromatic));
    scale(kernels.red_green, 1.0 / sum_of(kernels.red_green));
    // A 2D Gaussian of amplitude A is the product of two 1D ones of amplitude sqrt(A); the two terms share
    // one norm.
    const double amplitude_1 = std::sqrt(kBlueYellowA1 * std::sqrt(kPi / kBlueYellowB1));
    const double amplitude_2 = std::sqrt(kBlueYellowA2 * std::sqrt(kPi / kBlueYellowB2));
    kernels.blue_yellow_1 = sampled_gaussian(amplitude_1, kBlueYellowB1, radius, ppd);
    kernels.blue_yellow_2 = sampled_gaussian(amplitude_2, kBlueYellowB2, radius, ppd);
    const double norm = 1.0 / std::hypot(sum_of(kernels.blue_yellow_1), sum_of(kernels.blue_yellow_2));
    scale(kernels.blue_yellow_1, norm);
    scale(kernels.blue_yellow_2, norm);
}

// Positive weights are made to sum to 1 and negative ones to -1.
void normalise_sides(Kernel& kernel) {
    CompensatedSum positive, negative;
    for (const float w : kernel)
        (w > 0.0f ? positive : negative).add(w);
    for (float& w : kernel)
        w = static_cast<float>(w / (w > 0.0f ? positive.value() : -negative.value()));
}

// A Gaussian and its first two derivatives; constant factors drop out in the normalisation.
void make_features(Kernels& kernels, double ppd) {
    const double sigma = 0.5 * kFeatureWidth * ppd;
    const int radius = static_cast<int>(std::ceil(3.0 * sigma));
    for (int x = -radius; x <= radius; ++x) {
        const double g = std::exp(-x * x / (2.0 * sigma * sigma));
        kernels.gauss.push_back(static_cast<float>(g));
        kernels.edge.push_back(static_cast<float>(-x * g));
        kernels.point.push_back(static_cast<float>((x * x / (sigma * sigma) - 1.0) * g));
    }
    scale(kernels.gauss, 1.0 / sum_of(kernels.gauss));
    normalise_sides(kernels.edge);
    normalise_sides(kernels.point);
}

Plane filter_rows(const Plane& in, int width, int height, const Kernel& kernel) {
    const int radius = static_cast<int>(kernel.size() / 2);
    Plane out(in.size());
    std::vector<float> padded(static_cast<std::size_t>(width + 2 * radius));
    for (int y = 0; y < height; ++y) {
        const float* row = in.data() + static_cast<std::ptrdiff_t>(y) * width;
        float* result = out.data() + static_cast<std::ptrdiff_t>(y) * width;
        for (int x = -radius; x < width + radius; ++x)
            padded[static_cast<std::size_t>(x + radius)] = row[std::clamp(x, 0, width - 1)];
        for (std::size_t k = 0; k < kernel.size(); ++k) {
            for (int x = 0; x < width; ++x)
                result[x] += kernel[k] * padded[static_cast<std::size_t>(x) + k];
        }
    }
    return out;
}

Plane filter_columns(const Plane& in, int width, int height, const Kernel& kernel) {
    const int radius = static_cast<int>(kernel.size() / 2);
    Plane out(in.size());
    for (int y = 0; y < height; ++y) {
        float* result = out.data() + static_cast<std::ptrdiff_t>(y) * width;
        for (int k = -radius; k <= radius; ++k) {
            const float* row =
                in.data() + static_cast<std::ptrdiff_t>(std::clamp(y + k, 0, height - 1)) * width;
            const float weight = kernel[static_cast<std::size_t>(k + radius)];
            for (int x = 0; x < width; ++x)
                result[x] += weight * row[x];
        }
    }
    return out;
}

}  // namespace

Kernels make_kernels(double pixels_per_degree) {
    Kernels kernels;
    make_blurs(kernels, pixels_per_degree);
    make_features(kernels, pixels_per_degree);
    return kernels;
}

Plane filter(const Plane& in, int width, int height, const Kernel& along_row, const Kernel& along_column) {
    return filter_columns(filter_rows(in, width, height, along_row), width, height, along_column);
}

}  // namespace voxilux::flip_filter

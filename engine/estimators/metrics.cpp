#include "estimators/metrics.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "base/error.h"
#include "base/printable.h"
#include "base/statistics.h"

namespace voxilux {
namespace {

using ColourPlanes = std::array<std::span<const float>, 3>;

// The first few names of channels, for a message.
std::string names_text(const Image& image) {
    constexpr std::size_t kMostNames = 8;
    std::vector<std::string> names;
    for (const auto& [name, channel] : image.channels) {
        if (names.size() == kMostNames) {
            names.emplace_back("...");
            break;
        }
        names.push_back(quoted_name(name));
    }
    return names.empty() ? "none at all" : fmt::format("{}", fmt::join(names, ", "));
}

ColourPlanes colours_of(const Image& image, const char* which) {
    const auto planes = colour_planes(image);
    if (!planes) {
        throw Error(
            ExitCode::input_refused,
            fmt::format("the {} has no channels R, G, B and no channel Y, but {}", which, names_text(image)));
    }
    return *planes;
}

PixelBox checked_box(int width, int height, const std::optional<PixelBox>& wanted) {
    const PixelBox box = wanted.value_or(PixelBox{.x1 = width, .y1 = height});
    if (box.x0 < 0 || box.y0 < 0 || box.x0 >= box.x1 || box.y0 >= box.y1 || box.x1 > width ||
        box.y1 > height) {
        throw Error(ExitCode::input_refused,
                    fmt::format("the box {},{},{},{} is empty or leaves the image of {}x{}", box.x0, box.y0,
                                box.x1, box.y1, width, height));
    }
    return box;
}

// The sums of one pass over the pixels.
struct Sums {
    CompensatedSum squared, absolute, relative, symmetric;
    std::array<CompensatedSum, 3> reference, test;
    std::vector<double> relative_of_pixel;
    double max_abs = 0.0;
    std::uint64_t non_finite = 0;
};

void add_pixel(Sums& sums, const ColourPlanes& reference, const ColourPlanes& test, std::size_t i) {
    double relative = 0.0;
    bool is_finite = true;
    for (std::size_t c = 0; c < 3; ++c) {
        const double r = reference[c][i];
        const double x = test[c][i];
        const double d = std::abs(x - r);
        is_finite = is_finite && std::isfinite(r) && std::isfinite(x);
        sums.squared.add(d * d);
        sums.absolute.add(d);
        sums.symmetric.add(2.0 * d / (std::abs(x) + std::abs(r) + kSmapeEpsilon));
        sums.reference[c].add(r);
        sums.test[c].add(x);
        sums.max_abs = std::max(sums.max_abs, d);
        relative += d * d / (r * r + kRelMseEpsilon);
    }
    sums.relative.add(relative);
    sums.relative_of_pixel.push_back(relative);
    if (!is_finite) ++sums.non_finite;
}

// Mean over channels of what is left when the largest pixels are dropped.
double trimmed_mean(std::vector<double> values) {
    const auto dropped = static_cast<std::size_t>(kTrimmedShare * static_cast<double>(values.size()));
    const auto kept = values.begin() + static_cast<std::ptrdiff_t>(values.size() - dropped);
    if (dropped > 0) std::nth_element(values.begin(), kept, values.end());
    std::sort(values.begin(), kept);
    CompensatedSum sum;
    std::for_each(values.begin(), kept, [&](double v) { sum.add(v); });
    return sum.value() / (3.0 * static_cast<double>(values.size() - dropped));
}

// A NaN that was compared must not vanish in a maximum or a sort: it makes every number NaN, which passes no
// limit.
Metrics undefined_metrics(const Sums& sums, std::uint64_t pixels) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    return {.rmse = nan,
            .mae = nan,
            .relmse = nan,
            .trimmed_relmse = nan,
            .smape = nan,
            .psnr = nan,
            .max_abs = nan,
            .mean_ref = {nan, nan, nan},
            .mean_test = {nan, nan, nan},
            .pixels = pixels,
            .non_finite = sums.non_finite};
}

}  // namespace

std::vector<std::size_t> selected_pixels(int width, int height, const Selection& selection) {
    const PixelBox box = checked_box(width, height, selection.box);
    std::optional<ColourPlanes> mask;
    if (selection.mask != nullptr) {
        mask = colours_of(*selection.mask, "mask");
        if (selection.mask->width != width || selection.mask->height != height) {
            throw Error(ExitCode::input_refused,
                        fmt::format("the mask is {}x{}, the images are {}x{}", selection.mask->width,
                                    selection.mask->height, width, height));
        }
    }
    std::vector<std::size_t> pixels;
    for (int y = box.y0; y < box.y1; ++y) {
        for (int x = box.x0; x < box.x1; ++x) {
            const std::size_t i =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
            if (!mask || (*mask)[0][i] > 0.0f || (*mask)[1][i] > 0.0f || (*mask)[2][i] > 0.0f)
                pixels.push_back(i);
        }
    }
    if (pixels.empty()) throw Error(ExitCode::input_refused, "the mask leaves no pixel to compare");
    return pixels;
}

Metrics measure_difference(const Image& reference, const Image& test,
                           const std::vector<std::size_t>& pixels) {
    if (reference.width != test.width || reference.height != test.height) {
        throw Error(ExitCode::input_refused,
                    fmt::format("the reference is {}x{}, the test image is {}x{}", reference.width,
                                reference.height, test.width, test.height));
    }
    const ColourPlanes r = colours_of(reference, "reference");
    const ColourPlanes x = colours_of(test, "test image");
    Sums sums;
    sums.relative_of_pixel.reserve(pixels.size());
    for (const std::size_t i : pixels)
        add_pixel(sums, r, x, i);
    if (sums.non_finite > 0) return undefined_metrics(sums, pixels.size());

    const double values = 3.0 * static_cast<double>(pixels.size());
    Metrics metrics{.rmse = std::sqrt(sums.squared.value() / values),
                    .mae = sums.absolute.value() / values,
                    .relmse = sums.relative.value() / values,
                    .trimmed_relmse = trimmed_mean(std::move(sums.relative_of_pixel)),
                    .smape = sums.symmetric.value() / values,
                    .max_abs = sums.max_abs,
                    .pixels = pixels.size()};
    if (metrics.rmse > 0.0) metrics.psnr = 20.0 * std::log10(kPsnrPeak / metrics.rmse);
    for (std::size_t c = 0; c < 3; ++c) {
        metrics.mean_ref[c] = sums.reference[c].value() / static_cast<double>(pixels.size());
        metrics.mean_test[c] = sums.test[c].value() / static_cast<double>(pixels.size());
    }
    return metrics;
}

}  // namespace voxilux

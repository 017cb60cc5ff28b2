#include "jobs/bench/photon_numbers.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "base/colour.h"
#include "base/error.h"

namespace voxilux {
namespace {

double luminance_at(const std::array<std::span<const float>, 3>& planes, std::size_t i) {
    return luminance(std::array<double, 3>{planes[0][i], planes[1][i], planes[2][i]});
}

std::size_t index_of(const Image& image, int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x);
}

// The index that position `at` reads in a row of `size` pixels, mirrored at the borders as often as needed.
int mirrored(int at, int size) {
    const int turn = ((at % (2 * size)) + 2 * size) % (2 * size);
    return turn < size ? turn : 2 * size - 1 - turn;
}

std::vector<double> gaussian() {
    const int reach = static_cast<int>(4.0 * kBlurSigma + 0.5);
    std::vector<double> weights;
    for (int k = -reach; k <= reach; ++k)
        weights.push_back(std::exp(-0.5 * k * k / (kBlurSigma * kBlurSigma)));
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    for (double& weight : weights)
        weight /= sum;
    return weights;
}

// Filters along x (`across`) or y.
std::vector<double> blurred(const Image& image, const std::vector<double>& values, bool across) {
    const std::vector<double> weights = gaussian();
    const int reach = static_cast<int>(weights.size() / 2);
    std::vector<double> result(values.size());
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            double sum = 0.0;
            for (int k = -reach; k <= reach; ++k) {
                const int at_x = across ? mirrored(x + k, image.width) : x;
                const int at_y = across ? y : mirrored(y + k, image.height);
                sum += weights[static_cast<std::size_t>(k + reach)] * values[index_of(image, at_x, at_y)];
            }
            result[index_of(image, x, y)] = sum;
        }
    }
    return result;
}

}  // namespace

Image emitter_mask(const Image& reference) {
    const auto planes = colour_planes(reference).value();
    Image mask{.width = reference.width, .height = reference.height};
    std::vector<float>& white = mask.channels["Y"].pixels;
    white.assign(pixel_count(reference), 1.0f);
    for (int y = 0; y < reference.height; ++y) {
        for (int x = 0; x < reference.width; ++x) {
            if (!(luminance_at(planes, index_of(reference, x, y)) > kEmitterLuminance)) continue;
            for (int j = -kEmitterMargin; j <= kEmitterMargin; ++j) {
                const int reach = kEmitterMargin - std::abs(j);
                for (int i = -reach; i <= reach; ++i) {
                    const bool inside =
                        x + i >= 0 && y + j >= 0 && x + i < reference.width && y + j < reference.height;
                    if (inside) white[index_of(reference, x + i, y + j)] = 0.0f;
                }
            }
        }
    }
    return mask;
}

double blurred_rmse(const Image& reference, const Image& test, const PixelBox& box) {
    const auto r = colour_planes(reference).value();
    const auto t = colour_planes(test).value();
    std::vector<double> difference(pixel_count(reference));
    for (std::size_t i = 0; i < difference.size(); ++i)
        difference[i] = luminance_at(t, i) - luminance_at(r, i);
    difference = blurred(reference, blurred(reference, difference, true), false);
    double sum = 0.0;
    for (int y = box.y0; y < box.y1; ++y)
        for (int x = box.x0; x < box.x1; ++x)
            sum += std::pow(difference[index_of(reference, x, y)], 2.0);
    return std::sqrt(sum / static_cast<double>((box.x1 - box.x0) * (box.y1 - box.y0)));
}

PhotonErrors photon_errors(const Image& reference, const Image& test, const std::optional<PixelBox>& box) {
    const Image mask = emitter_mask(reference);
    const auto pixels = selected_pixels(reference.width, reference.height, {.mask = &mask});
    const Metrics metrics = measure_difference(reference, test, pixels);
    PhotonErrors errors{.relmse = metrics.relmse};
    for (std::size_t c = 0; c < 3; ++c)
        errors.bias[c] = metrics.mean_test[c] / metrics.mean_ref[c] - 1.0;
    if (!box) return errors;
    (void)selected_pixels(reference.width, reference.height, {.box = box});  // refuses a box outside
    errors.floor = blurred_rmse(reference, test, *box);
    return errors;
}

}  // namespace voxilux

#pragma once

// Pictures of light with their noise: by iterations of the renderer, whose variance is measured, and by the
// tests' own path tracer, in the same form.

#include <cstdint>
#include <span>
#include <vector>

#include "plan/effects.h"
#include "scene/scene.h"
#include "support/path_truth.h"

namespace voxilux::test {

// Means and their variances, [height][width], row 0 at the top.
struct LightPicture {
    glm::ivec2 size{0};
    std::vector<TruthPixel> pixels;

    [[nodiscard]] const TruthPixel& at(glm::ivec2 pixel) const {
        return pixels[static_cast<std::size_t>(pixel.y * size.x + pixel.x)];
    }
};

struct LightRequest {
    std::uint32_t iterations = 64;  // >= 2
    // Widths in pixels of the blocks that are averaged, one picture for each. They divide the picture's size.
    std::span<const int> blocks;
    EffectRequest effects;
};

// Renders the scene on the test device. Each iteration is a picture of its own, so the variance of a block's
// mean includes what its pixels have in common: the photons of the iteration. Pixels draw white noise,
// because points of a sequence have a smaller error than their variance says. Fails the test when a fault was
// counted.
[[nodiscard]] std::vector<LightPicture> render_light(Scene scene, const LightRequest& request);

// The truth in pixels that are `factor` times as wide and high.
[[nodiscard]] LightPicture coarser(const LightPicture& fine, int factor);

// The path tracer's picture.
[[nodiscard]] LightPicture truth_picture(const TruthWorld& world, const TruthRequest& request);

// Where light is rare, few samples have met it, and the variance of the others is too small. So each variance
// is replaced by the mean over the pixel and its neighbours before the pictures are compared.
[[nodiscard]] PictureZ light_z(const LightPicture& traced, const LightPicture& expected);

// The most that light_z's rms may be for equal pictures.
inline constexpr double kMaxRms = 1.3;

// Whether two pictures are equal but for their noise.
[[nodiscard]] bool is_equal_light(const LightPicture& a, const LightPicture& b);

// Fails the test when they are not, and records how far they are apart as the property `what`.
void expect_equal_light(const LightPicture& a, const LightPicture& b, const char* what);

}  // namespace voxilux::test

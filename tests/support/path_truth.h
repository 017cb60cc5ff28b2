#pragma once

// An independent truth for pictures of analytic spheres and voxels: a path tracer in double precision that
// shares no code with the shaders. It is slow, plain and unbiased. Diffuse surfaces sample the sun, one
// sphere over the solid angle of its disc, and one face of a voxel over its area. Light that a path reaches
// behind a mirror or glass counts when the path hits the emitter. So each light path is found in exactly one
// way. Source: Kajiya 1986, "The Rendering Equation"; solid angle of a sphere: Shirley, Wang and Zimmerman
// 1996, "Monte Carlo Techniques for Direct Lighting", section 3.2.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "scene/scene.h"
#include "support/truth_geometry.h"

namespace voxilux::test {

struct TruthRequest {
    glm::ivec2 size{32, 32};  // pixels: box filter, so a small picture is the mean of the pixels of a big one
    int spp = 256;            // >= 2
    std::uint64_t seed = 1;
    // False: emitters count only when a path hits them, another estimator of the same picture.
    bool samples_emitters = true;
    // True: sin t = (eta sin i)^2 in place of Snell's law, which a test has to notice.
    bool squares_the_sine = false;
};

struct TruthPixel {
    glm::dvec3 mean;              // radiance
    glm::dvec3 variance_of_mean;  // estimated from the samples
};

// Pixel (x, y), row 0 at the top; a pure function of its arguments.
[[nodiscard]] TruthPixel trace_truth_pixel(const TruthWorld& world, const TruthRequest& request,
                                           glm::ivec2 pixel);

// All pixels, [height][width].
[[nodiscard]] std::vector<TruthPixel> trace_truth(const TruthWorld& world, const TruthRequest& request);

// How far a traced picture is from an expected one, in standard deviations.
struct PictureZ {
    double rms = 0.0;         // over pixels and channels; 1 for equal pictures and normal noise
    double beyond_4 = 0.0;    // share of pixels and channels; 6e-5 for normal noise
    glm::dvec3 of_mean{0.0};  // of the mean of the picture
};

// Both pictures have as many pixels, each with the variance of its mean.
[[nodiscard]] PictureZ picture_z(std::span<const TruthPixel> traced, std::span<const TruthPixel> expected);

}  // namespace voxilux::test

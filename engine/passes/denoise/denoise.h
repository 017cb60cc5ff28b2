#pragma once

#include <array>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "record/recording.h"

namespace voxilux {

// What the denoiser takes from one half of a film: means over its samples, one texel per pixel, row by row.
struct DenoiseHalf {
    std::vector<glm::vec4> reflected;  // light found by random sampling
    std::vector<glm::vec4> sharp;      // all other light
    std::vector<glm::vec4> albedo;     // of what is seen, also through mirrors and glass
    std::vector<glm::vec4> normal;     // and in w the distance of its plane from the camera, voxels
};

// Buffers of results, read back: one texel per pixel.
struct DenoisedBuffers {
    std::string picture;  // R G B; an estimate of this pixel's relMSE
    std::string errors;   // the variance in it; relMSE of the undenoised image; squared error of luminance
};

// Rows of an image that are denoised at once.
struct DenoiseStrip {
    int first = 0, count = 0;  // rows of the result
    int low = 0, rows = 0;     // with the rows around them that they depend on
};

// Strips of about this many pixels that cover an image; no seams show. Each pixel takes about 430 bytes on
// the device.
inline constexpr std::size_t kDenoiseStripPixels = std::size_t{1} << 20;
[[nodiscard]] std::vector<DenoiseStrip> denoise_strips(glm::ivec2 size,
                                                       std::size_t strip_pixels = kDenoiseStripPixels);
// Rows of the largest strip.
[[nodiscard]] int most_rows(const std::vector<DenoiseStrip>& strips);

// Denoises an image, or a strip of it that begins at a multiple of gpu::kDenoiseBlock. Buffers have room for
// `most_rows`. Half 0 holds `share` of the samples. Halves without texels upload nothing, but the same passes
// are recorded (for a dry recording).
DenoisedBuffers record_denoise(glm::ivec2 size, int most_rows, float share,
                               const std::array<DenoiseHalf, 2>& halves, Recording& recording);

}  // namespace voxilux

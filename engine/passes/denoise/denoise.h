#pragma once

#include <array>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "record/recording.h"

namespace voxilux {

// What the denoiser takes of one half of a film: means over its samples, a texel for each pixel, row by row.
struct DenoiseHalf {
    std::vector<glm::vec4> reflected;  // light that is found by chance
    std::vector<glm::vec4> sharp;      // and the other light
    std::vector<glm::vec4> albedo;     // of what is seen, through mirrors and glass, too
    std::vector<glm::vec4> normal;     // and in w its distance from the camera along the normal, voxels
};

// Buffers of results, read back: a texel for each pixel.
struct DenoisedBuffers {
    std::string picture;  // R G B; an estimate of relMSE, of this pixel alone
    std::string
        errors;  // what of that is variance; relMSE of the plain picture; squared error of the luminance
};

// Rows of a picture that are denoised at once.
struct DenoiseStrip {
    int first = 0, count = 0;  // those that are wanted
    int low = 0, rows = 0;     // with those around them that they depend on
};

// Strips of about so many pixels that make up a picture; none of them shows in it. Each pixel takes some 430
// bytes on the device.
inline constexpr std::size_t kDenoiseStripPixels = std::size_t{1} << 20;
[[nodiscard]] std::vector<DenoiseStrip> denoise_strips(glm::ivec2 size,
                                                       std::size_t strip_pixels = kDenoiseStripPixels);
// Rows of the largest one.
[[nodiscard]] int most_rows(const std::vector<DenoiseStrip>& strips);

// Denoises a picture, or a strip of it that begins at a multiple of gpu::kDenoiseBlock. Buffers have room for
// `most_rows`. Half 0 has this share of the samples. Of halves without texels nothing is uploaded, but the
// same passes are recorded.
DenoisedBuffers record_denoise(glm::ivec2 size, int most_rows, float share,
                               const std::array<DenoiseHalf, 2>& halves, Recording& recording);

}  // namespace voxilux

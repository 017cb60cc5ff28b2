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

// Rows beyond those that a strip of a picture is wanted for, such that each pixel is that of the whole
// picture. A strip begins at a multiple of gpu::kDenoiseBlock.
inline constexpr int kDenoiseApron = 48;

// Denoises a picture, or a strip of it. Half 0 has this share of the samples.
DenoisedBuffers record_denoise(glm::ivec2 size, float share, const std::array<DenoiseHalf, 2>& halves,
                               Recording& recording);

}  // namespace voxilux

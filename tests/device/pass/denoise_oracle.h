#pragma once

#include <array>
#include <vector>

#include <glm/glm.hpp>

#include "passes/denoise/denoise.h"

namespace voxilux::test {

// What the denoiser should find, in double precision and pixel by pixel.
struct OracleDenoised {
    std::vector<glm::dvec3> picture;
    std::vector<double> relmse;    // of the picture, as it claims
    std::vector<double> variance;  // part of it
    std::vector<double> plain;     // of the plain picture
    std::vector<double> luminance;
};

// Ways to be wrong, as negative controls.
enum class OracleFault { none, keeps_own_terms, ignores_planes, claims_without_variance };

[[nodiscard]] OracleDenoised oracle_denoised(glm::ivec2 size, double share,
                                             const std::array<DenoiseHalf, 2>& halves,
                                             OracleFault fault = OracleFault::none);

}  // namespace voxilux::test

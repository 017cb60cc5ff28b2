#pragma once

#include <array>
#include <vector>

#include <glm/glm.hpp>

#include "passes/denoise/denoise.h"

namespace voxilux::test {

// The results of the denoiser in double precision, computed pixel by pixel.
struct OracleDenoised {
    std::vector<glm::dvec3> picture;
    std::vector<double> relmse;    // of the picture, as estimated
    std::vector<double> variance;  // the part of it that is variance
    std::vector<double> plain;     // of the plain picture
    std::vector<double> luminance;
};

// Faults to switch on, as negative controls.
enum class OracleFault { none, keeps_own_terms, ignores_planes, claims_without_variance };

[[nodiscard]] OracleDenoised oracle_denoised(glm::ivec2 size, double share,
                                             const std::array<DenoiseHalf, 2>& halves,
                                             OracleFault fault = OracleFault::none);

}  // namespace voxilux::test

#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include <glm/glm.hpp>

namespace voxilux {

enum class SkyModel : std::uint8_t { constant, atmosphere };
inline constexpr std::array<std::string_view, 2> kSkyModelNames{"constant", "atmosphere"};  // in that order

// What surrounds the scene: the same radiance from every direction, or an atmosphere that scatters sunlight.
// Multipliers are relative to the Earth's clear air.
struct Sky {
    SkyModel model = SkyModel::constant;
    glm::vec3 radiance{0.55f, 0.7f, 1.0f};  // of the constant sky
    // Of the atmosphere.
    float altitude_m = 100.0f;  // of z = 0 above the ground
    float metres_per_voxel = 0.1f;
    float rayleigh = 1.0f;  // density of air
    float mie = 1.0f;       // of aerosol
    float ozone = 1.0f;
    float mie_g = 0.8f;             // mean cosine of scattering by aerosol
    float ground_albedo = 0.3f;     // of the planet
    std::uint32_t resolution = 64;  // rows of its table above the horizon

    [[nodiscard]] bool is_atmosphere() const { return model == SkyModel::atmosphere; }
};

}  // namespace voxilux

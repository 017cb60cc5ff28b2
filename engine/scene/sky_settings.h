#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

namespace voxilux {

enum class SkyModel : std::uint8_t { constant, atmosphere, image };
inline constexpr std::array<std::string_view, 3> kSkyModelNames{"constant", "atmosphere",
                                                                "image"};  // in that order

// An equirectangular image of everything around (shaders/shared/sky_image.h).
struct SkyImage {
    glm::ivec2 size{0};             // columns and rows; 0 where there is none
    std::vector<glm::vec3> texels;  // radiance, finite and >= 0; row 0 is at the zenith
};

// Texels of an image of 4096 x 2048: with the density of each, they fill the 128 MiB of a binding.
inline constexpr std::size_t kMaxSkyTexels = std::size_t{1} << 23;

// Radiance is far above any sun there, and its square still fits a float.
inline constexpr float kMaxRadiance = 1e6f;

// What surrounds the scene: the same radiance from every direction, an atmosphere that scatters sunlight, or
// an image. Multipliers of the atmosphere are relative to the Earth's clear air.
struct Sky {
    SkyModel model = SkyModel::constant;
    glm::vec3 radiance{0.55f, 0.7f, 1.0f};  // of the constant sky
    // Of the image.
    std::string image_file;     // where it comes from
    float rotation_deg = 0.0f;  // counter-clockwise, seen from above
    float strength = 1.0f;      // factor of its radiance
    SkyImage image;             // empty for the other models
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
    [[nodiscard]] bool is_image() const { return model == SkyModel::image; }
};

}  // namespace voxilux

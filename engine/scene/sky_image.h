#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "scene/sky_settings.h"
#include "shared/alias.h"

namespace voxilux {

// Radiance of a texel of the sky's image, its strength included: at most kMaxRadiance.
[[nodiscard]] glm::vec3 sky_texel_radiance(const Sky& sky, std::size_t texel);

// Whether any of its texels shines.
[[nodiscard]] bool has_light(const SkyImage& image);

// Steradians that a texel of this row covers.
[[nodiscard]] double sky_texel_solid_angle(glm::ivec2 size, int row);

// What rays towards the image of a sky are drawn from (shaders/lib/sky_image.glsl).
struct SkySampler {
    std::vector<gpu::vec4> texels;       // radiance, and the pdf per steradian with which the table draws it
    std::vector<gpu::AliasEntry> table;  // draws a texel by its luminance times its solid angle
};

// Empty where no texel shines.
[[nodiscard]] SkySampler sky_sampler(const Sky& sky);

// Irradiance / pi of the faces -x, +x, -y, +y, -z, +z of a voxel that sees all of the sky's image.
[[nodiscard]] std::array<glm::vec3, 6> sky_face_light(const Sky& sky);

}  // namespace voxilux

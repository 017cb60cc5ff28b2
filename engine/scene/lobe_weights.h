#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace voxilux {

// Weights of the mirror lobe and the glass lobe of a surface; the rest is diffuse.
struct LobeWeights {
    float mirror = 0.0f;
    float glass = 0.0f;

    bool operator==(const LobeWeights&) const = default;
};

// A rough metal is a mix of a mirror and a diffuse lobe, with no glossy lobe in between; rough glass is
// treated as clear. Emitters and media are diffuse.
[[nodiscard]] LobeWeights lobe_weights(const Material& material);

// Indices of the spheres in the order of the device: those with glass come first, each group in the order of
// the scene.
[[nodiscard]] std::vector<std::uint32_t> sphere_order(const Scene& scene);
[[nodiscard]] std::uint32_t glass_sphere_count(const Scene& scene);

}  // namespace voxilux

#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace voxilux {

// Shares of the light on a surface that meet a mirror and clear glass; the rest meets a diffuse surface.
struct LobeWeights {
    float mirror = 0.0f;
    float glass = 0.0f;

    bool operator==(const LobeWeights&) const = default;
};

// A rough metal is a mix of mirror and diffuse surface, which has no lobe in between; rough glass is clear.
// Emitters are diffuse, media too.
[[nodiscard]] LobeWeights lobe_weights(const Material& material);

// Numbers of the spheres in the order of the device: those with glass come first, each group in the order of
// the scene.
[[nodiscard]] std::vector<std::uint32_t> sphere_order(const Scene& scene);
[[nodiscard]] std::uint32_t glass_sphere_count(const Scene& scene);

}  // namespace voxilux

#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace voxilux {

// Weights of the metal lobe and the glass lobe of a surface; the rest is diffuse.
struct LobeWeights {
    float mirror = 0.0f;
    float glass = 0.0f;

    bool operator==(const LobeWeights&) const = default;
};

// Emitters and media are diffuse. Where microfacets are not shown (`shows_rough`), a rough metal is a mix of
// a mirror and a diffuse lobe, and rough glass is treated as clear.
[[nodiscard]] LobeWeights lobe_weights(const Material& material, bool shows_rough = false);

// Roughness of the microfacets of a material that has a metal or glass lobe; 0: its lobes are smooth.
[[nodiscard]] float facet_alpha(const Material& material);

// What a row of gains depends on (shaders/shared/bsdf.h). `eta` is 0 for metal.
struct GainRow {
    float alpha = 0.0f;
    float eta = 0.0f;

    bool operator==(const GainRow&) const = default;
};

// The rows of all rough materials, each once. Those of glass come in pairs, from outside and from inside.
[[nodiscard]] std::vector<GainRow> gain_rows(const Scene& scene);
// The number of a row; 0 where there is none.
[[nodiscard]] std::uint32_t gain_row_of(const std::vector<GainRow>& rows, const GainRow& row);

// Indices of the spheres in the order of the device: those with glass come first, each group in the order of
// the scene.
[[nodiscard]] std::vector<std::uint32_t> sphere_order(const Scene& scene);
[[nodiscard]] std::uint32_t glass_sphere_count(const Scene& scene);

}  // namespace voxilux

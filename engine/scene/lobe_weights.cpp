#include "scene/lobe_weights.h"

#include <algorithm>
#include <numeric>

#include "shared/bsdf.h"

namespace voxilux {
namespace {

bool has_glass(const Scene& scene, std::uint32_t sphere) {
    return lobe_weights(scene.materials.at(scene.spheres[sphere].material)).glass > 0.0f;
}

}  // namespace

LobeWeights lobe_weights(const Material& material, bool shows_rough) {
    if (glm::any(glm::greaterThan(material.emission, glm::vec3(0.0f)))) return {};
    const float dull = shows_rough ? 0.0f : material.roughness;
    const float polish = std::clamp(material.metallic * (1.0f - dull), 0.0f, 1.0f);
    const float clear = std::clamp(material.transmission, 0.0f, 1.0f);
    switch (material.surface) {
        case Surface::metal:
            return {.mirror = polish};
        case Surface::glass:
            return {.glass = clear};
        case Surface::blend:
            return {.mirror = polish * (1.0f - clear), .glass = clear};
        case Surface::diffuse:
        case Surface::emit:
        case Surface::media:
            break;
    }
    return {};
}

float facet_alpha(const Material& material) {
    const LobeWeights weights = lobe_weights(material, true);
    return weights.mirror + weights.glass > 0.0f ? gpu::rough_alpha(material.roughness) : 0.0f;
}

std::vector<GainRow> gain_rows(const Scene& scene) {
    std::vector<GainRow> rows;
    const auto add = [&](std::initializer_list<GainRow> wanted) {
        if (std::ranges::find(rows, *wanted.begin()) == rows.end()) rows.insert(rows.end(), wanted);
    };
    for (const Material& material : scene.materials) {
        const float alpha = facet_alpha(material);
        if (alpha == 0.0f) continue;
        const LobeWeights weights = lobe_weights(material, true);
        if (weights.mirror > 0.0f) add({{alpha, 0.0f}});
        if (weights.glass > 0.0f) add({{alpha, material.ior}, {alpha, 1.0f / material.ior}});
    }
    return rows;
}

std::uint32_t gain_row_of(const std::vector<GainRow>& rows, const GainRow& row) {
    const auto found = std::ranges::find(rows, row);
    return found == rows.end() ? 0 : static_cast<std::uint32_t>(found - rows.begin());
}

std::vector<std::uint32_t> sphere_order(const Scene& scene) {
    std::vector<std::uint32_t> order(scene.spheres.size());
    std::iota(order.begin(), order.end(), 0u);
    // Not the range algorithm, which clang 14 cannot compile.
    std::stable_partition(order.begin(), order.end(), [&](std::uint32_t i) { return has_glass(scene, i); });
    return order;
}

std::uint32_t glass_sphere_count(const Scene& scene) {
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < scene.spheres.size(); ++i)
        count += has_glass(scene, i) ? 1u : 0u;
    return count;
}

}  // namespace voxilux

#include "voxelizer/surface_look.h"

#include <algorithm>
#include <cmath>

#include "base/colour.h"
#include "base/error.h"

namespace voxilux {
namespace {

constexpr float kRoughSteps = 7.0f;
constexpr float kGlassSteps = 15.0f;
constexpr float kIorSteps = 10.0f;   // per unit above 1
constexpr float kEmitMiddle = 8.0f;  // the level of emission 1
constexpr float kEmitSteps = 2.0f;   // per doubling
constexpr int kTopLevel = 15;
constexpr int kTopFlux = 4;  // where MagicaVoxel's slider ends

// A linear luminance that an 8-bit picture shows as black; less is no emission.
constexpr float kDimmestEmission = 1.0f / 4096.0f;
// Colours darker than this emit as if they were this bright: emission is stored as a multiple of the colour.
constexpr float kDarkestEmitter = 1.0f / 64.0f;

std::uint8_t step(float value, float steps, int top) {
    return static_cast<std::uint8_t>(std::clamp(static_cast<int>(value * steps + 0.5f), 0, top));
}

}  // namespace

Look look_of(const MeshMaterial& material, const SurfaceColor& value) {
    const float emission = luminance(value.emissive);
    if (emission > kDimmestEmission) {
        const float gain = emission / std::max(luminance(value.base_color), kDarkestEmitter);
        const float level = kEmitMiddle + kEmitSteps * std::log2(gain);
        return {.kind = LookKind::emit, .level = step(level, 1.0f, kTopLevel)};
    }
    const std::uint8_t rough = step(value.roughness, kRoughSteps, 7);
    if (material.alpha_mode == AlphaMode::blend || material.transmission > 0.0f) {
        const float veil = material.alpha_mode == AlphaMode::blend ? value.alpha : 1.0f;
        const float clear = std::max(1.0f - veil, material.transmission);
        return {.kind = LookKind::glass,
                .rough = rough,
                .level = step(clear, kGlassSteps, kTopLevel),
                .ior = step(material.ior - 1.0f, kIorSteps, kTopLevel)};
    }
    if (value.metallic >= 0.5f) return {.kind = LookKind::metal, .rough = rough};
    return {};
}

std::uint16_t packed(const Look& look) {
    return static_cast<std::uint16_t>(static_cast<unsigned>(look.kind) << 11 | unsigned{look.rough} << 8 |
                                      unsigned{look.level} << 4 | look.ior);
}

Look unpacked(std::uint16_t bits) {
    return {.kind = static_cast<LookKind>(bits >> 11),
            .rough = static_cast<std::uint8_t>(bits >> 8 & 7),
            .level = static_cast<std::uint8_t>(bits >> 4 & 15),
            .ior = static_cast<std::uint8_t>(bits & 15)};
}

Look coarser(const Look& look, int halvings) {
    const int size = 1 << halvings;
    const auto coarse = [&](std::uint8_t value, int top) {
        return static_cast<std::uint8_t>(std::min((value + size / 2) / size * size, top));
    };
    Look result = look;
    if (look.kind != LookKind::diffuse && look.kind != LookKind::emit) result.rough = coarse(look.rough, 7);
    result.level = coarse(look.level, kTopLevel);
    return result;
}

float emission_of(const Look& look) {
    return std::exp2((static_cast<float>(look.level) - kEmitMiddle) / kEmitSteps);
}

VoxDict material_attributes(const Look& look) {
    const auto number = [](float value) { return fmt::format("{:.4g}", value); };
    const std::string rough = number(static_cast<float>(look.rough) / kRoughSteps);
    switch (look.kind) {
        case LookKind::diffuse:
            return {{"_type", "_diffuse"}};
        case LookKind::metal:
            return {{"_type", "_metal"}, {"_metal", "1"}, {"_rough", rough}, {"_ior", "0.3"}, {"_ri", "1.3"}};
        case LookKind::glass: {
            const float above_one = static_cast<float>(std::max<int>(look.ior, 1)) / kIorSteps;
            const std::string clear = number(static_cast<float>(look.level) / kGlassSteps);
            return {{"_type", "_glass"}, {"_trans", clear},           {"_alpha", clear},
                    {"_rough", rough},   {"_ior", number(above_one)}, {"_ri", number(1.0f + above_one)}};
        }
        case LookKind::emit: {
            const float gain = emission_of(look);
            const int flux = std::clamp(static_cast<int>(std::ceil(std::log2(gain))), 0, kTopFlux);
            return {{"_type", "_emit"},
                    {"_emit", number(gain / std::exp2(static_cast<float>(flux)))},
                    {"_flux", fmt::format("{}", flux)}};
        }
    }
    VX_ASSERT(false);
}

}  // namespace voxilux

#include "voxelizer/surface_look.h"

#include <algorithm>
#include <cmath>

#include "base/colour.h"
#include "base/error.h"

namespace voxilux {
namespace {

constexpr float kRoughSteps = 7.0f;
constexpr float kGlassSteps = 15.0f;
constexpr float kIorSteps = 10.0f;  // per unit above 1
constexpr int kTopLevel = 15;
constexpr int kUnitGainLevel = 12;  // the level of an emitting look whose radiance equals its colour
constexpr int kTopFlux = 16;        // what our reader accepts; MagicaVoxel's slider ends at 4

// Range of radiances in a .vox file: below it, an 8-bit image shows black; above it, our reader clamps _emit
// 1000 and _flux 16.
constexpr float kMinEmission = 1.0f / 4096.0f;
constexpr float kMaxEmission = 1000.0f * 65536.0f;
// If a texture leaves less of a material's emission, its dark parts are noise, and the base colour is used.
constexpr float kDarkShare = 1.0f / 256.0f;
// An emitting voxel also reflects, with the same colour. Its colour is therefore as bright as the base
// colour, but not darker than this, below which 8 bits are too coarse for a radiance within 3 %.
constexpr float kDarkestEmitter = 0.5f;

std::uint8_t step(float value, float steps, int top) {
    return static_cast<std::uint8_t>(std::clamp(static_cast<int>(value * steps + 0.5f), 0, top));
}

float largest(glm::vec3 v) {
    return std::max({v.r, v.g, v.b});
}

// The smallest power of two that scales the material's strongest emission down to the luminance of its base
// colour. The same for the whole material, so that an emission texture takes one look and many colours.
std::uint8_t gain_level(const MeshMaterial& material) {
    const float brightness = std::clamp(largest(glm::vec3(material.base_color)), kDarkestEmitter, 1.0f);
    int exponent = 0;
    const float mantissa = std::frexp(largest(material.emissive) / brightness, &exponent);
    if (mantissa == 0.5f) --exponent;
    return static_cast<std::uint8_t>(kUnitGainLevel + exponent);
}

bool is_emitting(const MeshMaterial& material, const SurfaceColor& value) {
    const float brightest = largest(material.emissive);
    return brightest >= kMinEmission && largest(value.emissive) >= kDarkShare * brightest;
}

}  // namespace

glm::vec3 emission_in_range(glm::dvec3 radiance, MeshNotes& notes) {
    glm::vec3 emission(0.0f);
    for (int i = 0; i < 3; ++i) {
        if (std::isnan(radiance[i])) ++notes["an emission that is not a number is read as 0"];
        if (radiance[i] < 0.0) ++notes["an emission below 0 is read as 0"];
        if (radiance[i] > double{kMaxEmission})
            ++notes[fmt::format("an emission above {} is cut there", kMaxEmission)];
        if (radiance[i] > 0.0) emission[i] = static_cast<float>(std::min(radiance[i], double{kMaxEmission}));
    }
    if (largest(emission) >= kMinEmission || emission == glm::vec3(0.0f)) return emission;
    ++notes["an emission below 1/4096 is left out"];
    return glm::vec3(0.0f);
}

Look look_of(const MeshMaterial& material, const SurfaceColor& value) {
    if (is_emitting(material, value)) return {.kind = LookKind::emit, .level = gain_level(material)};
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
    return static_cast<std::uint16_t>(static_cast<unsigned>(look.kind) << 13 | unsigned{look.rough} << 10 |
                                      unsigned{look.level} << 4 | look.ior);
}

Look unpacked(std::uint16_t bits) {
    return {.kind = static_cast<LookKind>(bits >> 13),
            .rough = static_cast<std::uint8_t>(bits >> 10 & 7),
            .level = static_cast<std::uint8_t>(bits >> 4 & 63),
            .ior = static_cast<std::uint8_t>(bits & 15)};
}

Look coarser(const Look& look, int halvings) {
    const int size = 1 << halvings;
    const auto coarse = [&](std::uint8_t value, int top) {
        return static_cast<std::uint8_t>(std::min((value + size / 2) / size * size, top));
    };
    Look result = look;
    if (look.kind != LookKind::metal && look.kind != LookKind::glass) return result;
    result.rough = coarse(look.rough, 7);
    result.level = coarse(look.level, kTopLevel);
    return result;
}

float emission_of(const Look& look) {
    return std::min(std::ldexp(1.0f, look.level - kUnitGainLevel), kMaxEmission);
}

glm::vec3 colour_of(const Look& look, const SurfaceColor& value) {
    return look.kind == LookKind::emit ? value.emissive / emission_of(look) : value.base_color;
}

bool share_colours(std::uint16_t a, std::uint16_t b) {
    constexpr auto kEmit = static_cast<unsigned>(LookKind::emit);
    return a == b || (unsigned{a} >> 13 != kEmit && unsigned{b} >> 13 != kEmit);
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
            const int flux = std::clamp(look.level - kUnitGainLevel, 0, kTopFlux);
            return {{"_type", "_emit"},
                    {"_emit", fmt::format("{}", std::ldexp(gain, -flux))},
                    {"_flux", fmt::format("{}", flux)}};
        }
    }
    VX_ASSERT(false);
}

}  // namespace voxilux

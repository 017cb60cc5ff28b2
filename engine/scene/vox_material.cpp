#include "scene/vox_material.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/colour.h"
#include "base/printable.h"
#include "scene/vox_graph.h"

namespace voxilux {
namespace {

// Range of a property. MagicaVoxel's sliders do not leave it, and arithmetic on it stays finite.
struct Range {
    double low = 0.0;
    double high = 1.0;
};
constexpr Range kUnit{0.0, 1.0};
constexpr Range kIorAboveOne{0.0, 3.0};  // files hold ior - 1
constexpr Range kIor{1.0, 4.0};
constexpr Range kFlux{0.0, 16.0};  // the slider ends at 4
constexpr Range kEmit{0.0, 1000.0};

// MATT stores properties normalised to (0, 1]; the power slider of that time had five steps, 0 to 4.
constexpr double kOldPowerSteps = 4.0;

struct Reader {
    int index = 0;
    const VoxDict& properties;
    std::vector<std::string>& warnings;

    void warn(std::string_view what) const {
        if (warnings.size() < kVoxMaxWarnings)
            warnings.push_back(fmt::format("material {}: {}", index, what));
    }

    // The first of `keys` that is present, inside `range`; nothing when all are absent or not numbers.
    [[nodiscard]] std::optional<float> number(std::initializer_list<std::string_view> keys,
                                              Range range) const {
        for (const std::string_view key : keys) {
            const std::string* text = find_value(properties, key);
            if (text == nullptr) continue;
            const auto value = parse_number(*text);
            if (!value || std::isnan(*value)) {
                warn(fmt::format("{} is {}, not a number: ignored", key, quoted_name(*text)));
                continue;
            }
            const double inside = std::clamp(*value, range.low, range.high);
            if (inside != *value) warn(fmt::format("{} is {}, taken as {}", key, quoted_name(*text), inside));
            return static_cast<float>(inside);
        }
        return std::nullopt;
    }
};

Surface surface_named(const Reader& reader) {
    const std::string* type = find_value(reader.properties, "_type");
    if (type == nullptr || *type == "_diffuse") return Surface::diffuse;
    if (*type == "_metal" || *type == "_plastic") return Surface::metal;
    if (*type == "_glass") return Surface::glass;
    if (*type == "_emit") return Surface::emit;
    if (*type == "_blend") return Surface::blend;
    if (*type == "_media" || *type == "_cloud") return Surface::media;
    reader.warn(fmt::format("unknown type {}: taken as diffuse", quoted_name(*type)));
    return Surface::diffuse;
}

void apply(const VoxDict& properties, int index, Material& material, std::vector<std::string>& warnings) {
    const Reader reader{index, properties, warnings};
    const Surface surface = surface_named(reader);
    material.surface = surface;
    const float usual = surface == Surface::glass ? 0.0f : material.roughness;
    material.roughness = reader.number({"_rough"}, kUnit).value_or(usual);
    if (const auto ior = reader.number({"_ri"}, kIor)) {
        material.ior = *ior;
    } else if (const auto above_one = reader.number({"_ior"}, kIorAboveOne)) {
        material.ior = 1.0f + *above_one;
    }
    // Older files have one _weight where newer ones name the property.
    if (surface == Surface::metal || surface == Surface::blend)
        material.metallic = reader.number({"_metal", "_weight"}, kUnit).value_or(1.0f);
    if (surface == Surface::glass || surface == Surface::blend)
        material.transmission = reader.number({"_trans", "_alpha", "_weight"}, kUnit).value_or(1.0f);
    if (surface == Surface::emit) {
        const float emit = reader.number({"_emit", "_weight"}, kEmit).value_or(1.0f);
        const float flux = reader.number({"_flux"}, kFlux).value_or(0.0f);
        material.emission = material.albedo * (emit * std::exp2(flux));
    }
}

// The properties of MATT by their names in MATL.
VoxDict as_properties(const VoxOldMaterial& old, std::vector<std::string>& warnings) {
    constexpr std::string_view kTypes[] = {"_diffuse", "_metal", "_glass", "_emit"};
    constexpr std::string_view kValues[] = {"_plastic", "_rough", "_spec", "_ior", "_att", "_flux", "_glow"};
    constexpr std::size_t kPower = 5;
    VoxDict properties;
    if (old.type >= 0 && old.type < 4) {
        properties.emplace_back("_type", kTypes[old.type]);
    } else if (warnings.size() < kVoxMaxWarnings) {
        warnings.push_back(
            fmt::format("material {}: unknown MATT type {}: taken as diffuse", old.id, old.type));
    }
    properties.emplace_back("_weight", fmt::format("{}", old.weight));
    std::size_t next = 0;
    for (std::size_t bit = 0; bit < std::size(kValues) && next < old.values.size(); ++bit) {
        if ((old.present >> bit & 1) == 0) continue;
        const double scale = bit == kPower ? kOldPowerSteps : 1.0;
        properties.emplace_back(kValues[bit],
                                fmt::format("{}", scale * static_cast<double>(old.values[next++])));
    }
    return properties;
}

}  // namespace

std::array<Material, 256> vox_materials(const VoxFile& file, std::vector<std::string>& warnings) {
    std::array<Material, 256> materials;
    for (int i = 1; i < 256; ++i) {
        const VoxColour colour = colour_of(file, static_cast<std::uint8_t>(i));
        Material& material = materials[static_cast<std::size_t>(i)];
        material.name = fmt::format("palette {}", i);
        material.albedo = {linear_from_srgb(colour.r), linear_from_srgb(colour.g),
                           linear_from_srgb(colour.b)};
    }
    const auto is_index = [](std::int32_t id) { return id >= 1 && id <= 255; };
    for (const VoxOldMaterial& old : file.old_materials) {
        if (is_index(old.id))
            apply(as_properties(old, warnings), old.id, materials[static_cast<std::size_t>(old.id)],
                  warnings);
    }
    for (const VoxRecord& record : file.materials) {
        if (is_index(record.id))
            apply(record.attributes, record.id, materials[static_cast<std::size_t>(record.id)], warnings);
    }
    return materials;
}

}  // namespace voxilux

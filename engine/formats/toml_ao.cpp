// The section [ao] of a scene file: how ambient occlusion is found.

#include <array>
#include <limits>

#include "formats/toml_scene.h"
#include "formats/toml_section.h"

namespace voxilux {
namespace {

constexpr double kMaxCellPixels = 4096.0;
constexpr std::int64_t kMostFilters = 4;
constexpr std::int64_t kMostSlots = std::int64_t{1} << 24;

}  // namespace

void read_ao(TomlScene& in) {
    const toml::table* table = find_section(in, "ao");
    if (table == nullptr) return;
    const TomlSection section(*table, "[ao]",
                              {"method", "cell_px", "reproject", "merged", "checkerboard", "sampling",
                               "filter", "sample_limit", "slots"});
    AoSettings& ao = in.scene.settings.ao;
    constexpr std::array<std::string_view, 3> kMethods{"auto", "brute", "hash"};  // in the order of AoMethod
    if (const auto method = section.choice("method", kMethods)) ao.method = static_cast<AoMethod>(*method);
    if (const auto px = section.number("cell_px", {0.0, kMaxCellPixels, true}))
        ao.cell_px = static_cast<float>(*px);
    if (const auto reproject = section.boolean("reproject")) ao.reproject = reproject;
    if (const auto merged = section.boolean("merged")) ao.merged = merged;
    ao.checkerboard = section.boolean("checkerboard").value_or(ao.checkerboard);
    constexpr std::array<std::string_view, 2> kSamplings{"cell", "pixel"};
    if (const auto sampling = section.choice("sampling", kSamplings)) ao.by_pixel = *sampling == 1;
    const auto whole = [&](std::string_view key, std::int64_t high, std::uint32_t& value) {
        if (const auto number = section.integer(key, 0, high)) value = static_cast<std::uint32_t>(*number);
    };
    whole("filter", kMostFilters, ao.filter);
    whole("sample_limit", std::numeric_limits<std::uint32_t>::max(), ao.sample_limit);
    whole("slots", kMostSlots, ao.slots);
}

}  // namespace voxilux

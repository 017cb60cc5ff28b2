#include "formats/block_looks.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>

namespace voxilux {
namespace {

struct NamedLook {
    std::string_view name;
    std::uint32_t colour = 0;  // 0xRRGGBB
    CellLook look = CellLook::diffuse;
};

constexpr CellLook kLit = CellLook::light, kClear = CellLook::glass, kWater = CellLook::water;

#include "formats/block_colours.inc"

// What is dyed, glass being the one that is clear.
constexpr std::string_view kDyed[] = {
    "wool",   "carpet", "concrete",    "concrete_powder",   "terracotta", "bed",
    "banner", "candle", "shulker_box", "glazed_terracotta", "wall_banner"};
constexpr std::string_view kStainedGlass[] = {"stained_glass", "stained_glass_pane"};
// What is made of planks, and what grows under a bark, which is darker.
constexpr std::string_view kWooden[] = {"planks",       "stairs",         "slab",        "fence",
                                        "fence_gate",   "door",           "trapdoor",    "button",
                                        "sign",         "pressure_plate", "wall_sign",   "mosaic",
                                        "hanging_sign", "mosaic_stairs",  "mosaic_slab", "wall_hanging_sign"};
constexpr std::string_view kBarked[] = {"log", "wood", "stem", "hyphae", "roots", "sapling", "fungus"};
// Words before and after the name of a material that do not change its colour much.
constexpr std::string_view kPrefixes[] = {"waxed_",   "stripped_", "polished_", "smooth_",   "chiseled_",
                                          "cracked_", "mossy_",    "cut_",      "infested_", "dead_",
                                          "potted_",  "trapped_",  "attached_"};
constexpr std::string_view kSuffixes[] = {
    "_stairs", "_slab", "_wall",           "_fence",  "_fence_gate", "_pane",     "_button",
    "_tiles",  "_tile", "_bricks",         "_pillar", "_door",       "_trapdoor", "_carpet",
    "_grate",  "_bulb", "_pressure_plate", "_brick",  "_block",      "_fan",      "s"};

// Words that are stripped from a name, at most.
constexpr int kMaxStripped = 6;
constexpr float kBark = 0.6f;

BlockLook look_of(const NamedLook& named, float scale = 1.0f) {
    const auto channel = [&](int shift) {
        return static_cast<std::uint8_t>(static_cast<float>(named.colour >> shift & 0xFF) * scale);
    };
    return {.colour = {channel(16), channel(8), channel(0)}, .look = named.look};
}

const NamedLook* find(std::span<const NamedLook> table, std::string_view name) {
    const auto found = std::ranges::find(table, name, &NamedLook::name);
    return found == table.end() ? nullptr : &*found;
}

// The row whose name and "_" begin the text, if one of `kinds` follows.
const NamedLook* find_kind(std::span<const NamedLook> table, std::string_view text,
                           std::span<const std::string_view> kinds) {
    const auto found = std::ranges::find_if(table, [&](const NamedLook& row) {
        return text.starts_with(row.name) && text.substr(row.name.size()).starts_with('_') &&
               std::ranges::find(kinds, text.substr(row.name.size() + 1)) != kinds.end();
    });
    return found == table.end() ? nullptr : &*found;
}

std::optional<BlockLook> look_of_family(std::string_view name) {
    if (const NamedLook* dye = find_kind(kDyes, name, kDyed)) return look_of(*dye);
    if (const NamedLook* dye = find_kind(kDyes, name, kStainedGlass)) {
        BlockLook look = look_of(*dye);
        look.look = CellLook::glass;
        return look;
    }
    if (const NamedLook* wood = find_kind(kWoods, name, kWooden)) return look_of(*wood);
    if (const NamedLook* wood = find_kind(kWoods, name, kBarked)) return look_of(*wood, kBark);
    constexpr std::string_view kLeaf[] = {"leaves"};
    if (const NamedLook* leaves = find_kind(kLeaves, name, kLeaf)) return look_of(*leaves);
    if (const NamedLook* block = find(kBlocks, name)) return look_of(*block);
    return {};
}

// Without one word that says how a material is worked, or the same name.
std::string_view stripped(std::string_view name) {
    constexpr std::string_view kDeepslate = "deepslate_";
    if (name.starts_with(kDeepslate) && name.ends_with("_ore")) return name.substr(kDeepslate.size());
    for (const std::string_view prefix : kPrefixes) {
        if (name.starts_with(prefix)) return name.substr(prefix.size());
    }
    for (const std::string_view suffix : kSuffixes) {
        if (name.ends_with(suffix)) return name.substr(0, name.size() - suffix.size());
    }
    return name;
}

}  // namespace

BlockLook look_of_block(std::string_view name) {
    const std::size_t bracket = std::min(name.find('['), name.size());
    const std::string_view properties = name.substr(bracket);
    name = name.substr(0, bracket);
    if (name.starts_with("minecraft:")) name.remove_prefix(std::string_view("minecraft:").size());
    if (std::ranges::find(kUnseen, name) != std::end(kUnseen)) return {.is_empty = true};
    std::string_view part = name;
    std::optional<BlockLook> look = look_of_family(part);
    for (int i = 0; i < kMaxStripped && !look; ++i) {
        part = stripped(part);
        look = look_of_family(part);
    }
    if (!look) return {.is_known = false};
    const bool is_off = properties.find("lit=false") != properties.npos;
    if (look->look == CellLook::light && is_off) look->look = CellLook::diffuse;
    return *look;
}

}  // namespace voxilux

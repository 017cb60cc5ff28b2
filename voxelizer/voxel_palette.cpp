#include "voxelizer/voxel_palette.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <span>

#include "base/checked_cast.h"
#include "voxelizer/colour_spaces.h"
#include "voxelizer/quantize_colours.h"

namespace voxilux {
namespace {

constexpr std::size_t kMaxEntries = 255;  // index 0 is empty
// More looks than this take too many entries from the colours.
constexpr std::size_t kMaxLooks = 24;
constexpr int kCellShift = 2;             // low bits of a byte that a cell ignores
constexpr unsigned kCellBits = 18;        // of a cell in its group
constexpr std::size_t kHashSlots = 1024;  // at least four times kMaxEntries
constexpr std::uint64_t kNoKey = ~std::uint64_t{0};
// A slot with more than this fraction of the voxels distinguishes colours exactly.
constexpr double kHeavyShare = 1.0 / 1024.0;
constexpr std::size_t kHeavySamples = 262144;  // voxels that fractions are estimated from
constexpr std::uint32_t kHeavy = std::uint32_t{1} << 31;
constexpr unsigned kFineBits = 3 * kCellShift;
// Extra weight of an error in an emitter's colour, because it shows on everything that the emitter lights.
constexpr float kEmitterWeight = 64.0f;
// A larger relative error of a radiance is reported.
constexpr float kRadianceTolerance = 0.03f;
// Voxels for which the error is measured: accurate to 0.2 % at the 95th percentile.
constexpr std::size_t kErrorSamples = 65536;

std::uint64_t exact_key(const ColouredVoxel& v) {
    return (std::uint64_t{v.look} << 8 | v.r) << 16 | static_cast<std::uint64_t>(v.g << 8 | v.b);
}

std::size_t hash_slot(std::uint64_t key) {
    return static_cast<std::size_t>(key * 0x9E3779B97F4A7C15u >> 54);
}

template <class Visit>
void for_each_voxel(const VoxelSet& set, const Visit& visit) {
    for (const VoxelBlock& block : set.blocks) {
        for (const ColouredVoxel& voxel : block.surface)
            visit(voxel);
    }
}

// Visits every stride-th voxel.
template <class Visit>
void for_each_sample(const VoxelSet& set, std::uint64_t stride, const Visit& visit) {
    std::uint64_t next = 0;
    std::uint64_t number = 0;  // index of the block's first voxel
    for (const VoxelBlock& block : set.blocks) {
        for (; next < number + block.surface.size(); next += stride)
            visit(block.surface[static_cast<std::size_t>(next - number)]);
        number += block.surface.size();
    }
}

glm::u8vec3 colour_of(const ColouredVoxel& v) {
    return {v.r, v.g, v.b};
}

// Whether an entry changes what a voxel emits by more than the tolerance. Both colours have the same gain.
bool is_radiance_off(const ColouredVoxel& voxel, const PaletteEntry& entry) {
    if (entry.look.kind != LookKind::emit) return false;
    const auto linear = [](glm::u8vec3 c) {
        return glm::vec3(linear_from_srgb(c.r), linear_from_srgb(c.g), linear_from_srgb(c.b));
    };
    const glm::vec3 wanted = linear(colour_of(voxel));
    const glm::vec3 miss = glm::abs(linear(entry.colour) - wanted);
    return std::max({miss.r, miss.g, miss.b}) > kRadianceTolerance * std::max({wanted.r, wanted.g, wanted.b});
}

// A number in [0, 256) that differs between neighbours: the parities of the position's bits, lowest first, as
// in a Bayer matrix (B. Bayer, 1973), in three dimensions.
unsigned threshold_at(glm::ivec3 p) {
    unsigned value = 0;
    for (int level = 0; level < 3; ++level) {
        const auto bit = [&](int axis) { return static_cast<unsigned>(p[axis] >> level) & 1u; };
        const unsigned order = (bit(0) ^ bit(1) ^ bit(2)) << 2 | (bit(0) ^ bit(1)) << 1 | bit(0);
        value |= order << (5 - 3 * level + 3) >> 3;
    }
    return value;
}

}  // namespace

VoxelPalette::VoxelPalette(const VoxelSet& set, bool dither) {
    collect_looks(set);
    if (!make_exact(set)) {
        find_heavy_slots(set);
        count_cells(set);
        quantize(set);
        settle_colours();
        if (dither) find_dither_pairs();
    }
    measure(set, dither);
}

void VoxelPalette::collect_looks(const VoxelSet& set) {
    std::vector<bool> is_used(std::size_t{std::numeric_limits<std::uint16_t>::max()} + 1, false);
    for_each_voxel(set, [&](const ColouredVoxel& voxel) { is_used[voxel.look] = true; });
    for (int halvings = 0;; ++halvings) {
        looks_.clear();
        for (std::size_t bits = 0; bits < is_used.size(); ++bits) {
            if (is_used[bits])
                looks_.push_back(coarser(unpacked(static_cast<std::uint16_t>(bits)), halvings));
        }
        std::ranges::sort(looks_);
        looks_.erase(std::unique(looks_.begin(), looks_.end()), looks_.end());
        if (looks_.size() > kMaxLooks && halvings < 4) continue;
        group_of_look_.assign(is_used.size(), 0);
        for (std::size_t bits = 0; bits < is_used.size(); ++bits) {
            if (!is_used[bits]) continue;
            const Look look = coarser(unpacked(static_cast<std::uint16_t>(bits)), halvings);
            group_of_look_[bits] =
                static_cast<std::uint8_t>(std::ranges::lower_bound(looks_, look) - looks_.begin());
        }
        return;
    }
}

// False when there are more colours than entries.
bool VoxelPalette::make_exact(const VoxelSet& set) {
    exact_keys_.assign(kHashSlots, kNoKey);
    exact_entries_.assign(kHashSlots, 0);
    std::uint64_t last = kNoKey;
    for (const VoxelBlock& block : set.blocks) {
        for (const ColouredVoxel& voxel : block.surface) {
            const std::uint64_t key = exact_key(voxel);
            if (key == last) continue;
            last = key;
            add_exact(key);
            if (entries_.size() > kMaxEntries) {
                exact_keys_.clear();
                entries_.clear();
                return false;
            }
        }
    }
    return true;
}

void VoxelPalette::add_exact(std::uint64_t key) {
    std::size_t slot = hash_slot(key);
    while (exact_keys_[slot] != kNoKey && exact_keys_[slot] != key)
        slot = (slot + 1) % kHashSlots;
    if (exact_keys_[slot] == key) return;
    exact_keys_[slot] = key;
    exact_entries_[slot] = static_cast<std::uint8_t>(entries_.size());
    entries_.push_back({.colour = {static_cast<std::uint8_t>(key >> 16), static_cast<std::uint8_t>(key >> 8),
                                   static_cast<std::uint8_t>(key)},
                        .look = looks_[group_of_look_[key >> 24]]});
}

std::size_t VoxelPalette::coarse_slot_of(const ColouredVoxel& v) const {
    const auto part = [](std::uint8_t byte) { return static_cast<std::size_t>(byte >> kCellShift); };
    return std::size_t{group_of_look_[v.look]} << kCellBits | part(v.r) << 12 | part(v.g) << 6 | part(v.b);
}

std::size_t VoxelPalette::slot_of(const ColouredVoxel& v) const {
    const std::size_t slot = coarse_slot_of(v);
    const std::uint32_t cell = cell_of_slot_[slot];
    if ((cell & kHeavy) == 0) return slot;
    constexpr unsigned kLow = (1u << kCellShift) - 1;
    return (cell & ~kHeavy) + ((v.r & kLow) << 2 * kCellShift | (v.g & kLow) << kCellShift | (v.b & kLow));
}

void VoxelPalette::find_heavy_slots(const VoxelSet& set) {
    const std::size_t slots = looks_.size() << kCellBits;
    cell_of_slot_.assign(slots, 0);
    const std::uint64_t stride = std::max<std::uint64_t>(1, set.surface / kHeavySamples);
    std::uint64_t seen = 0;
    for_each_sample(set, stride, [&](const ColouredVoxel& voxel) {
        ++cell_of_slot_[coarse_slot_of(voxel)];
        ++seen;
    });
    const auto heavy = static_cast<std::uint32_t>(kHeavyShare * static_cast<double>(seen)) + 1;
    for (std::size_t slot = 0; slot < slots; ++slot) {
        const bool is_heavy = cell_of_slot_[slot] > heavy;
        cell_of_slot_[slot] = is_heavy ? kHeavy | static_cast<std::uint32_t>(cell_of_slot_.size()) : 0;
        if (is_heavy) cell_of_slot_.resize(cell_of_slot_.size() + (std::size_t{1} << kFineBits), 0);
    }
}

void VoxelPalette::count_cells(const VoxelSet& set) {
    cells_.resize(1);
    for_each_voxel(set, [&](const ColouredVoxel& voxel) {
        std::uint32_t& number = cell_of_slot_[slot_of(voxel)];
        if (number == 0) {
            number = static_cast<std::uint32_t>(cells_.size());
            cells_.push_back({.look = voxel.look});
        }
        Cell& cell = cells_[number];
        cell.sum += glm::u64vec3(voxel.r, voxel.g, voxel.b);
        ++cell.count;
    });
}

void VoxelPalette::quantize(const VoxelSet& set) {
    std::vector<WeightedColour> colours;
    for (const Cell& cell : std::span(cells_).subspan(1)) {
        const float share =
            static_cast<float>(static_cast<double>(cell.count) / static_cast<double>(set.surface));
        const bool is_emitter = unpacked(cell.look).kind == LookKind::emit;
        colours.push_back({.oklab = oklab_of(cell.mean()),
                           .weight = is_emitter ? kEmitterWeight * share : share,
                           .group = group_of_look_[cell.look]});
    }
    const QuantizedColours quantized = quantize_colours(colours, kMaxEntries);
    for (std::size_t i = 0; i < colours.size(); ++i)
        cells_[i + 1].entry = checked_cast<std::uint8_t>(quantized.entry_of[i], "palette entry");
    for (const QuantizedColours::Entry& entry : quantized.entries)
        entries_.push_back({.colour = srgb_of_oklab(entry.oklab), .look = looks_[entry.group]});
}

// An entry with more than half of its voxels in one cell takes the mean of that cell, so that large plain
// surfaces keep their exact colour.
void VoxelPalette::settle_colours() {
    std::vector<std::uint64_t> sizes(entries_.size(), 0);
    std::vector<const Cell*> largest(entries_.size(), &cells_[0]);
    for (const Cell& cell : std::span(cells_).subspan(1)) {
        sizes[cell.entry] += cell.count;
        if (cell.count > largest[cell.entry]->count) largest[cell.entry] = &cell;
    }
    for (std::size_t e = 0; e < entries_.size(); ++e) {
        if (2 * largest[e]->count > sizes[e]) entries_[e].colour = glm::u8vec3(largest[e]->mean() + 0.5f);
    }
    commonest_ = static_cast<std::uint8_t>(std::ranges::max_element(sizes) - sizes.begin());
}

// Finds for each cell the second entry whose line to the first passes nearest to the cell's colour.
void VoxelPalette::find_dither_pairs() {
    std::vector<glm::vec3> oklab;
    for (const PaletteEntry& entry : entries_)
        oklab.push_back(oklab_of(entry.colour));
    for (std::size_t i = 1; i < cells_.size(); ++i) {
        Cell& cell = cells_[i];
        const glm::vec3 wanted = oklab_of(cell.mean()) - oklab[cell.entry];
        float least = glm::dot(wanted, wanted);
        for (std::size_t e = 0; e < entries_.size(); ++e) {
            if (e == cell.entry || entries_[e].look != entries_[cell.entry].look) continue;
            const glm::vec3 way = oklab[e] - oklab[cell.entry];
            const float square = glm::dot(way, way);
            // At most half way, because the cell's own entry is the nearest.
            const float part = square > 0.0f ? std::clamp(glm::dot(wanted, way) / square, 0.0f, 0.5f) : 0.0f;
            const glm::vec3 miss = wanted - way * part;
            // A distant entry on the line would be visible as noise, so its distance counts, too.
            const float cost = glm::dot(miss, miss) + 0.25f * square * part * (1.0f - part);
            if (cost >= least) continue;
            least = cost;
            cell.other = static_cast<std::uint8_t>(e);
            cell.other_part = static_cast<std::uint8_t>(part * 256.0f);
        }
    }
}

std::uint8_t VoxelPalette::entry_of(const ColouredVoxel& voxel, glm::ivec3 place) const {
    if (!exact_keys_.empty()) {
        const std::uint64_t key = exact_key(voxel);
        std::size_t slot = hash_slot(key);
        while (exact_keys_[slot] != key)
            slot = (slot + 1) % kHashSlots;
        return exact_entries_[slot];
    }
    const Cell& cell = cells_[cell_of_slot_[slot_of(voxel)]];
    if (cell.other_part == 0) return cell.entry;
    return threshold_at(place) < cell.other_part ? cell.other : cell.entry;
}

void VoxelPalette::measure(const VoxelSet& set, bool dither) {
    const std::uint64_t stride = std::max<std::uint64_t>(1, set.surface / kErrorSamples);
    std::vector<double> errors;
    std::vector<std::uint64_t> uses(entries_.size(), 0);
    for_each_sample(set, stride, [&](const ColouredVoxel& voxel) {
        const glm::ivec3 place = glm::ivec3(voxel.x, voxel.y, voxel.z);
        const std::uint8_t entry = entry_of(voxel, dither ? place : glm::ivec3(0));
        errors.push_back(colour_difference(colour_of(voxel), entries_[entry].colour));
        ++uses[entry];
    });
    if (exact_keys_.empty()) {
        for_each_voxel(set, [&](const ColouredVoxel& voxel) {
            const std::uint8_t entry =
                entry_of(voxel, dither ? glm::ivec3(voxel.x, voxel.y, voxel.z) : glm::ivec3(0));
            error_.radiances_off += is_radiance_off(voxel, entries_[entry]) ? 1 : 0;
        });
    }
    if (errors.empty()) return;
    if (!exact_keys_.empty())
        commonest_ = static_cast<std::uint8_t>(std::ranges::max_element(uses) - uses.begin());
    for (const double error : errors)
        error_.mean += error / static_cast<double>(errors.size());
    std::ranges::sort(errors);
    error_.p95 = errors[errors.size() * 95 / 100];
    error_.largest = errors.back();
}

}  // namespace voxilux

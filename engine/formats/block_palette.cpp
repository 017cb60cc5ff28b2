#include "formats/block_palette.h"

#include <algorithm>

#include "formats/vox_bytes.h"

namespace voxilux {

void BlockPalette::add(std::uint32_t number, std::string_view name, std::size_t offset) {
    if (states_.size() == kMaxBlockStates)
        throw VoxRefusal(offset, fmt::format("the palettes hold over {} blocks", kMaxBlockStates));
    states_.push_back({number, look_of_block(name)});
    if (states_.back().look.is_known) return;
    if (unknown_kinds_++ == 0) unknown_ = name;
}

void BlockPalette::sort() {
    std::ranges::stable_sort(states_, {}, &State::number);
}

const BlockLook* BlockPalette::find(std::uint32_t number) {
    if (last_ >= states_.size() || states_[last_].number != number) {
        const auto after = std::ranges::upper_bound(states_, number, {}, &State::number);
        if (after == states_.begin() || (after - 1)->number != number) return nullptr;
        last_ = static_cast<std::size_t>(after - states_.begin()) - 1;
    }
    const BlockLook& look = states_[last_].look;
    if (!look.is_known) ++unknown_cells_;
    return &look;
}

void BlockPalette::warn(std::vector<std::string>& warnings) const {
    if (unknown_cells_ > 0)
        warnings.push_back(
            fmt::format("{} voxels are grey: the colours of {} kinds of blocks are unknown, {} among them",
                        unknown_cells_, unknown_kinds_, quoted_name(unknown_)));
}

}  // namespace voxilux

#include "world/growing_box.h"

#include <algorithm>

namespace voxilux {
namespace {

// Lines along y or z that are copied at once: as many as there are cells in a cache line.
constexpr int kLines = 16;

// How far around the wanted cells the steps after this one look: 2, 4, 8 and 16 cells along each axis in
// later rounds, and as far as in this round along the axes still to come in it.
glm::ivec3 margin_after(const gpu::GrowthStep& step) {
    glm::ivec3 margin(GrowingBox::kReach - step.bound);
    for (int axis = static_cast<int>(step.axis) + 1; axis < 3; ++axis)
        margin[axis] += (step.bound + 1) / 2;
    return margin;
}

}  // namespace

GrowingBox::GrowingBox(const CellBounds& wanted, glm::ivec3 level)
    : wanted_(wanted), cells_(wanted.grown(glm::ivec3(kReach)).inside(level)), level_(level) {
    const glm::ivec3 size = cells_.empty() ? glm::ivec3(0) : cells_.high - cells_.low;
    strides_[0] = 1;
    strides_[1] = static_cast<std::size_t>(size.x);
    strides_[2] = strides_[1] * static_cast<std::size_t>(size.y);
    distances_.assign(strides_[2] * static_cast<std::size_t>(size.z), 0);
    is_growing_.assign(distances_.size(), 0);
    for (int axis = 0; axis < 3; ++axis) {
        const auto length = static_cast<std::size_t>(size[axis]);
        has_growing_[static_cast<std::size_t>(axis)].assign(length > 0 ? distances_.size() / length : 0, 0);
    }
}

void GrowingBox::grow() {
    if (cells_.empty()) return;
    for (gpu::uint number = 0; number < gpu::kGrowthSteps; ++number)
        take_step(gpu::growth_step(number));
}

void GrowingBox::take_step(const gpu::GrowthStep& step) {
    const CellBounds needed = wanted_.grown(margin_after(step)).inside(level_);
    const int along = static_cast<int>(step.axis);
    const int across = along == 0 ? 1 : 0;
    const int last = 3 - along - across;
    const int width = across == 0 ? kLines : 1;
    line_.resize(static_cast<std::size_t>(cells_.high[along] - cells_.low[along]) *
                 static_cast<std::size_t>(width));
    glm::ivec3 cell = cells_.low;
    for (cell[last] = needed.low[last]; cell[last] < needed.high[last]; ++cell[last]) {
        for (cell[across] = needed.low[across]; cell[across] < needed.high[across]; cell[across] += width) {
            const int lines = std::min(width, needed.high[across] - cell[across]);
            const auto grows =
                has_growing_[step.axis].begin() + static_cast<std::ptrdiff_t>(line_of(cell, along));
            if (std::any_of(grows, grows + lines, [](std::uint8_t any) { return any != 0; }))
                grow_lines(index(cell), lines, step,
                           {needed.low[along] - cells_.low[along], needed.high[along] - cells_.low[along]});
        }
    }
}

// Grows cells range[0] <= i < range[1] of `width` lines side by side, the first of which begins at `start`.
// What lies beyond a line lies outside the world.
void GrowingBox::grow_lines(std::size_t start, int width, const gpu::GrowthStep& step, glm::ivec2 range) {
    const std::size_t stride = strides_[step.axis];
    const auto lines = static_cast<std::size_t>(width);
    const auto count =
        static_cast<int>(cells_.high[static_cast<int>(step.axis)] - cells_.low[static_cast<int>(step.axis)]);
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
        std::copy_n(&distances_[start + stride * i], lines, &line_[lines * i]);
    const auto at = [&](int i, std::size_t line) {
        return i >= 0 && i < count ? line_[lines * static_cast<std::size_t>(i) + line] : gpu::kEndless;
    };
    for (int i = range[0]; i < range[1]; ++i) {
        const std::size_t place = start + stride * static_cast<std::size_t>(i);
        for (std::size_t line = 0; line < lines; ++line) {
            if (is_growing_[place + line] == 0) continue;
            const std::uint32_t own = at(i, line);
            const auto low = static_cast<int>(gpu::distance_towards(own, 2 * step.axis));
            const auto high = static_cast<int>(gpu::distance_towards(own, 2 * step.axis + 1));
            const std::uint32_t lower =
                gpu::joined_distances(own, at(i - low - 1, line), 2 * step.axis, step.bound);
            distances_[place + line] =
                gpu::joined_distances(lower, at(i + high + 1, line), 2 * step.axis + 1, step.bound);
        }
    }
}

}  // namespace voxilux

#include "world/aim_grid.h"

#include <algorithm>
#include <cmath>

#include "base/assert.h"
#include "base/checked_cast.h"

namespace voxilux {

AimGrid::AimGrid(glm::dvec2 low, glm::dvec2 high, glm::ivec2 size)
    : low_(low),
      cell_((high - low) / glm::dvec2(size)),
      size_(size),
      marks_(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y)) {
    VX_ASSERT(std::max(size.x, size.y) <= static_cast<int>(gpu::kAimEdge));
}

glm::dvec2 AimGrid::row(int number) const {
    return glm::dvec2(number, number + 1) * static_cast<double>(cell_.y) + static_cast<double>(low_.y);
}

glm::ivec2 AimGrid::rows(double from, double to) const {
    const auto row_of = [&](double place) {
        const double rows = std::floor((place - static_cast<double>(low_.y)) / static_cast<double>(cell_.y));
        return std::clamp(rows, -1.0, static_cast<double>(size_.y));
    };
    return {static_cast<int>(std::max(row_of(from), 0.0)),
            static_cast<int>(std::min(row_of(to), size_.y - 1.0))};
}

void AimGrid::mark(int row, double from, double to) {
    const auto column_of = [&](double place) {
        const double columns =
            std::floor((place - static_cast<double>(low_.x)) / static_cast<double>(cell_.x));
        return std::clamp(columns, -1.0, static_cast<double>(size_.x));
    };
    mark_columns(row, static_cast<std::int64_t>(std::max(column_of(from), 0.0)),
                 static_cast<std::int64_t>(std::min(column_of(to), size_.x - 1.0)));
}

void AimGrid::mark_turned(int row, double from, double to) {
    const auto column_of = [&](double place) {
        return static_cast<std::int64_t>(
            std::floor((place - static_cast<double>(low_.x)) / static_cast<double>(cell_.x)));
    };
    const std::int64_t first = column_of(from);
    mark_columns(row, first, std::min(column_of(to), first + size_.x - 1));
}

void AimGrid::mark_columns(int row, std::int64_t first, std::int64_t last) {
    for (std::int64_t column = first; column <= last; ++column) {
        const std::int64_t inside = (column % size_.x + size_.x) % size_.x;
        marks_[static_cast<std::size_t>(row * size_.x + inside)] = true;
    }
}

bool AimGrid::is_marked(int column, int row) const {
    return marks_[static_cast<std::size_t>(row * size_.x + column)];
}

gpu::AimMap AimGrid::append_to(std::vector<gpu::uvec2>& cells) const {
    const std::size_t first = cells.size();
    for (int row = 0; row < size_.y; ++row) {
        std::vector<gpu::uint> columns;
        for (int column = 0; column < size_.x; ++column)
            if (is_marked(column, row)) columns.push_back(static_cast<gpu::uint>(column));
        gpu::AimCell cell{.row = static_cast<gpu::uint>(row),
                          .row_count = static_cast<gpu::uint>(columns.size()),
                          .row_first = checked_cast<gpu::uint>(cells.size() - first, "aim cell")};
        for (const gpu::uint column : columns) {
            cell.column = column;
            cells.push_back(gpu::pack_aim_cell(cell));
        }
    }
    return {.first = checked_cast<gpu::uint>(first, "aim cells"),
            .count = checked_cast<gpu::uint>(cells.size() - first, "aim cells"),
            .low = low_,
            .cell = cell_};
}

}  // namespace voxilux

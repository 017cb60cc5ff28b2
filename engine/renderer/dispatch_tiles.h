#pragma once

#include <cstdint>
#include <limits>

#include "passes/plane.h"
#include "plan/render_plan.h"

namespace voxilux {

// Cuts the image into tiles so that no dispatch lasts long: a GPU's watchdog kills what runs for seconds,
// and the user may want to stop. The cut never changes the image, because pixels do not depend on it.
class TileGovernor {
  public:
    TileGovernor(const RenderPlan& plan, bool is_cpu);

    // The tile from row `row` on: at most `max_rows` rows, unless the plan needs the image in one piece.
    [[nodiscard]] DispatchTile tile_at(
        std::uint32_t row, std::uint32_t max_rows = std::numeric_limits<std::uint32_t>::max()) const;

    // Adapts the size of later tiles to a rendered one: its rows and its longest dispatch.
    void adapt(std::uint32_t rows_done, double max_ms);

    [[nodiscard]] std::uint32_t rows() const { return rows_; }

    // Desired time of the longest dispatch, ms.
    [[nodiscard]] double target_ms() const { return target_ms_; }

  private:
    std::uint32_t height_;
    std::uint32_t film_tile_rows_;
    std::uint32_t max_rows_;
    std::uint32_t rows_;
    double target_ms_;
    bool keeps_whole_ = false;
};

}  // namespace voxilux

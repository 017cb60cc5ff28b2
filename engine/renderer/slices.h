#pragma once

#include <cstdint>
#include <functional>

#include "passes/plane.h"
#include "plan/render_plan.h"

namespace voxilux {

// Cuts the picture into slices so that no dispatch lasts long: a GPU's watchdog kills what runs for seconds,
// and the user may want to stop. The cut never changes the picture, because pixels do not depend on it.
class SliceGovernor {
  public:
    SliceGovernor(const RenderPlan& plan, bool is_cpu);

    // Calls `render` for each slice of the picture from top to bottom until it returns false; `render` gets
    // the slice and returns the longest dispatch in milliseconds through `max_ms`. False when it was stopped.
    // The first slice starts at row `first_row`.
    bool for_each_slice(const std::function<bool(const Slice&, double& max_ms)>& render,
                        std::uint32_t first_row = 0);

    [[nodiscard]] std::uint32_t rows() const { return rows_; }

    // Longest dispatch that is aimed at, ms.
    [[nodiscard]] double target_ms() const { return target_ms_; }

  private:
    void adapt(std::uint32_t rows_done, double max_ms);

    std::uint32_t height_;
    std::uint32_t band_rows_;
    std::uint32_t most_rows_;
    std::uint32_t rows_;
    double target_ms_;
    bool keeps_whole_ = false;
};

}  // namespace voxilux

#pragma once

#include <chrono>
#include <string>

namespace voxilux {

// Progress on standard error: one line that is overwritten ("auto" on a terminal), one JSON object per line
// ("json"), or nothing ("never", and "auto" when standard error is piped). Calls must not overlap.
class VoxelizeProgress {
  public:
    // Throws Error(usage) for another word.
    VoxelizeProgress(const std::string& mode, bool quiet);
    VoxelizeProgress(const VoxelizeProgress&) = delete;
    VoxelizeProgress& operator=(const VoxelizeProgress&) = delete;
    ~VoxelizeProgress() { finish(); }

    // `done` in [0, 1]; what is left is taken to go as fast as what is done.
    void show(double done);
    void finish();

  private:
    using Clock = std::chrono::steady_clock;
    enum class Mode { nothing, line, json };
    Mode mode_ = Mode::nothing;
    bool is_shown_ = false;
    Clock::time_point start_ = Clock::now();
    Clock::time_point last_ = start_;
};

}  // namespace voxilux

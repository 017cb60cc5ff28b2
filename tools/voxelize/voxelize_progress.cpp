#include "voxelize/voxelize_progress.h"

#include <unistd.h>

#include <cstdio>

#include "base/error.h"

namespace voxilux {
namespace {

constexpr std::chrono::milliseconds kPrintEvery{100};

}  // namespace

VoxelizeProgress::VoxelizeProgress(const std::string& mode, bool quiet) {
    if (mode != "auto" && mode != "never" && mode != "json")
        throw Error(ExitCode::usage, fmt::format("--progress: '{}' is not auto, never or json", mode));
    if (mode == "json") mode_ = Mode::json;
    if (mode == "auto" && !quiet && ::isatty(STDERR_FILENO) != 0) mode_ = Mode::line;
}

void VoxelizeProgress::show(double done) {
    if (mode_ == Mode::nothing) return;
    const Clock::time_point now = Clock::now();
    if (now - last_ < kPrintEvery && done < 1.0) return;
    last_ = now;
    const double elapsed_s = std::chrono::duration<double>(now - start_).count();
    const double left_s = done > 0.0 ? elapsed_s * (1.0 - done) / done : 0.0;
    if (mode_ == Mode::json) {
        fmt::print(stderr, "{{\"done\":{:.4f},\"elapsed_s\":{:.3f},\"remaining_s\":{:.3f}}}\n", done,
                   elapsed_s, left_s);
    } else {
        fmt::print(stderr, "\rvoxelize {:5.1f} %  {:.0f} s, about {:.0f} s left\x1b[K", 100.0 * done,
                   elapsed_s, left_s);
        std::fflush(stderr);
        is_shown_ = true;
    }
}

void VoxelizeProgress::finish() {
    if (is_shown_) std::fputs("\r\x1b[K", stderr);
    is_shown_ = false;
}

}  // namespace voxilux

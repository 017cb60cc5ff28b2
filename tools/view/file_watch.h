#pragma once

#include <chrono>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/clock.h"

namespace voxilux {

// Notices when somebody writes a file.
class FileWatch {
  public:
    FileWatch() = default;
    explicit FileWatch(std::filesystem::path file) : file_(std::move(file)), time_(time_of(file_)) {}

    // Whether it was written since the start, or since the last call that returned true. Looks a few times a
    // second.
    [[nodiscard]] bool has_changed() {
        if (file_.empty() || seconds_since(looked_) < kLookEvery_s) return false;
        looked_ = std::chrono::steady_clock::now();
        return std::exchange(time_, time_of(file_)) != time_;
    }
    // Ignores what was written until now.
    void forgive() { time_ = time_of(file_); }

  private:
    static constexpr double kLookEvery_s = 0.25;

    // The smallest time for a file that is absent, as while it is being replaced.
    static std::filesystem::file_time_type time_of(const std::filesystem::path& file) {
        std::error_code ignored;
        return std::filesystem::last_write_time(file, ignored);
    }

    std::filesystem::path file_;
    std::filesystem::file_time_type time_;
    std::chrono::steady_clock::time_point looked_;
};

}  // namespace voxilux

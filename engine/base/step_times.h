#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "base/stopwatch.h"

namespace voxilux {

struct StepTime {
    std::string label;
    Seconds time;
};

// Adds times label by label; labels that are new go to the end.
inline void add_step_times(std::vector<StepTime>& sum, const std::vector<StepTime>& more) {
    for (const StepTime& step : more) {
        auto known = std::ranges::find(sum, step.label, &StepTime::label);
        if (known == sum.end()) known = sum.insert(known, StepTime{.label = step.label});
        known->time.wall += step.time.wall;
        known->time.cpu += step.time.cpu;
    }
}

// How long each step took.
class StepTimes {
  public:
    // The step that began where the last one ended.
    void end_step(const std::string& label) {
        steps_.push_back({label, step_.elapsed()});
        step_ = Stopwatch();
    }
    [[nodiscard]] const std::vector<StepTime>& steps() const { return steps_; }
    [[nodiscard]] Seconds total() const { return all_.elapsed(); }

  private:
    Stopwatch all_, step_;
    std::vector<StepTime> steps_;
};

}  // namespace voxilux

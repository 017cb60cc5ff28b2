#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/stopwatch.h"
#include "voxelize/voxelize.h"
#include "voxelizer/vox_output.h"

namespace voxilux {

// How long each step took.
class StepTimes {
  public:
    struct Step {
        std::string label;
        Seconds time;
    };

    // Ends the step that began where the last one ended.
    void end_step(const std::string& label) {
        steps_.push_back({label, step_.elapsed()});
        step_ = Stopwatch();
    }
    [[nodiscard]] const std::vector<Step>& steps() const { return steps_; }
    [[nodiscard]] Seconds total() const { return all_.elapsed(); }

  private:
    Stopwatch all_, step_;
    std::vector<Step> steps_;
};

// All that a report is made from, by reference.
struct VoxelizeFacts {
    const VoxelizeCommand& command;
    const Mesh& mesh;
    const VoxelSet& set;
    const VoxelPalette& palette;
    const VoxOutput& written;
    const StepTimes& times;
    const std::vector<std::string>& warnings;
    const std::string& output;
};

// The lines for people.
[[nodiscard]] std::string describe(const VoxelizeFacts& facts);

// The report for scripts.
[[nodiscard]] nlohmann::ordered_json report_json(const VoxelizeFacts& facts);

}  // namespace voxilux

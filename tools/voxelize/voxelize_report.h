#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "voxelize/voxelize.h"
#include "voxelizer/vox_output.h"

namespace voxilux {

// How long each step took.
class StepTimes {
  public:
    struct Step {
        std::string label;
        double wall_s = 0.0;
        double cpu_s = 0.0;  // of all threads
    };

    StepTimes();
    // The step that began where the last one ended.
    void end_step(const std::string& label);
    [[nodiscard]] const std::vector<Step>& steps() const { return steps_; }
    [[nodiscard]] double wall_s() const;

  private:
    std::chrono::steady_clock::time_point start_, last_;
    double last_cpu_s_ = 0.0;
    std::vector<Step> steps_;
};

// All that a report is made from. Refers to what must outlive it.
struct VoxelizeFacts {
    const VoxelizeCommand& command;
    const VoxelizeRequest& request;
    const Mesh& mesh;
    const VoxelSet& set;
    const VoxelPalette& palette;
    const VoxOutput& written;
    const StepTimes& times;
    const std::vector<std::string>& warnings;
    const std::filesystem::path& output;
};

// The lines for people.
[[nodiscard]] std::string describe(const VoxelizeFacts& facts);

// The report for scripts.
[[nodiscard]] nlohmann::ordered_json report_json(const VoxelizeFacts& facts);

}  // namespace voxilux

#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/step_times.h"
#include "voxelize/voxelize.h"
#include "voxelizer/vox_output.h"

namespace voxilux {

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

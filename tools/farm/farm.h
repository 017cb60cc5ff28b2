#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "jobs/picture_files.h"
#include "scene_options.h"
#include "shared_flags.h"

namespace voxilux {

struct FarmCommand {
    SceneOptions scene;
    std::function<Flags::GivenWords()> scene_words;  // the flags of the scene, for the renders of the workers
    std::string device;
    PictureFiles pictures;
    std::function<Flags::GivenWords()> tone_words;
    ReportOptions report;
    ProgressMode progress = ProgressMode::automatic;
    std::optional<double> error_target;
    std::optional<double> time_limit_s;
    std::string scheduler;  // empty: a cluster of this machine alone
    std::optional<int> workers;
    std::string worker_binary;  // empty: that of this process
    bool resume = false;
    bool allow_mixed_devices = false;
};

void add_farm_flags(Flags& flags, FarmCommand& command);

// Reads the scene, then replaces this process by the Python program that renders it on the workers of a Dask
// cluster. Throws Error(no_device) when Python or Dask is missing.
[[nodiscard]] int run_farm(const FarmCommand& command);

// The Python program, which the build puts inside the binary.
[[nodiscard]] std::string_view farm_source();

}  // namespace voxilux

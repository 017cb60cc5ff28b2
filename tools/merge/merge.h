#pragma once

#include <string>
#include <vector>

#include "jobs/picture_files.h"
#include "shared_flags.h"

namespace voxilux {

struct MergeCommand {
    std::vector<std::string> parts;
    PictureFiles pictures;
    ReportOptions report;
    bool partial = false;
    bool allow_mixed_devices = false;
};

void add_merge_flags(Flags& flags, MergeCommand& command);

// Adds the parts of a render up and writes its picture. Returns done. Throws Error(input_refused) for parts
// that do not belong together, and for missing ones unless --partial was given.
[[nodiscard]] int run_merge(const MergeCommand& command);

}  // namespace voxilux

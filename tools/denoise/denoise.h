#pragma once

#include <string>

#include "jobs/picture_files.h"
#include "shared_flags.h"

namespace voxilux {

struct DenoiseCommand {
    std::string input;
    PictureFiles pictures;
    ReportOptions report;
    DeviceOptions device;
};

void add_denoise_flags(Flags& flags, DenoiseCommand& command);

// Filters the picture of a part and writes it with its estimated error. Returns done. Throws
// Error(input_refused) for a file that has no sums of the denoiser.
[[nodiscard]] int run_denoise(const DenoiseCommand& command);

}  // namespace voxilux

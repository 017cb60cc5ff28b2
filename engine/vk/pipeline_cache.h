#pragma once

#include <filesystem>

#include "vk/device_state.h"
#include "vk/handle.h"

namespace voxilux {

// The pipeline cache stored in `folder` for this device, or an empty one when the file is absent, damaged or
// of another driver. An empty `folder` means no file.
[[nodiscard]] UniquePipelineCache load_pipeline_cache(const DeviceState& device,
                                                      const std::filesystem::path& folder);

// Stores it there. A cache that cannot be stored only costs time, so failures are silent.
void save_pipeline_cache(const DeviceState& device, VkPipelineCache cache,
                         const std::filesystem::path& folder);

}  // namespace voxilux

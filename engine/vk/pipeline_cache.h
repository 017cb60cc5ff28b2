#pragma once

#include <filesystem>

#include "vk/device_state.h"
#include "vk/handle.h"

namespace voxilux {

// The pipeline cache stored in `folder` for this device, or an empty one when the file is missing, damaged or
// from another driver. An empty `folder` means no file.
[[nodiscard]] UniquePipelineCache load_pipeline_cache(const DeviceState& device,
                                                      const std::filesystem::path& folder);

// Stores the cache there. Failures are silent, because a missing cache only costs time.
void save_pipeline_cache(const DeviceState& device, VkPipelineCache cache,
                         const std::filesystem::path& folder);

}  // namespace voxilux

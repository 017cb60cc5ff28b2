#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vk/device_state.h"
#include "vk/executor.h"
#include "vk/handle.h"

namespace voxilux {

// Timestamps around the dispatches of one run. Every time is 0 when the device has no timestamps.
struct Timers {
    UniqueQueryPool pool;
    std::uint32_t capacity = 0;       // dispatches that fit the pool
    std::vector<std::string> labels;  // of the dispatches of this run, in order
    bool is_on = false;
};

// Makes room for `dispatches` and forgets the last run. `commands` must be recorded and run before any
// timing.
void start_timers(const DeviceState& device, Timers& timers, std::uint32_t dispatches,
                  VkCommandBuffer commands);

// Called around one dispatch.
void begin_timing(Timers& timers, VkCommandBuffer commands, const std::string& label);
void end_timing(const Timers& timers, VkCommandBuffer commands);

// The times by label, after the commands have run.
[[nodiscard]] std::vector<PassTime> collect_times(const DeviceState& device, const Timers& timers);

}  // namespace voxilux

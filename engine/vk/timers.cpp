#include "vk/timers.h"

#include "base/checked_cast.h"
#include "vk/check.h"

namespace voxilux {
namespace {

// Both timestamps are taken when all earlier work is done, so that waiting for it is not counted.
constexpr VkPipelineStageFlagBits kStampStage = VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT;

void grow(const DeviceState& device, Timers& timers, std::uint32_t dispatches) {
    timers.pool.reset();
    const VkQueryPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                                     .queryType = VK_QUERY_TYPE_TIMESTAMP,
                                     .queryCount = 2 * dispatches};
    VkQueryPool pool = VK_NULL_HANDLE;
    vk_check(vkCreateQueryPool(device.handle, &info, nullptr, &pool), "create the timestamps");
    timers.pool = {device.handle, pool};
    timers.capacity = dispatches;
    set_debug_name(device, VK_OBJECT_TYPE_QUERY_POOL, to_bits(pool), "executor.timestamps");
}

std::uint32_t last_index(const Timers& timers) {
    return checked_cast<std::uint32_t>(timers.labels.size() - 1, "timed dispatch");
}

}  // namespace

void start_timers(const DeviceState& device, Timers& timers, std::uint32_t dispatches,
                  VkCommandBuffer commands) {
    timers.labels.clear();
    timers.is_on = device.timestamp_bits > 0 && dispatches > 0;
    if (!timers.is_on) return;
    if (dispatches > timers.capacity) grow(device, timers, dispatches);
    vkCmdResetQueryPool(commands, timers.pool.get(), 0, 2 * dispatches);
}

void begin_timing(Timers& timers, VkCommandBuffer commands, const std::string& label) {
    timers.labels.push_back(label);
    if (timers.is_on) vkCmdWriteTimestamp(commands, kStampStage, timers.pool.get(), 2 * last_index(timers));
}

void end_timing(const Timers& timers, VkCommandBuffer commands) {
    if (timers.is_on)
        vkCmdWriteTimestamp(commands, kStampStage, timers.pool.get(), 2 * last_index(timers) + 1);
}

std::vector<PassTime> collect_times(const DeviceState& device, const Timers& timers) {
    std::vector<std::uint64_t> stamps(2 * timers.labels.size());
    if (timers.is_on && !stamps.empty()) {
        vk_check(
            vkGetQueryPoolResults(device.handle, timers.pool.get(), 0,
                                  checked_cast<std::uint32_t>(stamps.size(), "timestamps"),
                                  stamps.size() * sizeof(std::uint64_t), stamps.data(), sizeof(std::uint64_t),
                                  VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
            "read the timestamps");
    }
    const std::uint64_t mask =
        device.timestamp_bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << device.timestamp_bits) - 1;
    const double ms_per_tick = static_cast<double>(device.properties.limits.timestampPeriod) * 1e-6;
    std::vector<PassTime> rows;
    for (std::size_t i = 0; i < timers.labels.size(); ++i) {
        const double ms = static_cast<double>((stamps[2 * i + 1] - stamps[2 * i]) & mask) * ms_per_tick;
        const PassTime one{.label = timers.labels[i], .count = 1, .ms = ms, .max_ms = ms};
        add_times(rows, std::span(&one, 1));
    }
    return rows;
}

}  // namespace voxilux

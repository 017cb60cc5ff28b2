#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "vk/buffer_store.h"
#include "vk/device_state.h"
#include "vk/handle.h"
#include "vk/program.h"
#include "vk/program_store.h"

namespace voxilux {

// The descriptor sets of one run.
struct Descriptors {
    UniqueDescriptorPool pool;
    std::uint32_t max_sets = 0;
    std::uint32_t max_buffers = 0;
};

// Forgets the sets of the last run and makes room for one set per dispatch.
void start_descriptors(const DeviceState& device, Descriptors& descriptors,
                       std::span<const PreparedDispatch> dispatches);

// A set with the buffers that the dispatch binds. Throws InternalError that names the block and the buffer
// when it is over the binding limit.
[[nodiscard]] VkDescriptorSet create_set(const DeviceState& device, const Descriptors& descriptors,
                                         const PreparedDispatch& dispatch, const BufferStore& buffers);

}  // namespace voxilux

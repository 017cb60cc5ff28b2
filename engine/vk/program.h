#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "embedded.h"
#include "record/recording.h"
#include "vk/device_state.h"
#include "vk/handle.h"
#include "vk/spirv_reflect.h"

namespace voxilux {

// A shader with its layouts and the pipelines created so far, by the values of its constants.
struct Program {
    std::string name;
    ProgramInfo info;
    UniqueShaderModule module;
    UniqueSetLayout set_layout;
    UniquePipelineLayout layout;
    std::map<std::vector<std::uint32_t>, UniquePipeline> pipelines;
};

// The descriptor type that a block is bound as.
[[nodiscard]] VkDescriptorType descriptor_type(const BufferBlock& block);

[[nodiscard]] UniqueShaderModule create_shader_module(const DeviceState& device,
                                                      const EmbeddedShader& shader);

// Reflects the shader and creates its layouts. Throws InternalError when the device lacks a capability that
// it needs.
[[nodiscard]] Program create_program(const DeviceState& device, const EmbeddedShader& shader);

// A value for each of the program's constants, in order of id: the dispatch's, or the group size for the
// local size when both x and y are constants, or the default. Throws InternalError for a name that the shader
// does not have.
[[nodiscard]] std::vector<std::uint32_t> resolve_constants(const Program& program, const Dispatch& dispatch,
                                                           std::array<std::uint32_t, 2> group_size);

// Invocations of one group under these values. Throws Error(usage) when the device cannot run so many.
[[nodiscard]] std::array<std::uint32_t, 3> local_size(const DeviceState& device, const Program& program,
                                                      std::span<const std::uint32_t> constants);

// Compiles the program with these values.
[[nodiscard]] UniquePipeline create_pipeline(const DeviceState& device, const Program& program,
                                             std::span<const std::uint32_t> constants, VkPipelineCache cache);

// Throws InternalError that names the shader unless the dispatch gives each block and each pointer of the
// push struct exactly one buffer, and its push bytes have the size of the rest of the push struct.
void check_fits(const Program& program, const Dispatch& dispatch);

// Groups to dispatch for the extent. One-dimensional extents beyond the limit are folded into y. Throws
// InternalError that names the shader when the extent does not fit.
[[nodiscard]] std::array<std::uint32_t, 3> group_counts(const std::string& shader, const Extent& extent,
                                                        std::array<std::uint32_t, 3> local_size,
                                                        std::array<std::uint32_t, 3> max_groups);

}  // namespace voxilux

#include "vk/program.h"

#include <algorithm>

#include "base/checked_cast.h"
#include "base/error.h"
#include "vk/check.h"

namespace voxilux {
namespace {

[[noreturn]] void refuse(const std::string& shader, std::string_view why) {
    throw InternalError(fmt::format("internal error: shader '{}': {}", shader, why));
}

std::uint64_t ceil_div(std::uint64_t a, std::uint64_t b) {
    return (a + b - 1) / b;
}

void check_capabilities(const DeviceState& device, const Program& program) {
    for (const std::uint32_t capability : program.info.capabilities) {
        if (std::ranges::count(device.missing_capabilities, capability) == 0) continue;
        refuse(program.name, fmt::format("needs SPIR-V capability {}, which device '{}' does not offer",
                                         capability, device.info.name));
    }
}

UniqueSetLayout create_set_layout(const DeviceState& device, const Program& program) {
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (const BufferBlock& block : program.info.blocks) {
        bindings.push_back({.binding = block.binding,
                            .descriptorType = descriptor_type(block),
                            .descriptorCount = 1,
                            .stageFlags = VK_SHADER_STAGE_COMPUTE_BIT});
    }
    const VkDescriptorSetLayoutCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
        .bindingCount = checked_cast<std::uint32_t>(bindings.size(), "bindings"),
        .pBindings = bindings.data()};
    VkDescriptorSetLayout layout = VK_NULL_HANDLE;
    vk_check(vkCreateDescriptorSetLayout(device.handle, &info, nullptr, &layout),
             fmt::format("create the set layout of '{}'", program.name));
    set_debug_name(device, VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, to_bits(layout), program.name);
    return {device.handle, layout};
}

UniquePipelineLayout create_layout(const DeviceState& device, const Program& program) {
    const VkPushConstantRange range{.stageFlags = VK_SHADER_STAGE_COMPUTE_BIT,
                                    .size = program.info.push_bytes};
    const VkDescriptorSetLayout set_layout = program.set_layout.get();
    const VkPipelineLayoutCreateInfo info{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                          .setLayoutCount = 1,
                                          .pSetLayouts = &set_layout,
                                          .pushConstantRangeCount = range.size > 0 ? 1u : 0u,
                                          .pPushConstantRanges = &range};
    VkPipelineLayout layout = VK_NULL_HANDLE;
    vk_check(vkCreatePipelineLayout(device.handle, &info, nullptr, &layout),
             fmt::format("create the pipeline layout of '{}'", program.name));
    set_debug_name(device, VK_OBJECT_TYPE_PIPELINE_LAYOUT, to_bits(layout), program.name);
    return {device.handle, layout};
}

std::size_t constant_index(const ProgramInfo& info, std::uint32_t id) {
    return static_cast<std::size_t>(std::ranges::find(info.constants, id, &SpecConstant::id) -
                                    info.constants.begin());
}

void check_addresses(const Program& program, const Dispatch& dispatch) {
    for (const Address& address : dispatch.addresses) {
        if (program.info.find_address(address.member) == nullptr)
            refuse(program.name, fmt::format("has no pointer '{}' in its push struct to point to '{}'",
                                             address.member, address.buffer));
    }
    for (const AddressMember& member : program.info.addresses) {
        const auto given = std::ranges::count(dispatch.addresses, member.name, &Address::member);
        if (given != 1)
            refuse(program.name, fmt::format("pointer '{}' is given {} times", member.name, given));
    }
}

}  // namespace

UniqueShaderModule create_shader_module(const DeviceState& device, const EmbeddedShader& shader) {
    const VkShaderModuleCreateInfo info{.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                        .codeSize = shader.spirv.size_bytes(),
                                        .pCode = shader.spirv.data()};
    VkShaderModule module = VK_NULL_HANDLE;
    vk_check(vkCreateShaderModule(device.handle, &info, nullptr, &module),
             fmt::format("create shader '{}'", shader.name));
    set_debug_name(device, VK_OBJECT_TYPE_SHADER_MODULE, to_bits(module), std::string(shader.name));
    return {device.handle, module};
}

VkDescriptorType descriptor_type(const BufferBlock& block) {
    switch (block.kind) {
        case BlockKind::uniform:
            return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
        case BlockKind::texels:
        case BlockKind::words:
            return VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER;
        case BlockKind::storage:
            return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    }
    return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
}

Program create_program(const DeviceState& device, const EmbeddedShader& shader) {
    Program program{.name = std::string(shader.name), .info = reflect(shader.spirv)};
    check_capabilities(device, program);
    const std::uint32_t push_limit = device.info.limits.max_push_bytes;
    if (program.info.push_bytes > push_limit)
        refuse(program.name, fmt::format("its push struct of {} bytes is over the device's limit of {}",
                                         program.info.push_bytes, push_limit));
    program.module = create_shader_module(device, shader);
    program.set_layout = create_set_layout(device, program);
    program.layout = create_layout(device, program);
    return program;
}

std::vector<std::uint32_t> resolve_constants(const Program& program, const Dispatch& dispatch,
                                             std::array<std::uint32_t, 2> group_size) {
    const ProgramInfo& info = program.info;
    std::vector<std::uint32_t> values;
    for (const SpecConstant& constant : info.constants)
        values.push_back(constant.default_value);
    if (info.local_size[0].spec_id && info.local_size[1].spec_id) {
        values[constant_index(info, *info.local_size[0].spec_id)] = group_size[0];
        values[constant_index(info, *info.local_size[1].spec_id)] = group_size[1];
    }
    for (const Constant& given : dispatch.constants) {
        const SpecConstant* constant = given.name.empty() ? nullptr : info.find_constant(given.name);
        if (constant == nullptr) refuse(program.name, fmt::format("has no constant '{}'", given.name));
        values[constant_index(info, constant->id)] = given.value;
    }
    return values;
}

std::array<std::uint32_t, 3> local_size(const DeviceState& device, const Program& program,
                                        std::span<const std::uint32_t> constants) {
    std::array<std::uint32_t, 3> size{};
    const VkPhysicalDeviceLimits& limits = device.properties.limits;
    std::uint64_t invocations = 1;
    bool fits = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const LocalSizeAxis& declared = program.info.local_size[axis];
        size[axis] =
            declared.spec_id ? constants[constant_index(program.info, *declared.spec_id)] : declared.size;
        fits = fits && size[axis] > 0 && size[axis] <= limits.maxComputeWorkGroupSize[axis];
        invocations *= std::min<std::uint32_t>(size[axis], 1u << 20);
    }
    if (fits && invocations <= limits.maxComputeWorkGroupInvocations) return size;
    throw Error(ExitCode::usage,
                fmt::format("shader '{}' in groups of {}x{}x{}: device '{}' runs at least 1 and at most {} "
                            "invocations in a group; choose another group size",
                            program.name, size[0], size[1], size[2], device.info.name,
                            limits.maxComputeWorkGroupInvocations));
}

UniquePipeline create_pipeline(const DeviceState& device, const Program& program,
                               std::span<const std::uint32_t> constants, VkPipelineCache cache) {
    std::vector<VkSpecializationMapEntry> entries;
    for (const SpecConstant& constant : program.info.constants) {
        const auto offset =
            checked_cast<std::uint32_t>(entries.size() * sizeof(std::uint32_t), "constant offset");
        entries.push_back({.constantID = constant.id, .offset = offset, .size = sizeof(std::uint32_t)});
    }
    const VkSpecializationInfo specialization{
        .mapEntryCount = checked_cast<std::uint32_t>(entries.size(), "constants"),
        .pMapEntries = entries.data(),
        .dataSize = constants.size_bytes(),
        .pData = constants.data()};
    const VkComputePipelineCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
        .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                  .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                  .module = program.module.get(),
                  .pName = "main",
                  .pSpecializationInfo = &specialization},
        .layout = program.layout.get()};
    VkPipeline pipeline = VK_NULL_HANDLE;
    vk_check(vkCreateComputePipelines(device.handle, cache, 1, &info, nullptr, &pipeline),
             fmt::format("create the pipeline of shader '{}'", program.name));
    set_debug_name(device, VK_OBJECT_TYPE_PIPELINE, to_bits(pipeline), program.name);
    return {device.handle, pipeline};
}

void check_fits(const Program& program, const Dispatch& dispatch) {
    for (const Binding& binding : dispatch.bindings) {
        if (program.info.find_block(binding.block) == nullptr)
            refuse(program.name,
                   fmt::format("has no block '{}' to bind '{}' to", binding.block, binding.buffer));
    }
    for (const BufferBlock& block : program.info.blocks) {
        const auto bound = std::ranges::count(dispatch.bindings, block.name, &Binding::block);
        if (bound != 1) refuse(program.name, fmt::format("block '{}' is bound {} times", block.name, bound));
    }
    check_addresses(program, dispatch);
    const std::size_t rest = program.info.push_bytes - program.info.addresses.size() * kAddressBytes;
    if (dispatch.push.size() != rest)
        refuse(program.name,
               fmt::format("{} push bytes were given, its push struct has {}", dispatch.push.size(), rest));
}

std::array<std::uint32_t, 3> group_counts(const std::string& shader, const Extent& extent,
                                          std::array<std::uint32_t, 3> local_size,
                                          std::array<std::uint32_t, 3> max_groups) {
    std::array<std::uint64_t, 3> groups = {ceil_div(extent.x, local_size[0]),
                                           ceil_div(extent.y, local_size[1]),
                                           ceil_div(extent.z, local_size[2])};
    const bool is_list = extent.y == 1 && extent.z == 1 && local_size[1] == 1 && local_size[2] == 1;
    if (is_list && groups[0] > max_groups[0]) {
        groups[1] = ceil_div(groups[0], max_groups[0]);
        groups[0] = ceil_div(groups[0], groups[1]);
        // Folding rounds up; beyond 2^32 the linear ids of the surplus invocations would wrap to small ones.
        if (groups[0] * groups[1] * local_size[0] > (std::uint64_t{1} << 32))
            refuse(shader, fmt::format("an extent of {} does not fit 32-bit ids", extent.x));
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (groups[axis] > max_groups[axis])
            refuse(shader,
                   fmt::format("an extent of {}x{}x{} needs {} groups on axis {}, over the limit of {}",
                               extent.x, extent.y, extent.z, groups[axis], axis, max_groups[axis]));
    }
    return {static_cast<std::uint32_t>(groups[0]), static_cast<std::uint32_t>(groups[1]),
            static_cast<std::uint32_t>(groups[2])};
}

}  // namespace voxilux

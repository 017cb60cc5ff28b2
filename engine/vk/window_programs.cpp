#include "vk/window_programs.h"

#include <algorithm>

#include "base/error.h"
#include "shared/window.h"
#include "vk/check.h"
#include "vk/program.h"

namespace voxilux {
namespace {

constexpr VkShaderStageFlags kStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

UniqueSetLayout create_set_layout(const DeviceState& device) {
    std::array<VkDescriptorSetLayoutBinding, kWindowBuffers> bindings{};
    for (std::uint32_t i = 0; i < bindings.size(); ++i)
        bindings[i] = {.binding = i,
                       .descriptorType = descriptor_type(static_cast<WindowBuffer>(i)),
                       .descriptorCount = 1,
                       .stageFlags = kStages};
    const VkDescriptorSetLayoutCreateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                               .bindingCount = kWindowBuffers,
                                               .pBindings = bindings.data()};
    VkDescriptorSetLayout layout = VK_NULL_HANDLE;
    vk_check(vkCreateDescriptorSetLayout(device.handle, &info, nullptr, &layout), "create the window's set");
    return {device.handle, layout};
}

UniquePipelineLayout create_layout(const DeviceState& device, VkDescriptorSetLayout set) {
    const VkPushConstantRange push{kStages, 0, sizeof(gpu::WindowPush)};
    const VkPipelineLayoutCreateInfo info{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                          .setLayoutCount = 1,
                                          .pSetLayouts = &set,
                                          .pushConstantRangeCount = 1,
                                          .pPushConstantRanges = &push};
    VkPipelineLayout layout = VK_NULL_HANDLE;
    vk_check(vkCreatePipelineLayout(device.handle, &info, nullptr, &layout), "create the window's layout");
    return {device.handle, layout};
}

UniqueDescriptorPool create_pool(const DeviceState& device) {
    constexpr std::array<VkDescriptorPoolSize, 2> kSizes{
        {{VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER, 1},
         {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kWindowBuffers - 1}}};
    const VkDescriptorPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                          .maxSets = 1,
                                          .poolSizeCount = kSizes.size(),
                                          .pPoolSizes = kSizes.data()};
    VkDescriptorPool pool = VK_NULL_HANDLE;
    vk_check(vkCreateDescriptorPool(device.handle, &info, nullptr, &pool), "create the window's pool");
    return {device.handle, pool};
}

VkDescriptorSet allocate_set(const DeviceState& device, VkDescriptorPool pool, VkDescriptorSetLayout layout) {
    const VkDescriptorSetAllocateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                           .descriptorPool = pool,
                                           .descriptorSetCount = 1,
                                           .pSetLayouts = &layout};
    VkDescriptorSet set = VK_NULL_HANDLE;
    vk_check(vkAllocateDescriptorSets(device.handle, &info, &set), "allocate the window's set");
    return set;
}

const EmbeddedShader& shader_named(std::span<const EmbeddedShader> shaders, std::string_view name) {
    const auto found = std::ranges::find(shaders, name, &EmbeddedShader::name);
    if (found == shaders.end()) throw InternalError(fmt::format("internal error: no shader '{}'", name));
    return *found;
}

// Alpha blending of the overlay over the image.
constexpr VkPipelineColorBlendAttachmentState kBlending{
    .blendEnable = VK_TRUE,
    .srcColorBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA,
    .dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA,
    .colorBlendOp = VK_BLEND_OP_ADD,
    .srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE,
    .dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA,
    .alphaBlendOp = VK_BLEND_OP_ADD,
    .colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT |
                      VK_COLOR_COMPONENT_A_BIT};

UniquePipeline create_overlay_pipeline(const DeviceState& device, std::span<const EmbeddedShader> shaders,
                                       VkPipelineLayout layout, VkRenderPass pass) {
    const UniqueShaderModule vertex = create_shader_module(device, shader_named(shaders, "overlay_place"));
    const UniqueShaderModule fragment = create_shader_module(device, shader_named(shaders, "overlay_tint"));
    std::array<VkPipelineShaderStageCreateInfo, 2> both{};
    both[0] = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
               .stage = VK_SHADER_STAGE_VERTEX_BIT,
               .module = vertex.get(),
               .pName = "main"};
    both[1] = both[0];
    both[1].stage = VK_SHADER_STAGE_FRAGMENT_BIT;
    both[1].module = fragment.get();
    const VkPipelineVertexInputStateCreateInfo input{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    const VkPipelineInputAssemblyStateCreateInfo assembly{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
        .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST};
    const VkPipelineViewportStateCreateInfo viewport{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
        .viewportCount = 1,
        .scissorCount = 1};
    const VkPipelineRasterizationStateCreateInfo raster{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO, .lineWidth = 1.0f};
    const VkPipelineMultisampleStateCreateInfo samples{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
        .rasterizationSamples = VK_SAMPLE_COUNT_1_BIT};
    const VkPipelineColorBlendStateCreateInfo blend{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
        .attachmentCount = 1,
        .pAttachments = &kBlending};
    constexpr std::array kDynamic{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    const VkPipelineDynamicStateCreateInfo dynamic{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
        .dynamicStateCount = kDynamic.size(),
        .pDynamicStates = kDynamic.data()};
    const VkGraphicsPipelineCreateInfo info{.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                            .stageCount = both.size(),
                                            .pStages = both.data(),
                                            .pVertexInputState = &input,
                                            .pInputAssemblyState = &assembly,
                                            .pViewportState = &viewport,
                                            .pRasterizationState = &raster,
                                            .pMultisampleState = &samples,
                                            .pColorBlendState = &blend,
                                            .pDynamicState = &dynamic,
                                            .layout = layout,
                                            .renderPass = pass};
    VkPipeline pipeline = VK_NULL_HANDLE;
    vk_check(vkCreateGraphicsPipelines(device.handle, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
             "create the window's pipeline");
    return {device.handle, pipeline};
}

}  // namespace

WindowPrograms create_window_programs(const DeviceState& device, std::span<const EmbeddedShader> shaders,
                                      VkRenderPass pass) {
    WindowPrograms programs;
    programs.set_layout = create_set_layout(device);
    programs.layout = create_layout(device, programs.set_layout.get());
    programs.pool = create_pool(device);
    programs.set = allocate_set(device, programs.pool.get(), programs.set_layout.get());
    programs.overlay = create_overlay_pipeline(device, shaders, programs.layout.get(), pass);
    return programs;
}

}  // namespace voxilux

#include "vk/presenter.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <optional>

#include "base/error.h"
#include "shared/window.h"
#include "vk/buffer.h"
#include "vk/check.h"
#include "vk/device_state.h"
#include "vk/swapchain.h"
#include "vk/window_capture.h"
#include "vk/window_image.h"
#include "vk/window_programs.h"

namespace voxilux {
namespace {

constexpr std::uint64_t kNever = std::numeric_limits<std::uint64_t>::max();
constexpr std::uint64_t kMinBytes = 64;

UniqueCommandPool create_command_pool(const DeviceState& device) {
    const VkCommandPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                       .queueFamilyIndex = device.family};
    VkCommandPool pool = VK_NULL_HANDLE;
    vk_check(vkCreateCommandPool(device.handle, &info, nullptr, &pool), "create the window's command pool");
    return {device.handle, pool};
}

VkCommandBuffer allocate_commands(const DeviceState& device, VkCommandPool pool) {
    const VkCommandBufferAllocateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                           .commandPool = pool,
                                           .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                           .commandBufferCount = 1};
    VkCommandBuffer commands = VK_NULL_HANDLE;
    vk_check(vkAllocateCommandBuffers(device.handle, &info, &commands), "allocate the window's commands");
    return commands;
}

UniqueFence create_window_fence(const DeviceState& device) {
    const VkFenceCreateInfo info{.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    VkFence fence = VK_NULL_HANDLE;
    vk_check(vkCreateFence(device.handle, &info, nullptr, &fence), "create the window's fence");
    return {device.handle, fence};
}

}  // namespace

// Destroyed before its instance.
struct WindowSurface {
    WindowSurface(VkInstance of, VkSurfaceKHR handle) : instance(of), get(handle) {}
    WindowSurface(const WindowSurface&) = delete;
    WindowSurface& operator=(const WindowSurface&) = delete;
    ~WindowSurface() { vkDestroySurfaceKHR(instance, get, nullptr); }

    VkInstance instance;
    VkSurfaceKHR get;
};

struct PresenterState {
    PresenterState(DeviceState& opened, VkSurfaceKHR window, std::span<const EmbeddedShader> shaders)
        : device(opened),
          surface(opened.instance.get(), window),
          format(choose_surface_format(opened, window)),
          pass(create_window_pass(opened, format.format)),
          programs(create_window_programs(opened, shaders, pass.get())),
          pool(create_command_pool(opened)),
          commands(allocate_commands(opened, pool.get())),
          fence(create_window_fence(opened)),
          acquired(create_semaphore(opened)) {}

    // Copies to a host buffer, which grows where it is too small.
    void fill(WindowBuffer which, std::span<const std::byte> bytes) {
        Buffer& buffer = buffers[static_cast<std::size_t>(which)];
        const std::uint64_t wanted = std::max<std::uint64_t>(bytes.size(), kMinBytes);
        if (buffer.bytes < wanted) {
            buffer = {};
            buffer = create_staging_buffer(device, "window.buffer", wanted + wanted / 2);
        }
        if (!bytes.empty()) std::memcpy(buffer.mapped, bytes.data(), bytes.size());
    }

    DeviceState& device;
    WindowSurface surface;
    VkSurfaceFormatKHR format;
    UniqueRenderPass pass;
    WindowPrograms programs;
    UniqueCommandPool pool;
    VkCommandBuffer commands;
    UniqueFence fence;
    UniqueSemaphore acquired;
    std::optional<Swapchain> swapchain;
    bool is_stale = true;  // the swapchain no longer fits the window
    std::uint32_t font_width = 0;
    glm::ivec2 window_size{0};  // when the swapchain was made, pixels
    std::array<Buffer, kWindowBuffers> buffers;
    Buffer captured;
    WindowImage scaled;  // the image, where its size is not that of the window
};

namespace {

void bind_buffers(const PresenterState& state) {
    std::array<VkDescriptorBufferInfo, kWindowBuffers> infos{};
    std::array<VkWriteDescriptorSet, kWindowBuffers> writes{};
    std::array<VkBufferView, kWindowBuffers> views{};
    for (std::uint32_t i = 0; i < kWindowBuffers; ++i) {
        infos[i] = {state.buffers[i].handle.get(), 0, VK_WHOLE_SIZE};
        views[i] = state.buffers[i].words.get();
        writes[i] = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                     .dstSet = state.programs.set,
                     .dstBinding = i,
                     .descriptorCount = 1,
                     .descriptorType = descriptor_type(static_cast<WindowBuffer>(i)),
                     .pBufferInfo = &infos[i],
                     .pTexelBufferView = &views[i]};
    }
    vkUpdateDescriptorSets(state.device.handle, kWindowBuffers, writes.data(), 0, nullptr);
}

glm::ivec2 size_of(const Swapchain& swapchain) {
    return {swapchain.extent.width, swapchain.extent.height};
}

// Fills the window with the image, or black, and leaves it as a colour attachment.
void draw_picture(PresenterState& state, VkImage image, const ShownPicture& picture) {
    const glm::ivec2 window = size_of(*state.swapchain);
    record_layout(state.commands, image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    if (picture.executor == nullptr) {
        constexpr VkClearColorValue kBlack{.float32 = {0.0f, 0.0f, 0.0f, 1.0f}};
        constexpr VkImageSubresourceRange kAll{
            .aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .levelCount = 1, .layerCount = 1};
        vkCmdClearColorImage(state.commands, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &kBlack, 1, &kAll);
    } else if (picture.size == window) {
        record_copy(state.commands, picture.executor->buffer(picture.buffer).handle.get(), image, window);
    } else {
        if (state.scaled.size != picture.size)
            state.scaled = create_window_image(state.device, state.format.format, picture.size);
        const VkImage scaled = state.scaled.handle.get();
        record_layout(state.commands, scaled, VK_IMAGE_LAYOUT_UNDEFINED,
                      VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
        record_copy(state.commands, picture.executor->buffer(picture.buffer).handle.get(), scaled,
                    picture.size);
        record_layout(state.commands, scaled, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                      VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
        record_scaled_copy(state.commands, state.scaled, image, window);
    }
    record_layout(state.commands, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                  VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
}

void draw_overlay(const PresenterState& state, const Overlay& overlay) {
    const glm::ivec2 window = size_of(*state.swapchain);
    vkCmdBindPipeline(state.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, state.programs.overlay.get());
    for (const OverlayDraw& draw : overlay.draws) {
        const glm::ivec2 first = glm::clamp(draw.first, glm::ivec2(0), window);
        const glm::ivec2 extent = glm::clamp(draw.end, first, window) - first;
        if (extent.x <= 0 || extent.y <= 0) continue;
        const VkRect2D scissor{{first.x, first.y},
                               {static_cast<std::uint32_t>(extent.x), static_cast<std::uint32_t>(extent.y)}};
        vkCmdSetScissor(state.commands, 0, 1, &scissor);
        vkCmdDraw(state.commands, draw.index_count, 1, draw.first_index, 0);
    }
}

void draw_window(PresenterState& state, std::uint32_t image, const ShownPicture& picture,
                 const Overlay& overlay) {
    draw_picture(state, state.swapchain->images[image], picture);
    const VkExtent2D extent = state.swapchain->extent;
    const VkRenderPassBeginInfo begin{.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
                                      .renderPass = state.pass.get(),
                                      .framebuffer = state.swapchain->framebuffers[image].get(),
                                      .renderArea = {{0, 0}, extent}};
    vkCmdBeginRenderPass(state.commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
    const VkViewport viewport{0.0f, 0.0f, static_cast<float>(extent.width), static_cast<float>(extent.height),
                              0.0f, 1.0f};
    const VkRect2D whole{{0, 0}, extent};
    vkCmdSetViewport(state.commands, 0, 1, &viewport);
    vkCmdSetScissor(state.commands, 0, 1, &whole);
    const VkPipelineLayout layout = state.programs.layout.get();
    vkCmdBindDescriptorSets(state.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 0, 1,
                            &state.programs.set, 0, nullptr);
    const gpu::WindowPush push{.window = glm::vec2(size_of(*state.swapchain)),
                               .font_width = state.font_width};
    vkCmdPushConstants(state.commands, layout, VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                       sizeof push, &push);
    draw_overlay(state, overlay);
    vkCmdEndRenderPass(state.commands);
}

// Recreates the swapchain for the window as it is now; false while the window has no pixels.
bool renew_swapchain(PresenterState& state, glm::ivec2 window) {
    if (!std::exchange(state.is_stale, false) && window == state.window_size)
        return state.swapchain.has_value();
    vk_check(vkDeviceWaitIdle(state.device.handle), "wait for the window");
    state.window_size = window;
    const VkSwapchainKHR old = state.swapchain ? state.swapchain->handle.get() : VK_NULL_HANDLE;
    state.swapchain =
        create_swapchain(state.device, state.surface.get, state.format, state.pass.get(), window, old);
    return state.swapchain.has_value();
}

// The index of the image to draw; nothing when the swapchain is out of date.
std::optional<std::uint32_t> acquire(PresenterState& state) {
    std::uint32_t image = 0;
    const VkResult result = vkAcquireNextImageKHR(state.device.handle, state.swapchain->handle.get(), kNever,
                                                  state.acquired.get(), VK_NULL_HANDLE, &image);
    state.is_stale = result == VK_SUBOPTIMAL_KHR || result == VK_ERROR_OUT_OF_DATE_KHR;
    if (result == VK_ERROR_OUT_OF_DATE_KHR) return std::nullopt;
    if (result != VK_SUBOPTIMAL_KHR) vk_check(result, "acquire an image of the window");
    return image;
}

void submit_and_present(PresenterState& state, std::uint32_t image) {
    const VkSemaphore acquired = state.acquired.get();
    const VkSemaphore rendered = state.swapchain->rendered[image].get();
    const VkPipelineStageFlags stage = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
    const VkSubmitInfo submit{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO,
                              .waitSemaphoreCount = 1,
                              .pWaitSemaphores = &acquired,
                              .pWaitDstStageMask = &stage,
                              .commandBufferCount = 1,
                              .pCommandBuffers = &state.commands,
                              .signalSemaphoreCount = 1,
                              .pSignalSemaphores = &rendered};
    const VkFence fence = state.fence.get();
    vk_check(vkQueueSubmit(state.device.queue, 1, &submit, fence), "draw the window");
    const VkSwapchainKHR swapchain = state.swapchain->handle.get();
    const VkPresentInfoKHR present{.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR,
                                   .waitSemaphoreCount = 1,
                                   .pWaitSemaphores = &rendered,
                                   .swapchainCount = 1,
                                   .pSwapchains = &swapchain,
                                   .pImageIndices = &image};
    const VkResult result = vkQueuePresentKHR(state.device.queue, &present);
    if (result == VK_SUBOPTIMAL_KHR || result == VK_ERROR_OUT_OF_DATE_KHR)
        state.is_stale = true;
    else
        vk_check(result, "present the window");
    vk_check(vkWaitForFences(state.device.handle, 1, &fence, VK_TRUE, kNever), "wait for the window");
    vk_check(vkResetFences(state.device.handle, 1, &fence), "reset the window's fence");
}

}  // namespace

Presenter::Presenter(Device& device, const SurfaceSource& surface, std::span<const EmbeddedShader> shaders) {
    DeviceState& opened = device.state();
    const auto handle = std::bit_cast<VkSurfaceKHR>(surface.create(opened.instance.get()));
    state_ = std::make_unique<PresenterState>(opened, handle, shaders);
    for (std::size_t i = 0; i < kWindowBuffers; ++i)
        state_->fill(static_cast<WindowBuffer>(i), {});
}

bool Presenter::is_bgr() const {
    return state_->format.format == VK_FORMAT_B8G8R8A8_UNORM;
}

Presenter::~Presenter() {
    vkDeviceWaitIdle(state_->device.handle);
}

void Presenter::set_font(std::span<const std::uint8_t> coverage, glm::ivec2 size) {
    state_->font_width = static_cast<std::uint32_t>(size.x);
    state_->fill(WindowBuffer::font, std::as_bytes(coverage));
}

bool Presenter::present(const ShownPicture& picture, const Overlay& overlay, glm::ivec2 window,
                        WindowCapture* capture) {
    PresenterState& state = *state_;
    if (window.x <= 0 || window.y <= 0 || !renew_swapchain(state, window)) return false;
    const std::optional<std::uint32_t> image = acquire(state);
    if (!image) return false;
    state.fill(WindowBuffer::vertices, std::as_bytes(std::span(overlay.vertices)));
    state.fill(WindowBuffer::indices, std::as_bytes(std::span(overlay.indices)));
    bind_buffers(state);
    vk_check(vkResetCommandPool(state.device.handle, state.pool.get(), 0), "reset the window's commands");
    const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                         .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    vk_check(vkBeginCommandBuffer(state.commands, &begin), "begin the window's commands");
    draw_window(state, *image, picture, overlay);
    if (capture != nullptr)
        record_capture(state.device, state.commands, state.swapchain->images[*image],
                       size_of(*state.swapchain), state.captured);
    vk_check(vkEndCommandBuffer(state.commands), "end the window's commands");
    submit_and_present(state, *image);
    if (capture != nullptr) *capture = copy_capture(state.captured, size_of(*state.swapchain), is_bgr());
    return true;
}

}  // namespace voxilux

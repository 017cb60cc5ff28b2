#pragma once

#include <volk.h>

#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace voxilux {

// Where the validation layers' warnings and errors go. Layers may call from any thread.
struct MessageSink {
    std::mutex mutex;
    std::vector<std::string> messages;
    std::function<void(std::string_view)> on_message;
};

// A Vulkan instance, with its messenger when validation is on. The sink must not move.
class Instance {
  public:
    Instance() = default;
    Instance(Instance&& other) noexcept;
    Instance& operator=(Instance&& other) noexcept;
    ~Instance();

    [[nodiscard]] VkInstance get() const { return handle_; }
    [[nodiscard]] bool has_debug_utils() const { return has_debug_utils_; }

  private:
    friend Instance create_instance(bool validation, MessageSink* sink,
                                    std::span<const std::string> more_extensions);

    VkInstance handle_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    bool has_debug_utils_ = false;
};

// Loads the Vulkan loader and creates an instance of version 1.3 (it accepts drivers of 1.2). Throws
// Error(no_device) when there is no loader or driver, when `validation` is set and its layer is missing, or
// when one of `more_extensions` is missing.
[[nodiscard]] Instance create_instance(bool validation, MessageSink* sink,
                                       std::span<const std::string> more_extensions = {});

}  // namespace voxilux

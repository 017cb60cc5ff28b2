#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "plan/device_limits.h"

namespace voxilux {

// One Vulkan device as `voxilux devices` shows it.
struct DeviceInfo {
    std::uint32_t index = 0;  // what --device takes
    std::string name;
    std::string driver;  // name and version
    std::string type;    // cpu, integrated, discrete, virtual or other
    bool usable = false;
    std::vector<std::string> lacks;  // plain sentences; a usable device can lack optional things
    bool would_use = false;          // the one an empty selector picks
    DeviceLimits limits;
};

// A window's side of Vulkan, for a device that presents to it.
struct SurfaceSource {
    std::vector<std::string> instance_extensions;
    // Makes the window's surface (VkSurfaceKHR) of an instance (VkInstance). Throws Error(no_device).
    std::function<std::uint64_t(void* instance)> create;
};

// Which device to open and how.
struct DeviceRequest {
    std::string selector;     // index, or part of the name in any case; empty: the best
    bool validation = false;  // Khronos validation and synchronization validation
    std::function<void(std::string_view)> on_message;  // called for each validation message; may be empty
    const SurfaceSource* surface = nullptr;            // the device is to present to this window
};

struct DeviceState;

// An open device with one compute queue, and its validation messages. Everything made from it must be
// destroyed before it.
class Device {
  public:
    explicit Device(std::unique_ptr<DeviceState> state);
    Device(Device&&) noexcept;
    Device& operator=(Device&&) noexcept;
    ~Device();

    [[nodiscard]] const DeviceInfo& info() const;
    [[nodiscard]] const DeviceLimits& limits() const { return info().limits; }

    // Warnings and errors of the validation layers so far; always empty without validation.
    [[nodiscard]] std::vector<std::string> messages() const;

    // For this room only: the Vulkan handles.
    [[nodiscard]] DeviceState& state() { return *state_; }

  private:
    std::unique_ptr<DeviceState> state_;
};

// Every Vulkan device of the machine, usable or not. Throws Error(no_device) only when there is no Vulkan
// loader.
[[nodiscard]] std::vector<DeviceInfo> list_devices();

// The version of this machine's Vulkan loader, such as "1.3.239"; "none" where there is none.
[[nodiscard]] std::string loader_version();

// The position in `devices` of the one that `selector` names: an index, or the first usable device whose name
// contains it (in any case); an empty selector prefers a real GPU to a CPU. Throws Error(usage) that lists
// the devices when nothing matches, Error(no_device) when there is no usable device or the selected one is
// not usable.
[[nodiscard]] std::size_t pick_device(std::span<const DeviceInfo> devices, std::string_view selector);

// Opens the device of `request`. Throws as pick_device, and Error(no_device) when there is no loader or when
// validation is requested and its layer is not installed.
[[nodiscard]] Device open_device(const DeviceRequest& request);

}  // namespace voxilux

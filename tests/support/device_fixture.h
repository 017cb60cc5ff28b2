#pragma once

#include <span>
#include <string>
#include <vector>

#include "vk/device.h"
#include "vk/executor.h"

namespace voxilux {

// The device that the tests of this process share, with validation and synchronization validation on. It is
// opened at first use; a test binary fails at its end when any validation message was collected. Throws
// Error(no_device), which fails the test, when the machine has none: lavapipe is always there.
[[nodiscard]] Device& test_device();

// An executor on test_device() over the pass and the probe shaders, with poisoned transient buffers.
[[nodiscard]] Executor& test_executor();

// The pass and the probe shaders together.
[[nodiscard]] std::span<const EmbeddedShader> all_shaders();

// Removes the messages collected so far and returns them, for tests that provoke one on purpose.
[[nodiscard]] std::vector<std::string> take_validation_messages();

}  // namespace voxilux

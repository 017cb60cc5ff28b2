#include "support/device_fixture.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <mutex>

// Called by the leak sanitizer. Drivers and layers keep memory to the end of the process and are unloaded
// before the check could attribute it to them. Our own Vulkan objects are checked by the validation layer.
extern "C" int __lsan_is_turned_off() {
    return 1;
}

namespace voxilux {
namespace {

// Messages outlive the device, because its layers report forgotten objects while it ends.
struct Messages {
    std::mutex mutex;
    std::vector<std::string> texts;
};

Messages& messages() {
    static Messages all;
    return all;
}

struct SharedDevice {
    std::unique_ptr<Device> device;
    std::unique_ptr<Executor> executor;
};

SharedDevice& shared() {
    static SharedDevice one;
    return one;
}

// Destroys the device before the process ends, and fails the binary when its layers reported anything.
class ValidationGuard : public testing::Environment {
  public:
    void TearDown() override {
        shared().executor.reset();
        shared().device.reset();
        for (const std::string& text : take_validation_messages())
            ADD_FAILURE() << "validation message: " << text;
    }
};

testing::Environment* const kGuard = testing::AddGlobalTestEnvironment(new ValidationGuard);

}  // namespace

Device& test_device() {
    if (!shared().device) {
        const char* selector = std::getenv("VOXILUX_TEST_DEVICE");
        const auto collect = [](std::string_view text) {
            const std::lock_guard lock(messages().mutex);
            messages().texts.emplace_back(text);
        };
        shared().device = std::make_unique<Device>(open_device(
            {.selector = selector != nullptr ? selector : "", .validation = true, .on_message = collect}));
    }
    return *shared().device;
}

Executor& test_executor() {
    if (!shared().executor)
        shared().executor = std::make_unique<Executor>(test_device(), all_shaders(),
                                                       ExecutorOptions{.poison_transients = true});
    return *shared().executor;
}

std::span<const EmbeddedShader> all_shaders() {
    static const std::vector<EmbeddedShader> shaders = [] {
        std::vector<EmbeddedShader> both(pass_shaders().begin(), pass_shaders().end());
        both.insert(both.end(), probe_shaders().begin(), probe_shaders().end());
        return both;
    }();
    return shaders;
}

std::vector<std::string> take_validation_messages() {
    const std::lock_guard lock(messages().mutex);
    return std::exchange(messages().texts, {});
}

}  // namespace voxilux

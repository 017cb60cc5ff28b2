#include "vk/device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "base/error.h"
#include "support/device_fixture.h"

namespace voxilux {
namespace {

// Sets an environment variable for as long as it lives.
class ScopedVariable {
  public:
    ScopedVariable(const char* name, const char* value) : name_(name) {
        const char* known = std::getenv(name);
        if (known != nullptr) before_ = known;
        had_value_ = known != nullptr;
        ::setenv(name, value, 1);
    }
    ScopedVariable(const ScopedVariable&) = delete;
    ScopedVariable& operator=(const ScopedVariable&) = delete;
    ~ScopedVariable() {
        if (had_value_) {
            ::setenv(name_, before_.c_str(), 1);
        } else {
            ::unsetenv(name_);
        }
    }

  private:
    const char* name_;
    std::string before_;
    bool had_value_ = false;
};

// The text of the Error(no_device) with which opening ends.
std::string no_device_line(const DeviceRequest& request) {
    try {
        (void)open_device(request);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::no_device);
        return error.what();
    }
    ADD_FAILURE() << "a device was opened";
    return "";
}

TEST(Device, machine_without_drivers_is_told_what_to_install) {
    const ScopedVariable old_name("VK_ICD_FILENAMES", "/dev/null");
    const ScopedVariable new_name("VK_DRIVER_FILES", "/dev/null");
    EXPECT_NE(no_device_line({}).find("mesa-vulkan-drivers"), std::string::npos);
    EXPECT_THROW((void)list_devices(), Error);
}

TEST(Device, missing_validation_layer_is_told) {
    const ScopedVariable layers("VK_LAYER_PATH", "/dev/null");
    EXPECT_NE(no_device_line({.validation = true}).find("vulkan-validationlayers"), std::string::npos);
    EXPECT_NO_THROW((void)open_device({}));
}

TEST(Device, list_names_each_device_and_marks_the_one_to_use) {
    const std::vector<DeviceInfo> devices = list_devices();
    ASSERT_FALSE(devices.empty());
    for (std::size_t i = 0; i < devices.size(); ++i) {
        EXPECT_EQ(devices[i].index, i);
        EXPECT_FALSE(devices[i].name.empty());
        EXPECT_FALSE(devices[i].driver.empty());
        EXPECT_EQ(devices[i].limits.is_cpu, devices[i].type == "cpu");
        EXPECT_TRUE(devices[i].usable || !devices[i].lacks.empty());
    }
    EXPECT_EQ(std::ranges::count(devices, true, &DeviceInfo::would_use), 1);
    EXPECT_TRUE(devices[pick_device(devices, "")].would_use);
}

TEST(Device, default_limits_are_those_of_lavapipe) {
    const std::vector<DeviceInfo> devices = list_devices();
    const auto lavapipe = std::ranges::find(devices, "cpu", &DeviceInfo::type);
    if (lavapipe == devices.end()) GTEST_SKIP() << "no software device here";
    const DeviceLimits expected;
    EXPECT_EQ(lavapipe->limits.max_binding_bytes, expected.max_binding_bytes);
    EXPECT_EQ(lavapipe->limits.max_allocation_bytes, expected.max_allocation_bytes);
    EXPECT_EQ(lavapipe->limits.max_groups, expected.max_groups);
    EXPECT_GE(lavapipe->limits.max_push_bytes, expected.max_push_bytes);
    // Depends on the width of the machine's vectors.
    EXPECT_EQ(expected.subgroup_size % lavapipe->limits.subgroup_size, 0u);
}

TEST(Device, unknown_name_is_a_usage_error) {
    try {
        (void)open_device({.selector = "no such device"});
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::usage);
    }
}

TEST(Device, two_devices_can_be_open_at_once) {
    Device other = open_device({.selector = std::to_string(test_device().info().index)});
    EXPECT_EQ(other.info().name, test_device().info().name);
    EXPECT_TRUE(other.messages().empty());
    Executor first(other, all_shaders());
    Executor second(test_device(), all_shaders());
    Recording recording;
    recording.declare({.name = "t.a", .size_bytes = 16});
    recording.clear("t.a", 3);
    recording.readback("t.a");
    EXPECT_EQ(first.run(recording).readbacks, second.run(recording).readbacks);
}

}  // namespace
}  // namespace voxilux

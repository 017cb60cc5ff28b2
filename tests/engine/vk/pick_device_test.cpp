#include <gtest/gtest.h>

#include <vector>

#include "base/error.h"
#include "vk/device.h"
#include "vk/physical.h"

namespace voxilux {
namespace {

DeviceInfo device(std::uint32_t index, const char* name, const char* type, bool usable = true) {
    return {.index = index, .name = name, .type = type, .usable = usable};
}

const std::vector<DeviceInfo> kMany = {
    device(0, "llvmpipe (LLVM 15.0.6, 256 bits)", "cpu"),
    device(1, "Intel(R) UHD Graphics 630", "integrated"),
    device(2, "NVIDIA H100", "discrete"),
    device(3, "Old GPU", "discrete", false),
};

ExitCode code_of(const std::vector<DeviceInfo>& devices, std::string_view selector) {
    try {
        (void)pick_device(devices, selector);
    } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        return error.code();
    }
    return ExitCode::done;
}

TEST(PickDevice, empty_selector_prefers_real_gpus_then_cpu) {
    EXPECT_EQ(pick_device(kMany, ""), 2u);
    EXPECT_EQ(pick_device(std::span(kMany).first(2), ""), 1u);
    EXPECT_EQ(pick_device(std::span(kMany).first(1), ""), 0u);
}

TEST(PickDevice, index_or_part_of_the_name_selects) {
    EXPECT_EQ(pick_device(kMany, "0"), 0u);
    EXPECT_EQ(pick_device(kMany, "LLVMpipe"), 0u);
    EXPECT_EQ(pick_device(kMany, "uhd"), 1u);
}

TEST(PickDevice, unknown_selector_is_usage_and_lists_the_devices) {
    EXPECT_EQ(code_of(kMany, "7"), ExitCode::usage);
    EXPECT_EQ(code_of(kMany, "radeon"), ExitCode::usage);
    try {
        (void)pick_device(kMany, "radeon");
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("1: Intel(R) UHD Graphics 630"), std::string::npos);
    }
}

TEST(PickDevice, no_usable_device_is_no_device) {
    EXPECT_EQ(code_of({}, ""), ExitCode::no_device);
    EXPECT_EQ(code_of({kMany[3]}, ""), ExitCode::no_device);
    EXPECT_EQ(code_of(kMany, "old"), ExitCode::no_device);
}

TEST(PickDevice, refusal_names_what_the_device_lacks) {
    DeviceInfo old = kMany[3];
    old.lacks = {"no buffer device addresses (bufferDeviceAddress): it cannot be used", "no timestamps"};
    for (const char* selector : {"", "old"}) {
        try {
            (void)pick_device(std::span(&old, 1), selector);
            FAIL() << "picked";
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find(old.lacks[0]), std::string::npos) << error.what();
        }
    }
}

TEST(KnownFeatures, each_that_is_missing_is_named_alone) {
    FeatureChain offered;
    for (const Feature& feature : known_features())
        *feature.member(offered) = VK_TRUE;
    EXPECT_TRUE(missing_features(offered, true).empty() && missing_features(offered, false).empty());
    for (const Feature& feature : known_features()) {
        *feature.member(offered) = VK_FALSE;
        EXPECT_EQ(missing_features(offered, feature.is_required), std::vector<std::string>{feature.lack});
        EXPECT_TRUE(missing_features(offered, !feature.is_required).empty());
        *feature.member(offered) = VK_TRUE;
    }
}

}  // namespace
}  // namespace voxilux

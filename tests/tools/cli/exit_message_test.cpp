#include "exit_message.h"

#include <gtest/gtest.h>

#include <new>

#include "vk/check.h"

namespace voxilux {
namespace {

// The end of a command that runs `body`.
template <class Body>
ExitMessage end_of(const Body& body) {
    try {
        body();
    } catch (const std::exception& error) {
        return exit_message_of(error);
    }
    return {ExitCode::done, ""};
}

TEST(ExitMessage, error_keeps_its_code_and_text) {
    for (const ExitCode code :
         {ExitCode::usage, ExitCode::input_refused, ExitCode::no_device, ExitCode::device_lost,
          ExitCode::cannot_write, ExitCode::out_of_memory, ExitCode::temporary}) {
        const ExitMessage message = end_of([&] { throw Error(code, "what is wrong"); });
        EXPECT_EQ(message.code, code);
        EXPECT_EQ(message.text, "what is wrong");
    }
}

TEST(ExitMessage, mistake_of_ours_is_70_and_says_so) {
    const ExitMessage message = end_of([] { VX_ASSERT_EQ(1 + 1, 3); });
    EXPECT_EQ(static_cast<int>(message.code), 70);
    EXPECT_EQ(message.text.find("internal error: 1 + 1 == 3 does not hold: 2 is not 3"), 0u) << message.text;
}

TEST(ExitMessage, exception_of_a_library_is_70_and_says_so) {
    const ExitMessage message = end_of([] { throw std::out_of_range("map::at"); });
    EXPECT_EQ(static_cast<int>(message.code), 70);
    EXPECT_EQ(message.text, "internal error: map::at");
}

TEST(ExitMessage, no_memory_on_the_host_is_74) {
    EXPECT_EQ(static_cast<int>(end_of([] { throw std::bad_alloc(); }).code), 74);
}

TEST(ExitMessage, failed_vulkan_calls_map_to_their_codes) {
    const auto code_of = [](VkResult result) {
        return static_cast<int>(end_of([&] { vk_check(result, "submit 'ao.trace'"); }).code);
    };
    EXPECT_EQ(code_of(VK_SUCCESS), 0);
    EXPECT_EQ(code_of(VK_ERROR_DEVICE_LOST), 71);
    EXPECT_EQ(code_of(VK_ERROR_OUT_OF_DEVICE_MEMORY), 74);
    EXPECT_EQ(code_of(VK_ERROR_OUT_OF_HOST_MEMORY), 74);
    EXPECT_EQ(code_of(VK_ERROR_INCOMPATIBLE_DRIVER), 69);
    EXPECT_EQ(code_of(VK_ERROR_INITIALIZATION_FAILED), 69);
    EXPECT_EQ(code_of(VK_ERROR_UNKNOWN), 69);
    EXPECT_EQ(code_of(VK_ERROR_FORMAT_NOT_SUPPORTED), 70);
}

TEST(ExitMessage, lost_device_is_named_with_what_it_was_doing) {
    const ExitMessage message = end_of([] { vk_check(VK_ERROR_DEVICE_LOST, "submit 'ao.trace'"); });
    EXPECT_NE(message.text.find("the device was lost: cannot submit 'ao.trace'"), std::string::npos)
        << message.text;
}

}  // namespace
}  // namespace voxilux

// The validation layers check every test that runs a shader. Here they must report an error.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "base/error.h"
#include "support/device_fixture.h"
#include "vk/command_stream.h"

namespace voxilux {
namespace {

bool any_contains(const std::vector<std::string>& messages, std::string_view part) {
    return std::ranges::any_of(messages,
                               [&](const std::string& text) { return text.find(part) != text.npos; });
}

TEST(Validation, misuse_is_collected) {
    const std::size_t before = test_device().messages().size();
    Recording recording;
    recording.declare({.name = "t.groups", .size_bytes = 32});
    recording.declare({.name = "t.counts", .size_bytes = 4});
    recording.clear("t.groups");
    const std::uint64_t misaligned = 2;
    recording.dispatch_indirect({.label = "t.count",
                                 .shader = "count_invocations",
                                 .bindings = {{"Counts", "t.counts"}},
                                 .push = to_bytes(1u)},
                                "t.groups", misaligned);
    test_executor().run(recording);
    EXPECT_TRUE(any_contains(take_validation_messages(), "VUID-vkCmdDispatchIndirect-offset-02710"));
    EXPECT_GT(test_device().messages().size(), before);
}

TEST(Validation, missing_barrier_is_collected) {
    DeviceState& state = test_device().state();
    const Buffer buffer = create_buffer(state, "t.raced", 64);
    CommandStream stream(state, 4096);
    std::array<std::byte, 64> bytes{};
    stream.begin(128);
    stream.upload(buffer, 0, bytes);
    stream.readback(buffer, 0, bytes);
    stream.finish();
    EXPECT_TRUE(any_contains(take_validation_messages(), "SYNC-HAZARD-READ"));
}

}  // namespace
}  // namespace voxilux

#include "record/recording.h"

#include <gtest/gtest.h>

namespace voxilux {
namespace {

TEST(Recording, describe_lists_buffers_and_commands_in_order) {
    Recording recording;
    recording.declare({.name = "a", .size_bytes = 8});
    recording.declare({.name = "b", .size_bytes = 16, .persistent = true});
    recording.upload("a", to_bytes(std::uint64_t{7}));
    recording.clear("b", 3);
    recording.dispatch({.label = "x.step",
                        .shader = "x_step",
                        .extent = {4, 2, 1},
                        .bindings = {{"In", "a"}, {"Out", "b"}},
                        .constants = {{"mode", 1}}});
    recording.readback("b");
    EXPECT_EQ(describe(recording),
              "buffer   a 8 bytes\n"
              "buffer   b 16 bytes persistent\n"
              "upload   a 8 bytes at 0\n"
              "clear    b to 3\n"
              "dispatch 4x2x1 x.step [x_step] mode=1 In<-a Out<-b\n"
              "readback b 16 bytes at 0\n");
}

TEST(Recording, describe_lists_buffers_given_by_address) {
    Recording recording;
    recording.declare({.name = "a", .size_bytes = 8});
    recording.declare({.name = "groups", .size_bytes = 12});
    const Dispatch dispatch{.label = "x.step",
                            .shader = "x_step",
                            .extent = {4, 1, 1},
                            .bindings = {{"In", "a"}},
                            .addresses = {{"words", "a"}}};
    recording.dispatch(dispatch);
    recording.dispatch_indirect(dispatch, "groups");
    EXPECT_EQ(describe(recording),
              "buffer   a 8 bytes\n"
              "buffer   groups 12 bytes\n"
              "dispatch 4x1x1 x.step [x_step] In<-a words<-&a\n"
              "dispatch from groups+0 x.step [x_step] In<-a words<-&a\n");
}

TEST(Recording, undeclared_buffer_is_refused) {
    Recording recording;
    recording.declare({.name = "groups", .size_bytes = 12});
    EXPECT_THROW(recording.clear("absent"), InternalError);
    EXPECT_THROW(recording.dispatch({.label = "x", .shader = "x", .bindings = {{"In", "absent"}}}),
                 InternalError);
    const Dispatch by_address{.label = "x", .shader = "x", .addresses = {{"words", "absent"}}};
    EXPECT_THROW(recording.dispatch(by_address), InternalError);
    EXPECT_THROW(recording.dispatch_indirect(by_address, "groups"), InternalError);
}

TEST(Recording, one_name_with_two_sizes_is_refused) {
    Recording recording;
    recording.declare({.name = "a", .size_bytes = 8});
    recording.declare({.name = "a", .size_bytes = 8});
    EXPECT_EQ(recording.buffers().size(), 1u);
    EXPECT_THROW(recording.declare({.name = "a", .size_bytes = 4}), InternalError);
}

TEST(Recording, upload_past_the_end_is_refused) {
    Recording recording;
    recording.declare({.name = "a", .size_bytes = 8});
    EXPECT_THROW(recording.upload("a", to_bytes(std::uint64_t{7}), 4), InternalError);
}

TEST(Recording, empty_extent_records_nothing) {
    Recording recording;
    recording.dispatch({.label = "x", .shader = "x", .extent = {0, 1, 1}});
    EXPECT_TRUE(recording.commands().empty());
}

}  // namespace
}  // namespace voxilux

#include "jobs/frame_range.h"

#include <gtest/gtest.h>

namespace voxilux {
namespace {

using Clock = std::chrono::steady_clock;

FrameRangeJob four_frames(std::optional<double> limit_s, double elapsed_s) {
    return {.frames = {.first = 1, .last = 7, .step = 2, .is_sequence = true},
            .time_limit_s = limit_s,
            .started = Clock::now() -
                       std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(elapsed_s))};
}

TEST(FrameRange, frames_to_come_share_the_time_that_is_left) {
    EXPECT_NEAR(time_limit_of_frame(four_frames(100.0, 20.0), 0).value(), 20.0, 1.0);
    EXPECT_NEAR(time_limit_of_frame(four_frames(100.0, 20.0), 3).value(), 80.0, 1.0);
    EXPECT_EQ(time_limit_of_frame(four_frames(100.0, 200.0), 3), 0.0);
    EXPECT_FALSE(time_limit_of_frame(four_frames(std::nullopt, 20.0), 0));
}

TEST(FrameRange, frame_begins_only_with_time_for_a_sample) {
    EXPECT_TRUE(fits_in_time(four_frames(100.0, 50.0), 1, 80.0, 2));
    EXPECT_FALSE(fits_in_time(four_frames(100.0, 70.0), 1, 80.0, 2));
    EXPECT_TRUE(fits_in_time(four_frames(100.0, 200.0), 0, 0.0, 0)) << "one frame is better than none";
    EXPECT_TRUE(fits_in_time(four_frames(std::nullopt, 200.0), 1, 80.0, 2));
}

TEST(FrameRange, progress_counts_frames_and_adds_those_to_come) {
    std::optional<Progress> shown;
    const auto show = [&](const Progress& progress) { shown = progress; };
    progress_of_range(four_frames(std::nullopt, 30.0), 1, show)({.done = 0.5, .remaining_s = 10.0});
    ASSERT_TRUE(shown);
    EXPECT_EQ(shown->frame, 2u);
    EXPECT_EQ(shown->frames, 4u);
    EXPECT_DOUBLE_EQ(shown->done, 1.5 / 4.0);
    EXPECT_NEAR(shown->elapsed_s, 30.0, 1.0);
    EXPECT_NEAR(shown->remaining_s, 10.0 + 2.0 * 20.0, 2.0);
    EXPECT_LT(shown->remaining_low_s, shown->remaining_high_s);
    EXPECT_FALSE(progress_of_range(four_frames(std::nullopt, 30.0), 1, {}));
}

}  // namespace
}  // namespace voxilux

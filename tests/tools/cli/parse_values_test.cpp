#include "parse_values.h"

#include <gtest/gtest.h>

#include <limits>

#include "base/error.h"
#include "jobs/frame_list.h"
#include "progress_line.h"

namespace voxilux {
namespace {

// The usage error of `parse`, or "accepted".
template <class Parse>
std::string refusal(const Parse& parse) {
    try {
        parse();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::usage);
        return error.what();
    }
    return "accepted";
}

TEST(ParseExposure, takes_stops_of_either_sign_and_auto) {
    EXPECT_EQ(parse_exposure("-1"), -1.0f);
    EXPECT_EQ(parse_exposure("0.5"), 0.5f);
    EXPECT_EQ(parse_exposure("auto"), std::nullopt);
    for (const char* text : {"", "1x", "nan", "inf", "1e99"})
        EXPECT_NE(refusal([&] { (void)parse_exposure(text); }), "accepted") << text;
}

TEST(ParseSize, two_numbers_give_a_size) {
    EXPECT_EQ(parse_size("--size", "640x360"), glm::ivec2(640, 360));
    EXPECT_EQ(parse_size("--size", "1x1"), glm::ivec2(1, 1));
    EXPECT_EQ(parse_size("--size", "2147483647x2"), glm::ivec2(2147483647, 2));
}

TEST(ParseSize, anything_else_is_refused_with_its_flag) {
    for (const char* text :
         {"", "x", "640", "640x", "x360", "640 x 360", "640X360", "640x360x1", "640x360 ", " 640x360",
          "0x360", "640x0", "-1x3", "1x-3", "+1x3", "1.5x3", "2147483648x1", "99999999999999999999x1"})
        EXPECT_EQ(refusal([&] { (void)parse_size("--size", text); }),
                  fmt::format("--size: '{}' is not WIDTHxHEIGHT in pixels, such as 1280x720", text));
    EXPECT_EQ(refusal([] { (void)parse_size("--group-size", "8"); }).find("--group-size: '8'"), 0u);
}

TEST(ParseWindow, four_numbers_give_a_window) {
    EXPECT_EQ(parse_window("--crop", "1,2,30,40"), (PixelWindow{{1, 2}, {30, 40}}));
    EXPECT_EQ(parse_window("--crop", "-1,0,-3,4"), (PixelWindow{{-1, 0}, {-3, 4}}))
        << "the plan judges the values";
    for (const char* text : {"", "1", "1,2,3", "1,2,3,", "1,2,3,4,", "1,2,3,4,5", "1, 2,3,4", "1.5,2,3,4",
                             "a,b,c,d", "1;2;3;4", "99999999999,2,3,4"})
        EXPECT_EQ(refusal([&] { (void)parse_window("--crop", text); }),
                  fmt::format("--crop: '{}' is not X0,Y0,X1,Y1 in pixels", text));
}

TEST(ParseDuration, units_add_up) {
    EXPECT_EQ(parse_duration("90s"), 90.0);
    EXPECT_EQ(parse_duration("90"), 90.0);
    EXPECT_EQ(parse_duration("0"), 0.0);
    EXPECT_EQ(parse_duration("2m"), 120.0);
    EXPECT_EQ(parse_duration("1.5h"), 5400.0);
    EXPECT_EQ(parse_duration("1h30m"), 5400.0);
    EXPECT_EQ(parse_duration("1h2m3s"), 3723.0);
    EXPECT_EQ(parse_duration("0.25s"), 0.25);
}

TEST(ParseDuration, anything_else_is_refused) {
    for (const char* text :
         {"", "s", "h", "-5", "-5s", "5x", "5 s", "1h30", "5ms", "nan", "inf", "1e400", "5s ", "soon"})
        EXPECT_EQ(refusal([&] { (void)parse_duration(text); }),
                  fmt::format("--time-limit: '{}' is not a time such as 90s, 2m or 1h30m", text));
}

TEST(ParseFrames, range_has_a_step_of_one_unless_it_says) {
    EXPECT_EQ(parse_frames("1-120"), (FrameList{.first = 1, .last = 120, .is_sequence = true}));
    EXPECT_EQ(parse_frames("0-10x3"), (FrameList{.first = 0, .last = 10, .step = 3, .is_sequence = true}));
    EXPECT_EQ(parse_frames("7"), (FrameList{.first = 7, .last = 7, .is_sequence = true}));
    EXPECT_EQ(parse_frames("5-5x9"), (FrameList{.first = 5, .last = 5, .step = 9, .is_sequence = true}));
    EXPECT_EQ(parse_frames("0-10x3").count(), 4);
    EXPECT_EQ(parse_frames("0-10x3").at(3), 9);
    EXPECT_EQ(parse_frames("0-9x3").count(), 4);
    EXPECT_EQ(parse_frames("0-1000000").count(), 1000001);
}

TEST(ParseFrames, anything_else_is_refused) {
    for (const char* text : {"", "-", "1-", "-3", "-1-3", "1--3", "1-3x", "1-3x-1", "x2", "1x2x3", "1-2-3",
                             "1 - 3", "1,3", "a-b", "1-3X2", "1.5-3", "+1-3", "99999999999999999999-3"})
        EXPECT_EQ(refusal([&] { (void)parse_frames(text); }),
                  fmt::format("--frames: '{}' is not FIRST-LAST or FIRST-LASTxSTEP, such as 1-120 or 1-120x5",
                              text));
    for (const char* text : {"3-1", "1-3x0", "1-1000001"})
        EXPECT_EQ(
            refusal([&] { (void)parse_frames(text); }),
            fmt::format("--frames: '{}' must go upwards, by a step of 1 or more, to 1000000 at most", text));
}

TEST(NumberedFile, number_goes_before_the_ending) {
    EXPECT_EQ(numbered("a.exr", 7, 24), "a.0007.exr");
    EXPECT_EQ(numbered("x/y.z/a.b.png", 0, 0), "x/y.z/a.b.0000.png");
    EXPECT_EQ(numbered("a.PNG", 7, 123456), "a.000007.PNG");
    EXPECT_EQ(numbered("/a.exr", 12345, 12345), "/a.12345.exr");
}

TEST(ParseErrorTarget, percent_and_share_mean_the_same) {
    EXPECT_DOUBLE_EQ(parse_error_target("1%"), 0.01);
    EXPECT_DOUBLE_EQ(parse_error_target("0.01"), 0.01);
    EXPECT_DOUBLE_EQ(parse_error_target("0.5%"), 0.005);
    EXPECT_DOUBLE_EQ(parse_error_target("1e-3"), 0.001);
    EXPECT_DOUBLE_EQ(parse_error_target("250%"), 2.5);
}

TEST(ParseErrorTarget, anything_else_is_refused) {
    for (const char* text : {"", "%", "0", "0%", "-1%", "1 %", "1%%", "1p", "nan", "inf", "one"})
        EXPECT_EQ(refusal([&] { (void)parse_error_target(text); }),
                  fmt::format("--error: '{}' is not a share above 0, such as 1% or 0.01", text));
}

TEST(ParseNames, every_name_is_taken_and_a_slip_gets_the_nearest) {
    EXPECT_EQ(parse_sequence("sobol"), Sequence::sobol);
    EXPECT_EQ(parse_sequence("halton"), Sequence::halton);
    EXPECT_EQ(parse_sequence("white"), Sequence::white);
    EXPECT_EQ(parse_view("three-quarter"), View::three_quarter);
    EXPECT_EQ(parse_view("front"), View::front);
    EXPECT_EQ(parse_view("back"), View::back);
    EXPECT_EQ(parse_view("left"), View::left);
    EXPECT_EQ(parse_view("right"), View::right);
    EXPECT_EQ(parse_view("top"), View::top);
    EXPECT_EQ(parse_view("iso"), View::iso);
    EXPECT_EQ(refusal([] { (void)parse_sequence("hamilton"); }),
              "--sequence: there is no 'hamilton'; did you mean 'halton'?");
    EXPECT_EQ(refusal([] { (void)parse_view("3"); }),
              "--camera: there is no '3'; known: 'three-quarter', 'front', 'back', 'left', 'right', 'top', "
              "'bottom', 'iso'");
}

TEST(ParseEffectSwitch, name_and_state_are_both_needed) {
    EXPECT_EQ(parse_effect_switch("ao=off").effect, Effect::ao);
    EXPECT_EQ(parse_effect_switch("ao=off").choice, Switch::off);
    EXPECT_EQ(parse_effect_switch("sun=on").choice, Switch::on);
    EXPECT_EQ(parse_effect_switch("sky=auto").choice, Switch::automatic);
    for (const char* text : {"ao", "ao=", "ao=yes", "ao=on ", "ao=ON"})
        EXPECT_EQ(refusal([&] { (void)parse_effect_switch(text); }),
                  fmt::format("--effect: '{}' must be NAME=on, NAME=off or NAME=auto", text));
    EXPECT_EQ(refusal([] { (void)parse_effect_switch("=on"); }).find("--effect: there is no effect ''"), 0u);
}

TEST(ProgressText, numbers_read_as_people_write_them) {
    EXPECT_EQ(progress_text({.done = 0.42,
                             .elapsed_s = 12.3,
                             .remaining_low_s = 15.1,
                             .remaining_high_s = 19.4,
                             .sample = 7,
                             .error = 0.021,
                             .error_at_end = 0.01}),
              " 42.0 %  sample 7  12 s, 15 to 19 s left  error 2.1 %, 1 % at the end");
    EXPECT_EQ(progress_text({.done = 0.001,
                             .elapsed_s = 100.0,
                             .remaining_low_s = 80000.0,
                             .remaining_high_s = 99900.0,
                             .sample = 1}),
              "  0.1 %  sample 1  1 min 40 s, 22 to 28 h left");
    EXPECT_EQ(progress_text(
                  {.done = 0.0, .remaining_high_s = std::numeric_limits<double>::infinity(), .sample = 1}),
              "  0.0 %  sample 1  0 s, ? left");
}

TEST(ProgressText, frame_range_counts_frames) {
    EXPECT_EQ(progress_text({.done = 0.42,
                             .elapsed_s = 12.3,
                             .remaining_low_s = 17.0,
                             .remaining_high_s = 17.0,
                             .sample = 7,
                             .frame = 3,
                             .frames = 12}),
              "frame 3 of 12 42.0 %  sample 7  12 s, 17 s left");
    EXPECT_EQ(progress_json({.done = 0.5, .sample = 2, .frame = 3, .frames = 12}),
              R"({"done":0.5,"sample":2,"elapsed_s":0.0,"remaining_s":0.0,"remaining_low_s":0.0,)"
              R"("remaining_high_s":0.0,"frame":3,"frames":12})");
}

TEST(ProgressText, json_is_one_line_with_its_keys) {
    EXPECT_EQ(progress_json({.done = 0.5,
                             .elapsed_s = 1.5,
                             .remaining_s = 1.5,
                             .remaining_low_s = 1.25,
                             .remaining_high_s = 2.0,
                             .sample = 2}),
              R"({"done":0.5,"sample":2,"elapsed_s":1.5,"remaining_s":1.5,"remaining_low_s":1.25,)"
              R"("remaining_high_s":2.0})");
    EXPECT_EQ(progress_json({.done = 0.5, .sample = 2, .error = 0.25, .error_at_end = 0.125}),
              R"({"done":0.5,"sample":2,"elapsed_s":0.0,"remaining_s":0.0,"remaining_low_s":0.0,)"
              R"("remaining_high_s":0.0,"error":0.25,"error_at_end":0.125})");
}

}  // namespace
}  // namespace voxilux

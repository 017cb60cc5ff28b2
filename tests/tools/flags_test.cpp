// How subcommands declare flags: what is stored, in which order, and what is refused.

#include "flags.h"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>

#include "base/error.h"
#include "parse_values.h"
#include "scene_options.h"

namespace voxilux {
namespace {

// A command with flags, parsed from one line of words.
class FlagsTest : public testing::Test {
  protected:
    FlagsTest() { app_.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast); }

    void parse(const std::string& words) { app_.parse(words); }

    CLI::App app_{"", "test"};
    Flags flags_{app_};
};

TEST_F(FlagsTest, value_is_stored_and_the_last_one_wins) {
    int number = 1;
    std::optional<double> share;
    bool is_on = false;
    flags_.add("--number", "N", number, "");
    flags_.add("--share", "S", share, "");
    flags_.add_switch("-s,--switch", is_on, "");
    parse("--number 2 --number=3 -s");
    EXPECT_EQ(number, 3);
    EXPECT_FALSE(share);
    EXPECT_TRUE(is_on);
    EXPECT_THROW(parse("--number many"), CLI::ParseError);
}

TEST_F(FlagsTest, given_flags_are_words_of_another_command_line) {
    int number = 1;
    std::string input;
    std::vector<std::string> items;
    bool is_on = false;
    bool is_off = false;
    flags_.add("INPUT", "", input, "");
    flags_.add("-n,--number", "N", number, "");
    flags_.add("-D", "ITEM", items, "");
    flags_.add_switch("--switch", is_on, "");
    flags_.add_switch("--other", is_off, "");
    flags_.on_switch(
        "--call", [] {}, "");
    const auto given = flags_.given();
    parse("file --switch -D a=1 --number 2 -D b --number 3 --call");
    EXPECT_EQ(given(), (Flags::GivenWords{
                           {"--number", "3"}, {"-D", "a=1"}, {"-D", "b"}, {"--switch", ""}, {"--call", ""}}));
}

TEST_F(FlagsTest, parser_gets_the_name_of_the_flag_and_its_error_passes_through) {
    glm::ivec2 size{1, 1};
    flags_.add_parsed("--group-size", "WxH", size, parse_size, "");
    parse("--group-size 4x2");
    EXPECT_EQ(size, glm::ivec2(4, 2));
    try {
        parse("--group-size 8");
        FAIL() << "accepted";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::usage);
        EXPECT_EQ(std::string(error.what()).find("--group-size: '8' is not WIDTHxHEIGHT"), 0u);
    }
}

TEST_F(FlagsTest, list_has_each_value_once_in_place_of_the_default) {
    std::vector<Sequence> sequences{Sequence::white};
    flags_.add_list("--sequence", "NAME,...", sequences, parse_sequence, "");
    parse("");
    EXPECT_EQ(sequences, std::vector{Sequence::white});
    parse("--sequence sobol,halton --sequence sobol");
    EXPECT_EQ(sequences, (std::vector{Sequence::sobol, Sequence::halton}));
    EXPECT_THROW(parse("--sequence sobol,hamilton"), Error);
}

TEST_F(FlagsTest, list_of_files_keeps_repeats_and_ends_where_the_next_argument_begins) {
    std::vector<std::string> outputs;
    std::string input;
    flags_.add("INPUT", "", input, "").required();
    flags_.add("-o", "FILE", outputs, "");
    parse("-o a,b.exr scene.vox -o c.png");
    EXPECT_EQ(outputs, (std::vector<std::string>{"a,b.exr", "c.png"}));
    EXPECT_EQ(input, "scene.vox");
    EXPECT_THROW(parse("-o a.exr"), CLI::ParseError);
}

TEST_F(FlagsTest, flags_that_exclude_each_other_and_negative_numbers_are_refused) {
    std::optional<std::int64_t> frame;
    std::optional<int> other;
    flags_.add("--frame", "N", frame, "").from_zero();
    flags_.add("--other", "N", other, "").excludes("--frame");
    EXPECT_THROW(parse("--frame 1 --other 2"), CLI::ParseError);
    EXPECT_THROW(parse("--frame -1"), CLI::ParseError);
    parse("--frame 7");
    EXPECT_EQ(frame, 7);
}

TEST_F(FlagsTest, scene_flags_are_values_after_parsing) {
    SceneOptions options;
    add_scene_flags(flags_, options);
    parse(
        "a.vox --size 8x4 --iterations 3 --radius auto --alpha 0.5 --crop 1,2,3,4 --effect ao=off "
        "--effect sun=on --frames 1-9x2 --ao hash --sequence white --seed 5 --quality fine");
    RenderSettings settings;
    settings.photons.radius = 7.0;
    for (const auto& change : options.changes)
        change(settings);
    EXPECT_EQ(settings.size, glm::ivec2(8, 4));
    EXPECT_EQ(settings.photons.radius, std::nullopt);
    EXPECT_EQ(settings.photons.alpha, 0.5);
    EXPECT_EQ(settings.ao.method, AoMethod::hash);
    EXPECT_EQ(settings.sequence, Sequence::white);
    EXPECT_EQ(settings.seed, 5u);
    EXPECT_EQ(settings.ao_rays, RenderSettings{}.ao_rays);
    EXPECT_EQ(options.spp, 3u);
    EXPECT_EQ(options.request.crop, (PixelWindow{{1, 2}, {3, 4}}));
    EXPECT_EQ(options.request.effects.switches,
              (std::map<Effect, Switch>{{Effect::ao, Switch::off}, {Effect::sun, Switch::on}}));
    EXPECT_EQ(options.frames, (FrameList{.first = 1, .last = 9, .step = 2, .is_sequence = true}));
    ASSERT_NE(options.quality, nullptr);
    EXPECT_EQ(options.quality->name, "fine");
}

TEST_F(FlagsTest, flag_that_was_not_given_changes_nothing) {
    SceneOptions options;
    add_scene_flags(flags_, options);
    parse("a.vox");
    EXPECT_TRUE(options.changes.empty());
    EXPECT_FALSE(options.spp || options.frames || options.request.crop || options.request.traversal);
}

}  // namespace
}  // namespace voxilux

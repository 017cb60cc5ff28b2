// Forecasts and stop rules as users meet them.

#include <gtest/gtest.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "formats/exr.h"
#include "support/scratch_folder.h"
#include "tools/cli/child_process.h"
#include "tools/cli/words.h"

namespace voxilux::test {
namespace {

// Relative tolerance of the memory forecast: enough for a user who plans memory.
constexpr double kMemoryTolerance = 0.1;
// From the time limit to the end of the process.
constexpr double kLateness_s = 2.0;

Json forecast_of(const Words& words, const Surroundings& surroundings = {}) {
    const Ending ending = run(with(words, {"--json", "-"}), surroundings);
    EXPECT_EQ(ending.code, 0) << ending.err;
    return Json::parse(ending.out);
}

TEST(PlanForecast, says_what_render_then_takes) {
    const ScratchFolder scratch;
    const Words flags = {scene_file("mixed"), "--size", "64x36", "--error", "5%", "-o", scratch / "a.png"};
    const Json plan = forecast_of(with({"plan"}, flags));
    const Json report = forecast_of(with({"render"}, flags));
    EXPECT_EQ(plan["forecast"]["samples"], report["forecast"]["samples"]);
    EXPECT_EQ(plan["forecast"]["error"], 0.05);
    EXPECT_LT(plan["forecast"]["low_s"], plan["forecast"]["high_s"]);
    EXPECT_GE(report["samples"], plan["forecast"]["samples"]);
    EXPECT_LE(report["samples"], plan["forecast"]["samples_high"]);
    EXPECT_LE(report["error"]["high"], 0.05);
    EXPECT_GE(report["error"]["rounds"], 1);
    EXPECT_EQ(report["forecast"]["outcome"]["wall_s"], report["wall_s"]);
    ASSERT_EQ(plan["forecasts"].size(), 3u);
    EXPECT_EQ(plan["forecasts"][1]["error"], 0.025);
    EXPECT_GT(plan["forecasts"][1]["samples"], plan["forecast"]["samples"]);
}

TEST(PlanForecast, text_has_a_table_and_memory) {
    const Ending ending = run({"plan", scene_file("mixed"), "--size", "64x36", "--error", "5%"});
    EXPECT_EQ(ending.code, 0) << ending.err;
    for (const char* line :
         {"forecast  5 % ", "forecast  2.5 % ", "forecast  10 % ", "of the process at most"})
        EXPECT_NE(ending.out.find(line), std::string::npos) << ending.out;
}

TEST(PlanForecast, too_few_samples_allowed_are_said) {
    const Ending ending =
        run({"plan", scene_file("mixed"), "--size", "64x36", "--error", "0.1%", "--spp", "16"});
    EXPECT_NE(ending.out.find("out of reach: it needs more than the 16 samples allowed"), std::string::npos)
        << ending.out;
}

TEST(PlanForecastNightly, effect_that_the_user_switched_off_has_its_error) {
    const Words words = {"plan", scene_file("mixed"), "--size", "32x18", "--error", "20%"};
    for (const Json& effect : forecast_of(with(words, {"--effect", "sun=off"}))["effects"]) {
        EXPECT_EQ(effect.contains("error_without"), effect["name"] == "sun") << effect;
        if (effect["name"] == "sun") {
            EXPECT_GT(effect["error_without"]["low"], 0.1);
        }
    }
    EXPECT_NE(run(with(words, {"--effect", "sun=off"})).out.find("without   sun "), std::string::npos);
    EXPECT_EQ(run(words).out.find("without   "), std::string::npos);
}

TEST(PlanForecast, nothing_to_plan_is_a_usage_error) {
    const Ending ending = run({"plan"});
    EXPECT_EQ(ending.code, 2);
    EXPECT_NE(ending.err.find("INPUT is required"), std::string::npos) << ending.err;
}

class PlanMemory : public testing::TestWithParam<Words> {};

TEST_P(PlanMemory, is_that_of_the_render) {
    const ScratchFolder scratch;
    Words flags = with({scene_file("mixed"), "--error", "40%"}, GetParam());
    for (std::string& word : flags)
        if (word.starts_with("a.")) word = scratch / word;
    const double planned = forecast_of(with({"plan"}, flags))["memory_total"]["peak_rss_mib"];
    const Json report = forecast_of(with({"render"}, flags));
    EXPECT_NEAR(planned / report["peak_rss_mib"].get<double>(), 1.0, kMemoryTolerance);
}

INSTANTIATE_TEST_SUITE_P(
    outputs, PlanMemory,
    testing::Values(Words{"--size", "640x360", "-o", "a.png"}, Words{"--size", "640x360", "-o", "a.exr"},
                    Words{"--size", "640x360", "-o", "a.exr", "-o", "a.png", "--checkpoint", "0"},
                    Words{"--size", "160x90", "-o", "a.png"}));

TEST(PlanHistory, remembers_renders_that_had_a_forecast) {
    const ScratchFolder scratch;
    const Surroundings here{.environment = {{"XDG_STATE_HOME", scratch / "state"}}};
    const Words render = {"render", scene_file("mixed"), "--size", "32x18", "-q", "-o", scratch / "a.png"};
    EXPECT_EQ(forecast_of({"plan", "--history"}, here)["count"], 0);
    EXPECT_EQ(run(with(render, {"--error", "20%"}), here).code, 0);
    EXPECT_EQ(run(with(render, {"--spp", "2"}), here).code, 0);  // had no error target
    const Json history = forecast_of({"plan", "--history"}, here);
    EXPECT_EQ(history["count"], 1);
    ASSERT_EQ(history["renders"].size(), 1u);
    const Json& past = history["renders"][0];
    EXPECT_EQ(past["scene"], "mixed.toml");
    EXPECT_EQ(past["size"], Json({32, 18}));
    EXPECT_EQ(past["forecast"]["error"], 0.2);
    EXPECT_GT(past["forecast"]["outcome"]["wall_s"], 0.0);
    EXPECT_NE(run({"plan", "--history"}, here).out.find("mixed.toml"), std::string::npos);
}

TEST(PlanHistory, home_that_cannot_be_written_is_no_error) {
    const ScratchFolder scratch;
    const Surroundings nowhere{.environment = {{"XDG_STATE_HOME", "/dev/null/state"}}};
    const Ending ending =
        run({"render", scene_file("mixed"), "--size", "32x18", "--error", "20%", "-o", scratch / "a.png"},
            nowhere);
    EXPECT_EQ(ending.code, 0);
    EXPECT_EQ(ending.err, "");
    EXPECT_EQ(forecast_of({"plan", "--history"}, nowhere)["count"], 0);
}

TEST(ErrorFlag, render_that_goes_on_gives_the_picture_of_one_that_did_not_stop) {
    const ScratchFolder scratch;
    const auto render = [&](const std::string& file, const Words& more) {
        return run(with(
            {"render", scene_file("mixed"), "--size", "64x36", "--reproducible", "-q", "-o", scratch / file},
            more));
    };
    EXPECT_EQ(render("a.exr", {"--spp", "100000", "--time-limit", "0.5s"}).code, 0);
    const std::string target = "3%";
    const Ending rest = render("a.exr", {"--error", target, "--resume"});
    EXPECT_EQ(rest.code, 0) << rest.err;
    const Json report = Json::parse(read_exr(scratch / "a.exr").attributes.at("voxilux.report"));
    EXPECT_LE(report["error"]["high"], 0.03);
    const std::string samples = std::to_string(report["samples"].get<int>());
    EXPECT_EQ(render("b.exr", {"--spp", samples}).code, 0);
    EXPECT_EQ(read_exr(scratch / "a.exr").channels.at("R").pixels,
              read_exr(scratch / "b.exr").channels.at("R").pixels);
}

// Seconds that a render with a time limit takes, from its start to the end of its process. Fails where its
// pictures are not whole.
double limited_seconds(const std::string& limit, const Words& more) {
    const ScratchFolder scratch;
    const auto start = std::chrono::steady_clock::now();
    const Ending ending = run(with({"render", scene_file("mixed"), "--spp", "1000000", "--time-limit", limit,
                                    "-q", "-o", scratch / "a.exr", "-o", scratch / "a.png"},
                                   more));
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    EXPECT_EQ(ending.code, 0) << ending.err;
    EXPECT_EQ(names_in(scratch.path()), (Words{"a.exr", "a.exr.part", "a.png"}));
    const Image image = read_exr(scratch / "a.exr");
    for (const float samples : image.channels.at("sampleCount.Y").pixels)
        EXPECT_GE(samples, 1.0f);
    return seconds;
}

TEST(TimeLimit, files_are_written_in_time) {
    EXPECT_LE(limited_seconds("4s", {"--size", "640x360"}), 4.0 + kLateness_s);
}

TEST(TimeLimitNightly, twenty_seconds_of_a_large_picture_end_in_time) {
    const double seconds = limited_seconds("20s", {"--size", "1920x1080"});
    EXPECT_LE(seconds, 20.0 + kLateness_s);
    EXPECT_GE(seconds, 14.0);  // the time is used
}

}  // namespace
}  // namespace voxilux::test

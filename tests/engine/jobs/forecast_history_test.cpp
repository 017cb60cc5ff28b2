#include "jobs/forecast_history.h"

#include <gtest/gtest.h>

#include <fstream>
#include <thread>

#include "support/scratch_folder.h"

namespace voxilux {
namespace {

using Json = nlohmann::ordered_json;

Json entry(double low, double high, double expected, double wall,
           const char* stopped = "error target reached") {
    return {{"time", "2030-01-02T03:04:05Z"},
            {"scene", "a.toml"},
            {"stopped", stopped},
            {"forecast",
             {{"low_s", low},
              {"high_s", high},
              {"expected_s", expected},
              {"error", 0.01},
              {"outcome", {{"wall_s", wall}}}}}};
}

TEST(ForecastHistory, what_is_appended_is_read_in_order) {
    const ScratchFolder scratch;
    const std::filesystem::path file = scratch / "new/folder/forecasts.jsonl";
    EXPECT_TRUE(read_history(file).empty());
    for (int i = 0; i < 3; ++i)
        EXPECT_TRUE(append_history(file, {{"number", i}}));
    const std::vector<Json> entries = read_history(file);
    ASSERT_EQ(entries.size(), 3u);
    EXPECT_EQ(entries[2].at("number"), 2);
}

TEST(ForecastHistory, damaged_lines_are_left_out) {
    const ScratchFolder scratch;
    const std::filesystem::path file = scratch / "f.jsonl";
    std::ofstream(file) << "{\"number\":1}\n{\"numb\n[1,2]\n\n{\"number\":2}\n{\"half";
    EXPECT_EQ(read_history(file).size(), 2u);
}

TEST(ForecastHistory, place_that_cannot_be_written_is_no_error) {
    EXPECT_FALSE(append_history("/dev/null/voxilux/f.jsonl", {{"number", 1}}));
    EXPECT_FALSE(append_history("", {{"number", 1}}));
}

TEST(ForecastHistory, file_that_is_full_becomes_the_old_one) {
    const ScratchFolder scratch;
    const std::filesystem::path file = scratch / "f.jsonl";
    const Json big = {{"text", std::string(kMaxHistoryBytes / 4, 'x')}};
    for (int i = 0; i < 11; ++i)
        EXPECT_TRUE(append_history(file, big));
    std::uintmax_t bytes = 0;
    for (const auto& found : std::filesystem::directory_iterator(file.parent_path()))
        bytes += found.file_size();
    EXPECT_LE(bytes, 2 * (kMaxHistoryBytes + kMaxHistoryBytes / 4 + 64));
    EXPECT_GE(read_history(file).size(), 4u);
    EXPECT_LE(read_history(file).size(), 8u);
}

TEST(ForecastHistory, lines_of_many_threads_stay_whole) {
    const ScratchFolder scratch;
    const std::filesystem::path file = scratch / "f.jsonl";
    const Json line = {{"text", std::string(3000, 'x')}};
    std::vector<std::thread> threads;
    for (int i = 0; i < 8; ++i)
        threads.emplace_back([&] {
            for (int k = 0; k < 25; ++k)
                (void)append_history(file, line);
        });
    for (std::thread& thread : threads)
        thread.join();
    const std::vector<Json> entries = read_history(file);
    EXPECT_EQ(entries.size(), 200u);
    for (const Json& read : entries)
        ASSERT_EQ(read, line);
}

TEST(ForecastHistory, judgement_counts_what_ended_by_itself) {
    const Json judged = judge_history(
        {entry(1, 3, 2, 2.5), entry(1, 3, 2, 4), entry(1, 3, 2, 1.5), entry(1, 3, 2, 9, "interrupted"),
         entry(1, 3, 2, 9, "time limit reached"), Json{{"other", 1}}},
        2);
    EXPECT_EQ(judged.at("count"), 3);
    EXPECT_EQ(judged.at("inside"), 2);
    EXPECT_NEAR(judged.at("share_inside").get<double>(), 2.0 / 3.0, 1e-12);
    EXPECT_EQ(judged.at("median_ratio"), 1.25);
    EXPECT_EQ(judged.at("renders").size(), 2u);
}

TEST(ForecastHistory, nothing_remembered_is_said) {
    const Json judged = judge_history({}, 5);
    EXPECT_TRUE(judged.at("share_inside").is_null());
    EXPECT_NE(describe_history(judged).find("no render had a forecast yet"), std::string::npos);
}

TEST(ForecastHistory, table_says_how_it_went) {
    const std::string text = describe_history(judge_history({entry(1, 3, 2, 2.5), entry(1, 3, 2, 4)}, 5));
    EXPECT_NE(text.find("2 forecasts, 50 % of the times inside (meant: 80 %)"), std::string::npos) << text;
    EXPECT_NE(text.find("1.0 to 3.0 s"), std::string::npos) << text;
    EXPECT_NE(text.find("outside"), std::string::npos) << text;
}

}  // namespace
}  // namespace voxilux

// The price list of a small scene, from the command line to its files.

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "support/scratch_folder.h"
#include "tools/cli/child_process.h"
#include "tools/cli/words.h"

namespace voxilux::test {
namespace {

namespace fs = std::filesystem;

// The time limit is far more than the small job takes, so that a busy machine leaves nothing out. White
// noise: its error falls with the root of the samples; that of other sequences falls faster.
Words small_list(const fs::path& folder, const std::string& samples = "16") {
    return {"tradeoff",     scene_file("night"),
            "--size",       "64x64",
            "--spp",        samples,
            "--sequence",   "white",
            "-o",           folder,
            "--time-limit", "60s",
            "--no-page",    "-q",
            "--effect",     "indirect=off"};
}

Json json_in(const fs::path& file) {
    std::ifstream stream(file);
    return Json::parse(stream);
}

std::map<std::string, Json> runs_of(const Json& list, const std::string& parameter) {
    std::map<std::string, Json> runs;
    for (const Json& run : list["runs"])
        if (run["knob"] == parameter) runs[run["setting"]] = run;
    return runs;
}

// A price list, and where it is.
struct Made {
    ScratchFolder folder;
    Ending ending;
    Json list;

    explicit Made(const std::string& samples = "16")
        : ending(run(small_list(folder / "list", samples), surroundings())) {
        if (ending.code == 0) list = json_in(folder / "list" / "tradeoff.json");
    }
    [[nodiscard]] Surroundings surroundings() const {
        return {.environment = {{"XDG_CACHE_HOME", (folder / "cache").string()}}};
    }
};

void expect_whole_files(const Made& made) {
    EXPECT_EQ(names_in(made.folder / "list"), (Words{"pictures", "tradeoff.csv", "tradeoff.json"}));
    const std::vector<std::string> pictures = names_in(made.folder / "list" / "pictures");
    const std::set<std::string> there(pictures.begin(), pictures.end());
    std::set<std::string> named = {"pictures/reference.png"};
    for (const Json& run : made.list["runs"])
        for (const char* key : {"picture", "difference"})
            if (!run[key].is_null()) named.insert(run[key]);
    for (const char* row : {"equal_time", "equal_error"})
        for (const Json& picture : made.list[row]["runs"])
            for (const char* key : {"picture", "difference"})
                named.insert(picture[key]);
    EXPECT_EQ(there.size(), named.size());
    for (const std::string& name : named)
        EXPECT_TRUE(there.contains(fs::path(name).filename())) << name;
}

void expect_parameters_of_the_plan(const Made& made) {
    std::set<std::string> names;
    for (const Json& parameter : made.list["knobs"]) {
        names.insert(parameter["name"]);
        EXPECT_TRUE(parameter["left_out"].empty()) << parameter["left_out"];
    }
    EXPECT_EQ(names, (std::set<std::string>{"samples", "sequence", "traversal", "ao", "ao_cell", "ao_rays",
                                            "estimate"}));
}

void expect_structures_to_change_no_pixel(const Made& made) {
    const std::map<std::string, Json> runs = runs_of(made.list, "traversal");
    EXPECT_EQ(runs.size(), 6u);
    for (const auto& [setting, run] : runs) {
        EXPECT_EQ(run["differing_pixels"], 0) << setting;
        EXPECT_EQ(run["error"], runs.begin()->second["error"]) << setting;
    }
}

// Negative control: another sequence does change pixels.
void expect_sequences_to_change_pixels(const Made& made) {
    const std::map<std::string, Json> runs = runs_of(made.list, "sequence");
    ASSERT_EQ(runs.size(), 3u);
    EXPECT_EQ(runs.at("white")["differing_pixels"], 0);
    EXPECT_GT(runs.at("sobol")["differing_pixels"], 0);
    EXPECT_LT(runs.at("sobol")["error"]["total"], runs.at("white")["error"]["total"]);
}

void expect_the_slope_of_white_noise(const Made& made) {
    const Json& parameter = made.list["knobs"][0];
    ASSERT_EQ(parameter["name"], "samples");
    const Json& slope = parameter["slope_of_samples"];
    ASSERT_FALSE(slope.is_null());
    EXPECT_NEAR(slope["value"], -0.5, 0.04);
    EXPECT_LT(slope["low"], slope["high"]);
    std::map<int, double> errors;
    for (const auto& [setting, run] : runs_of(made.list, "samples"))
        errors[std::stoi(setting)] = run["error"]["total"];
    ASSERT_GE(errors.size(), 3u);
    for (auto it = std::next(errors.begin()); it != errors.end(); ++it)
        EXPECT_LT(it->second, std::prev(it)->second) << it->first;
}

void expect_claims_to_agree(const Made& made) {
    for (const auto& [setting, run] : runs_of(made.list, "samples")) {
        if (setting == "1") continue;  // one half alone tells nothing
        const double total = run["error"]["total"];
        EXPECT_GT(run["claimed"]["estimate"], 0.7 * total) << setting;
        EXPECT_LT(run["claimed"]["estimate"], 1.4 * total) << setting;
    }
}

void expect_prices_of_effects(const Made& made) {
    std::map<std::string, Json> effects;
    for (const Json& effect : made.list["effects"])
        effects[effect["name"]] = effect;
    EXPECT_EQ(effects.size(), 13u);
    EXPECT_TRUE(effects.at("ao")["is_beyond_noise"]);
    EXPECT_GT(effects.at("ao")["error_low"], 0.0);
    EXPECT_TRUE(effects.at("aov")["forced"]);
    EXPECT_EQ(effects.at("aov")["error"], 0.0);
    EXPECT_FALSE(effects.at("aov")["is_beyond_noise"]);
    EXPECT_TRUE(effects.at("sun")["error"].is_null());
}

void expect_a_better_reference(const Made& made) {
    const Json& reference = made.list["reference"];
    EXPECT_FALSE(reference["cached"]);
    EXPECT_GT(reference["noise"], 0.0);
    for (const Json& run : made.list["runs"])
        EXPECT_TRUE(run["error"]["is_limited"] || reference["noise"] < run["error"]["total"]) << run["id"];
}

void expect_a_front(const Made& made) {
    std::map<std::string, Json> runs;
    for (const Json& run : made.list["runs"])
        runs[run["id"]] = run;
    ASSERT_FALSE(made.list["front"].empty());
    double time = 0.0, error = 1e9;
    for (const Json& id : made.list["front"]) {
        const Json& run = runs.at(id);
        EXPECT_GT(run["time_s"]["median"], time);
        EXPECT_LT(run["error"]["total"], error);
        time = run["time_s"]["median"];
        error = run["error"]["total"];
    }
}

// One test, because each check would otherwise measure anew.
TEST(Tradeoff, of_a_small_scene_holds_what_is_known_of_it) {
    const Made made;
    ASSERT_EQ(made.ending.code, 0) << made.ending.err;
    EXPECT_EQ(made.ending.out, "");
    expect_whole_files(made);
    expect_parameters_of_the_plan(made);
    expect_structures_to_change_no_pixel(made);
    expect_sequences_to_change_pixels(made);
    expect_the_slope_of_white_noise(made);
    expect_claims_to_agree(made);
    expect_prices_of_effects(made);
    expect_a_better_reference(made);
    expect_a_front(made);
}

TEST(TradeoffReferenceNightly, is_cached_and_rebuilt_when_the_file_is_damaged) {
    const Made first("2");
    ASSERT_EQ(first.ending.code, 0);
    const fs::path references = first.folder / "cache" / "voxilux" / "references";
    const std::vector<std::string> files = names_in(references);
    ASSERT_EQ(files.size(), 1u);
    const fs::path file = references / files.front();
    const Surroundings surroundings = first.surroundings();
    const Ending again = run(small_list(first.folder / "again", "2"), surroundings);
    ASSERT_EQ(again.code, 0) << again.err;
    EXPECT_TRUE(json_in(first.folder / "again" / "tradeoff.json")["reference"]["cached"]);
    fs::resize_file(file, fs::file_size(file) / 2);
    const Ending rebuilt = run(small_list(first.folder / "rebuilt", "2"), surroundings);
    ASSERT_EQ(rebuilt.code, 0) << rebuilt.err;
    EXPECT_FALSE(json_in(first.folder / "rebuilt" / "tradeoff.json")["reference"]["cached"]);
    EXPECT_EQ(names_in(references), files);
}

struct RefusedWords {
    const char* name;
    Words words;
    int code;
    const char* says;
};

void PrintTo(const RefusedWords& refused, std::ostream* os) {
    *os << refused.name;
}

class TradeoffRefused : public testing::TestWithParam<RefusedWords> {};

TEST_P(TradeoffRefused, ends_with_its_code_and_says_why) {
    const ScratchFolder folder;
    std::ofstream(folder / "file").put('x');
    const Ending ending = run(GetParam().words, {.folder = folder.path()});
    EXPECT_EQ(ending.code, GetParam().code) << ending.err;
    EXPECT_NE(ending.err.find(GetParam().says), std::string::npos) << ending.err;
    EXPECT_EQ(ending.out, "");
}

INSTANTIATE_TEST_SUITE_P(
    Tradeoff, TradeoffRefused,
    testing::Values(
        RefusedWords{"no_input", {"tradeoff", "-o", "out"}, 2, "INPUT is required"},
        RefusedWords{"no_folder", {"tradeoff", scene_file("night")}, 2, "-o DIR is missing"},
        RefusedWords{
            "two_repeats", {"tradeoff", scene_file("night"), "-o", "out", "--repeats", "2"}, 2, "--repeats"},
        RefusedWords{
            "time", {"tradeoff", scene_file("night"), "-o", "out", "--time-limit", "soon"}, 2, "soon"},
        RefusedWords{
            "frames", {"tradeoff", scene_file("turntable"), "-o", "out", "--frames", "1-2"}, 2, "--frames"},
        RefusedWords{"absent_scene", {"tradeoff", "absent.toml", "-o", "out"}, 3, "absent.toml"},
        RefusedWords{"file_for_a_folder", {"tradeoff", scene_file("night"), "-o", "file"}, 73, "file"}),
    [](const testing::TestParamInfo<RefusedWords>& one) { return one.param.name; });

// How a price list ends that is interrupted at the progress message `stage`.
Ending interrupted_list(const ScratchFolder& folder, const std::string& time_limit,
                        const std::string& stage) {
    Words words = small_list(folder / "list", "4096");
    std::erase(words, "-q");
    words.insert(words.end(), {"--progress", "json"});
    *std::ranges::find(words, "60s") = time_limit;
    ChildProcess child(words);
    EXPECT_TRUE(child.wait_for_error(stage));
    child.send(SIGINT);
    return child.finish();
}

// Where all have a sixteenth of their samples: runs are from 0.5 to 0.78 of the work.
TEST(TradeoffInterruptedNightly, list_has_what_was_measured_until_then) {
    const ScratchFolder folder;
    const Ending ending = interrupted_list(folder, "12s", "\"done\":0.5175");
    EXPECT_EQ(ending.code, 130) << ending.err;
    EXPECT_NE(ending.err.find("interrupted: the price list has what was measured until then\n"),
              std::string::npos)
        << ending.err;
    EXPECT_FALSE(json_in(folder / "list" / "tradeoff.json")["runs"].empty());
}

TEST(TradeoffInterrupted, before_anything_is_measured_nothing_is_written) {
    const ScratchFolder folder;
    const Ending ending = interrupted_list(folder, "60s", "\"done\"");
    EXPECT_EQ(ending.code, 130) << ending.err;
    EXPECT_NE(ending.err.find("no price list was written"), std::string::npos) << ending.err;
    EXPECT_EQ(names_in(folder / "list"), Words{"pictures"});
}

TEST(TradeoffPage, that_python_cannot_make_leaves_the_other_files) {
    const ScratchFolder folder;
    Words words = small_list(folder / "list", "2");
    std::erase(words, "--no-page");
    // A non-empty folder is where the page should go, and a module with the library's name lies in the
    // current folder.
    std::filesystem::create_directories(folder / "list/tradeoff.html/kept");
    write_text(folder / "matplotlib.py", "open('ran', 'w')");
    const Ending ending = run(words, {.folder = folder.path()});
    EXPECT_FALSE(std::filesystem::exists(folder / "ran")) << "the current folder is not ours";
    EXPECT_EQ(ending.code, 73);
    EXPECT_NE(ending.err.find("--no-page"), std::string::npos) << ending.err;
    EXPECT_EQ(std::ranges::count(ending.err, '\n'), 1) << ending.err;
    EXPECT_EQ(names_in(folder / "list"),
              (Words{"pictures", "tradeoff.csv", "tradeoff.html", "tradeoff.json"}));
}

}  // namespace
}  // namespace voxilux::test

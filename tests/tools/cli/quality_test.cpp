// Quality presets: what they set, what overrides them, what --help prints.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/source_tree.h"
#include "tools/cli/child_process.h"
#include "tools/cli/words.h"

namespace voxilux::test {
namespace {

// Samples per pixel that the plan would take.
std::uint64_t samples_of(const Words& more, const std::string& scene = "first_light") {
    const Json plan = plan_of(scene, more);
    for (const Json& pass : plan["passes"])
        if (pass["label"] == "film.add") return pass["count"];
    return 0;
}

TEST(Quality, better_presets_take_more_samples) {
    std::uint64_t before = 0;
    for (const char* name : {"draft", "normal", "fine", "reference"}) {
        const std::uint64_t samples = samples_of({"--quality", name});
        EXPECT_GT(samples, before) << name;
        before = samples;
    }
}

TEST(Quality, replaces_what_the_file_says) {
    EXPECT_NE(samples_of({"--quality", "draft"}), samples_of({}));
}

TEST(Quality, explicit_flags_win) {
    EXPECT_EQ(samples_of({"--quality", "fine", "--spp", "3"}), 3u);
    EXPECT_EQ(samples_of({"--spp", "3", "--quality", "fine"}), 3u);
    EXPECT_EQ(samples_of({"--quality", "fine", "-D", "render.spp=5"}), 5u);
    EXPECT_EQ(samples_of({"--quality", "fine", "--iterations", "7"}), 7u);
}

TEST(Quality, scenes_with_photons_have_samples_of_their_own) {
    const auto iterations = [](const Words& more) { return samples_of(more, "cornell"); };
    const std::uint64_t preset = iterations({"--quality", "normal"});
    EXPECT_GT(preset, samples_of({"--quality", "normal"}));
    const Words without{"--quality", "normal", "--effect", "indirect=off", "--effect", "caustics=off"};
    EXPECT_LT(iterations(without), preset);
    EXPECT_EQ(iterations(without), samples_of({"--quality", "normal"}));
    EXPECT_EQ(iterations({"--quality", "normal", "--iterations", "7"}), 7u);
    EXPECT_EQ(iterations({"--quality", "normal", "-D", "render.spp=5"}), 5u);
}

TEST(Quality, unknown_name_is_refused_with_the_known_ones) {
    for (const char* command : {"plan", "render"}) {
        const Ending ending = run({command, scene_file("first_light"), "--quality", "best"});
        EXPECT_EQ(ending.code, 2);
        EXPECT_NE(ending.err.find("'best' is none of draft, normal, fine, reference"), std::string::npos)
            << ending.err;
    }
}

TEST(Quality, help_names_every_price_and_the_machine) {
    const Ending ending = run({"render", "--help"});
    EXPECT_EQ(ending.code, 0);
    std::string help;  // one space between words: --help breaks lines
    for (const std::string& line : lines_of(ending.out)) {
        std::istringstream words(line);
        for (std::string word; words >> word;)
            help += word + " ";
    }
    const Pattern price("draft plain [0-9]+ samples, [0-9.]+ %, [0-9.]+ s per megapixel photons [0-9]+");
    EXPECT_FALSE(price.find(help).empty()) << help;
    EXPECT_NE(help.find("medians of "), std::string::npos);
}

}  // namespace
}  // namespace voxilux::test

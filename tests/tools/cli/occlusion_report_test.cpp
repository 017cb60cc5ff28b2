// The occlusion section of the report.

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "support/scratch_folder.h"
#include "support/vox_builder.h"
#include "tools/cli/child_process.h"
#include "tools/cli/words.h"

namespace voxilux::test {
namespace {

TEST(OcclusionReport, says_how_the_table_served) {
    const ScratchFolder scratch;
    const Json report =
        json_of(small_render(scratch, {"--json", "-", "--ao", "hash", "-D", "ao.reproject=true"}));
    const Json& occlusion = report["occlusion"];
    EXPECT_EQ(keys_of(occlusion), (std::set<std::string>{"method", "reason", "slots", "live_cells", "load",
                                                         "probes_per_search", "reused_share"}));
    EXPECT_EQ(occlusion["method"], "hash");
    EXPECT_EQ(occlusion["slots"], 4096);
    EXPECT_EQ(occlusion["live_cells"], report["work"]["ao_claimed"]) << "nothing is given up in one frame";
    EXPECT_GT(occlusion["live_cells"], 10);
    EXPECT_DOUBLE_EQ(occlusion["load"], occlusion["live_cells"].get<double>() / 4096.0);
    const double searches = report["work"]["ao_searches"];
    const double reused = report["work"]["ao_reused"];
    EXPECT_DOUBLE_EQ(occlusion["probes_per_search"], report["work"]["ao_probes"].get<double>() / searches);
    EXPECT_DOUBLE_EQ(occlusion["reused_share"], reused / (reused + searches));
    EXPECT_GT(reused, 0.0);
    const Json blind =
        json_of(small_render(scratch, {"--json", "-", "--ao", "hash", "-D", "ao.reproject=false"}));
    EXPECT_EQ(blind["occlusion"]["reused_share"], 0.0);
    const Ending full = run(small_render(scratch, {"--json", "-", "--ao", "hash", "-D", "ao.slots=16"}));
    EXPECT_EQ(Json::parse(full.out)["occlusion"]["load"], 1.0);
}

TEST(OcclusionReport, without_a_table_has_no_numbers_of_it) {
    const ScratchFolder scratch;
    const Json brute = json_of(small_render(scratch, {"--json", "-"}))["occlusion"];
    EXPECT_EQ(brute["method"], "brute");
    EXPECT_EQ(brute["reason"], "a single picture is traced pixel by pixel");
    for (const char* number : {"slots", "live_cells", "load", "probes_per_search", "reused_share"})
        EXPECT_TRUE(brute.at(number).is_null()) << number;
    const Words off = small_render(scratch, {"--json", "-", "--effect", "ao=off"});
    EXPECT_TRUE(json_of(off).at("occlusion").is_null());
}

TEST(OcclusionReport, has_a_line_for_people) {
    const ScratchFolder scratch;
    const std::string hash = run(small_render(scratch, {"--ao", "hash"})).out;
    EXPECT_NE(hash.find("\nocclusion "), std::string::npos) << hash;
    EXPECT_NE(hash.find(" cells in 4096 slots, "), std::string::npos) << hash;
    EXPECT_EQ(run(small_render(scratch)).out.find("\nocclusion "), std::string::npos);
}

// The order of keys with the same home slot depends on the threads; nothing that is stored may.
TEST(OcclusionReport, reproducible_picture_with_shared_occlusion_has_the_same_bytes_for_other_workgroups) {
    const ScratchFolder scratch;
    const auto bytes_with = [&](const char* group) {
        Words words = small_render(scratch, {"--ao", "hash", "--reproducible", "--group-size", group});
        words[3] = "160x90";
        EXPECT_EQ(run(words).code, 0);
        return bytes_of(scratch / "a.exr");
    };
    const std::string usual = bytes_with("8x8");
    EXPECT_EQ(bytes_with("32x1"), usual);
    EXPECT_EQ(bytes_with("1x64"), usual);
}

// A model that is in another place from frame 1 on.
std::string walking_file() {
    using namespace vox_builder;
    return file_text(chiral_model(4, 3, 5) +
                     transform(0, 1, -1, {{{"_f", "0"}, {"_t", "5 0 0"}}, {{"_f", "1"}, {"_t", "9 2 1"}}}) +
                     shape(1, {{0, {{"_f", "0"}}}}));
}

// The plan of a range of frames has every pass that its render records.
TEST(OcclusionReport, render_of_moving_voxels_records_only_passes_of_its_plan) {
    const ScratchFolder scratch;
    std::ofstream(scratch / "s.toml") << "[[model]]\nfile = 'walk.vox'\n[ao]\nmethod = 'hash'\nslots = "
                                         "32\n[render]\nsize = [16, 9]\nspp = 1\n";
    std::ofstream(scratch / "walk.vox") << walking_file();
    const Words words{"render", scratch / "s.toml", "--frames", "0-20", "--json", "-",
                      "-o",     scratch / "a.png"};
    Words planned = words;
    planned[0] = "plan";
    const auto labels = [](const Json& report) {
        std::set<std::string> all;
        for (const Json& pass : report["passes"])
            all.insert(pass["label"]);
        return all;
    };
    const std::set<std::string> done = labels(json_of(words));
    EXPECT_EQ(done, labels(json_of(planned)));
    EXPECT_TRUE(done.contains("ao.age")) << "voxels rest from frame 1 on";
}

}  // namespace
}  // namespace voxilux::test

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "formats/exr.h"
#include "formats/png.h"
#include "support/scratch_folder.h"
#include "support/source_tree.h"
#include "tools/cli/child_process.h"
#include "tools/cli/words.h"

namespace voxilux::test {
namespace {

TEST(Report, render_has_exactly_its_keys) {
    const ScratchFolder scratch;
    const Json report = json_of(small_render(scratch, {"--json", "-", "--seed", "7"}));
    EXPECT_EQ(
        keys_of(report),
        (std::set<std::string>{"version", "command", "scene_hash", "seed", "size", "device", "wall_s",
                               "cpu_s", "peak_rss_mib", "gpu_ms", "passes", "work", "memory", "effects",
                               "error", "forecast", "faults",
                               // Beyond the contract:
                               "samples", "stopped", "load_s", "steps", "first_pixel_s", "notes", "without",
                               "warnings", "traversal", "occlusion", "photons", "next_minute"}));
    EXPECT_EQ(report["command"], "render");
    EXPECT_EQ(report["seed"], 7);
    EXPECT_EQ(report["size"], Json({32, 18}));
    EXPECT_EQ(report["samples"], 2);
    EXPECT_EQ(keys_of(report["device"]), (std::set<std::string>{"name", "driver", "type"}));
    EXPECT_EQ(keys_of(report["error"]),
              (std::set<std::string>{"metric", "estimate", "low", "high", "confidence",
                                     // Beyond the contract:
                                     "rounds", "decided_by"}));
    EXPECT_EQ(keys_of(report["forecast"]), (std::set<std::string>{"low_s", "high_s"}));
    EXPECT_EQ(keys_of(report["traversal"]), (std::set<std::string>{"name", "reason"}));
    ASSERT_EQ(report["passes"].size(), 7u);
    for (const Json& pass : report["passes"])
        EXPECT_EQ(keys_of(pass), (std::set<std::string>{"label", "count", "ms", "max_ms"}));
    for (const Json& row : report["memory"])
        EXPECT_EQ(keys_of(row), (std::set<std::string>{"buffer", "bytes"}));
    ASSERT_EQ(report["effects"].size(), 13u);
    for (const Json& effect : report["effects"])
        EXPECT_EQ(keys_of(effect), (std::set<std::string>{"name", "on", "reason", "ms"}));
}

TEST(Report, numbers_are_plausible_and_faults_are_zero) {
    const ScratchFolder scratch;
    const Json report = json_of(small_render(scratch, {"--json", "-"}));
    EXPECT_EQ(report["work"]["primary_rays"], 32 * 18 * 2);
    EXPECT_GT(report["work"]["ao_rays"], 0);
    EXPECT_GT(report["wall_s"], 0.0);
    EXPECT_GE(report["wall_s"], report["first_pixel_s"]);
    EXPECT_GE(report["first_pixel_s"], report["load_s"]);
    EXPECT_GT(report["cpu_s"], 0.0);
    EXPECT_GT(report["peak_rss_mib"], 1.0);
    double sum = 0.0;
    for (const Json& pass : report["passes"])
        sum += pass["ms"].get<double>();
    EXPECT_NEAR(report["gpu_ms"], sum, 1e-6 * sum);
    EXPECT_GE(report["faults"].size(), 4u);
    for (const auto& [name, count] : report["faults"].items())
        EXPECT_EQ(count, 0) << name;
}

TEST(Report, steps_of_loading_are_told_in_their_order) {
    const ScratchFolder scratch;
    const Json report = json_of(small_render(scratch, {"--json", "-"}));
    std::vector<std::string> labels;
    double sum = 0.0;
    for (const Json& step : report["steps"]) {
        EXPECT_EQ(keys_of(step), (std::set<std::string>{"label", "wall_s", "cpu_s"}));
        labels.push_back(step["label"]);
        sum += step["wall_s"].get<double>();
    }
    EXPECT_EQ(labels, (std::vector<std::string>{"scene", "device", "facts", "flatten", "structure", "boxes",
                                                "plan", "upload"}));
    EXPECT_GT(sum, 0.0);
    EXPECT_LE(sum, report["first_pixel_s"]);
}

// The time of an effect is that of its passes. An effect without a pass has none.
TEST(Report, effects_carry_the_time_of_their_passes) {
    const ScratchFolder scratch;
    const Json report = json_of(small_render(scratch, {"--json", "-"}));
    const auto ms_of = [&](const char* list, const char* key, const std::string& name) {
        for (const Json& row : report[list])
            if (row[key] == name) return row["ms"].get<double>();
        return -1.0;
    };
    EXPECT_DOUBLE_EQ(ms_of("effects", "name", "voxels"),
                     ms_of("passes", "label", "primary.beam") + ms_of("passes", "label", "primary.march"));
    EXPECT_DOUBLE_EQ(ms_of("effects", "name", "spheres"), ms_of("passes", "label", "sphere.trace"));
    EXPECT_DOUBLE_EQ(ms_of("effects", "name", "ao"), ms_of("passes", "label", "ao.trace"));
    EXPECT_DOUBLE_EQ(ms_of("effects", "name", "sun"), ms_of("passes", "label", "sun.trace"));
    EXPECT_EQ(ms_of("effects", "name", "emission"), 0.0);
}

TEST(Report, plan_promises_what_the_render_does) {
    const ScratchFolder scratch;
    Words words = small_render(scratch, {"--json", "-"});
    const Json report = json_of(words);
    words[0] = "plan";
    const Json plan = json_of(words);
    EXPECT_EQ(keys_of(plan),
              (std::set<std::string>{"version", "command", "scene_hash", "seed", "size", "effects", "passes",
                                     "memory", "forecast", "rays", "notes", "without", "traversal",
                                     "occlusion", "photons", "techniques", "end_bytes"}));
    EXPECT_EQ(plan["traversal"], report["traversal"]);
    EXPECT_EQ(plan["occlusion"]["reason"], report["occlusion"]["reason"]);
    EXPECT_EQ(keys_of(plan["occlusion"]), (std::set<std::string>{"method", "reason", "slots"}));
    EXPECT_EQ(plan["scene_hash"], report["scene_hash"]);
    ASSERT_EQ(plan["passes"].size(), report["passes"].size());
    std::map<std::string, int> done;
    for (const Json& pass : report["passes"])
        done[pass["label"]] = pass["count"];
    for (const Json& pass : plan["passes"])
        EXPECT_EQ(pass["count"], done[pass["label"]]) << pass;
    for (std::size_t i = 0; i < plan["effects"].size(); ++i) {
        EXPECT_EQ(plan["effects"][i]["name"], report["effects"][i]["name"]);
        EXPECT_EQ(plan["effects"][i]["reason"], report["effects"][i]["reason"]);
    }
}

TEST(Report, plan_without_an_output_is_that_of_the_default_picture) {
    const auto aov_of = [](const Words& words) { return json_of(words)["effects"].back()["on"].get<bool>(); };
    EXPECT_FALSE(aov_of({"plan", scene_file("mixed"), "--json", "-"}));
    EXPECT_FALSE(aov_of({"plan", scene_file("mixed"), "--json", "-", "-o", "x.png"}));
    EXPECT_TRUE(aov_of({"plan", scene_file("mixed"), "--json", "-", "-o", "x.png", "-o", "y.exr"}));
}

TEST(Report, file_and_picture_hold_the_same_report) {
    const ScratchFolder scratch;
    EXPECT_EQ(run(small_render(scratch, {"--json", scratch / "a.json"})).code, 0);
    const Json file = Json::parse(bytes_of(scratch / "a.json"));
    const Json picture = Json::parse(read_exr(scratch / "a.exr").attributes.at("voxilux.report"));
    EXPECT_EQ(file["scene_hash"], picture["scene_hash"]);
    EXPECT_EQ(file["passes"], picture["passes"]);
    EXPECT_EQ(file["effects"], picture["effects"]);
}

TEST(Report, compare_has_exactly_its_keys) {
    const ScratchFolder scratch;
    Image image = make_image(16, 16, Words{"R", "G", "B"});
    write_png(scratch / "a.png", image);
    const Json black = json_of({"compare", scratch / "a.png", scratch / "a.png", "--json", "-"});
    const std::set<std::string> keys = {"rmse", "mae",      "relmse",    "smape",  "flip",
                                        "psnr", "mean_ref", "mean_test", "max_abs"};
    EXPECT_EQ(keys_of(black), keys);
    image.channels["R"].pixels[3] = 1.0f;
    write_png(scratch / "b.png", image);
    const Json differ = json_of({"compare", scratch / "a.png", scratch / "b.png", "--json", "-"});
    EXPECT_EQ(keys_of(differ), keys);
    EXPECT_NEAR(differ["rmse"], std::sqrt(1.0 / (3 * 256)), 1e-9);
    EXPECT_EQ(differ["max_abs"], 1.0);
    EXPECT_EQ(differ["mean_ref"].size(), 3u);
}

TEST(Report, devices_have_exactly_their_keys_and_one_would_be_used) {
    const Json devices = json_of({"devices", "--json", "-"});
    int used = 0;
    for (const Json& device : devices) {
        EXPECT_EQ(keys_of(device),
                  (std::set<std::string>{"index", "name", "driver", "type", "usable", "would_use", "lacks",
                                         "max_binding_bytes", "max_allocation_bytes"}));
        used += device["would_use"].get<bool>() ? 1 : 0;
    }
    EXPECT_EQ(used, 1);
}

TEST(Report, info_on_a_scene_says_what_it_makes) {
    const Json facts = json_of({"info", scene_file("mixed"), "--json", "-"});
    EXPECT_EQ(keys_of(facts),
              (std::set<std::string>{"scene_hash", "voxels", "instances", "models", "spheres", "materials",
                                     "voxel_box", "fill_ratio", "sun", "sky", "emitters", "glass", "metal",
                                     "camera", "size", "spp", "warnings"}));
    EXPECT_EQ(facts["voxels"], 40 * 40 * 2 + 12 * 3 * 10);
    EXPECT_EQ(facts["voxel_box"], Json({{-20, -20, -2}, {20, 20, 10}}));
    EXPECT_EQ(facts["spheres"], 3);
    EXPECT_EQ(facts["camera"]["of_the_file"], false);
    const Ending text = run({"info", scene_file("mixed")});
    EXPECT_NE(text.out.find("voxels: 3560\n"), std::string::npos) << text.out;
    EXPECT_NE(text.out.find("(frames the scene)"), std::string::npos) << text.out;
}

TEST(Report, info_on_a_picture_lists_its_channels) {
    const ScratchFolder scratch;
    EXPECT_EQ(run(small_render(scratch, {"-o", scratch / "a.png", "-q"})).code, 0);
    const Json exr = json_of({"info", scratch / "a.exr", "--json", "-"});
    EXPECT_EQ(keys_of(exr), (std::set<std::string>{"size", "channels", "attributes"}));
    EXPECT_EQ(exr["size"], Json({32, 18}));
    for (const Json& channel : exr["channels"]) {
        EXPECT_EQ(keys_of(channel),
                  (std::set<std::string>{"name", "type", "min", "max", "mean", "non_finite"}));
        EXPECT_EQ(channel["non_finite"], 0);
        EXPECT_TRUE(channel["name"] != "sampleCount.Y" || channel["mean"] == 2.0) << channel;
    }
    EXPECT_EQ(exr["attributes"]["voxilux.report"]["command"], "render");
    const Json png = json_of({"info", scratch / "a.png", "--json", "-"});
    ASSERT_EQ(png["channels"].size(), 3u);
    EXPECT_EQ(png["channels"][0]["type"], "8-bit");
    EXPECT_NE(run({"info", scratch / "a.exr"}).out.find("channel   R              half"), std::string::npos);
}

TEST(Streams, pipe_gets_no_progress_line) {
    const ScratchFolder scratch;
    const Ending ending = run(small_render(scratch));
    EXPECT_EQ(ending.err, "");
    EXPECT_NE(ending.out.find("samples   2 of 2 per pixel, finished\n"), std::string::npos) << ending.out;
    EXPECT_NE(ending.out.find("wrote     "), std::string::npos);
}

TEST(Streams, quiet_render_says_nothing) {
    const ScratchFolder scratch;
    const Ending ending = run(small_render(scratch, {"-q"}));
    EXPECT_EQ(ending.code, 0);
    EXPECT_EQ(ending.out + ending.err, "");
}

TEST(Streams, verbose_render_prints_the_plan_too) {
    const ScratchFolder scratch;
    EXPECT_NE(run(small_render(scratch, {"-v"})).out.find("effect    voxels     on   3560 voxels"),
              std::string::npos);
}

TEST(Streams, verbose_plan_prints_the_first_frame_too) {
    const Ending ending = run({"plan", scene_file("mixed"), "-v"});
    EXPECT_NE(ending.out.find("primary_march"), std::string::npos) << ending.out;
}

TEST(Streams, what_a_picture_lacks_is_noted_on_standard_error) {
    const ScratchFolder scratch;
    const Words words = {"render",      scene_file("spheres"),
                         "--size",      "16x9",
                         "--spp",       "1",
                         "-D",          "material.red.surface='metal'",
                         "--technique", "indirect=photons",
                         "-o",          scratch / "a.png"};
    EXPECT_EQ(run(words).err, "note: glass and mirrors block the light of the sky as walls do\n");
    Words quiet = words;
    quiet.push_back("-q");
    EXPECT_EQ(run(quiet).err, "");
}

TEST(Streams, progress_for_programs_is_a_json_object_a_line) {
    const ScratchFolder scratch;
    const Ending ending =
        run(small_render(scratch, {"--spp", "40", "--progress=json", "--error", "0.0001%"}));
    std::istringstream lines(ending.err);
    int count = 0;
    double last = 0.0;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("warning: ")) continue;  // the error stays above its target
        const Json progress = Json::parse(line);
        ++count;
        EXPECT_GE(progress["done"], last);
        last = progress["done"];
        EXPECT_GE(progress["elapsed_s"], 0.0);
        EXPECT_GE(progress["remaining_s"], 0.0);
        EXPECT_GE(progress["sample"], 1);
        EXPECT_TRUE(progress.contains("error")) << progress;  // the pilot knows it
        EXPECT_LE(progress["error_at_end"], progress["error"]);
        EXPECT_LE(progress["remaining_low_s"], progress["remaining_high_s"]);
    }
    EXPECT_GE(count, 2);
    EXPECT_EQ(last, 1.0);
}

TEST(Streams, help_of_every_subcommand_is_on_standard_output) {
    for (const char* command : {"render", "plan", "info", "devices", "compare", "bench"}) {
        const Ending ending = run({command, "--help"});
        EXPECT_EQ(ending.code, 0);
        EXPECT_EQ(ending.err, "");
        EXPECT_NE(ending.out.find(std::string("Usage: voxilux ") + command), std::string::npos) << ending.out;
    }
    const Ending ending = run({"--help"});
    EXPECT_EQ(ending.code, 0);
    for (const char* code :
         {"0  done", "2  usage", "3  ", "4  ", "5  ", "69  ", "70  ", "71  ", "73  ", "74  ", "130  "})
        EXPECT_NE(ending.out.find(code), std::string::npos) << code;
}

TEST(Streams, version_names_build_and_libraries_and_asks_no_device) {
    const Ending ending = run({"--version"}, {.environment = {{"VK_DRIVER_FILES", "/nowhere"}}});
    EXPECT_EQ(ending.code, 0);
    EXPECT_EQ(ending.err, "");
    for (const char* part :
         {"^voxilux [0-9]+\\.[0-9]+\\.[0-9]+\n", "\nbuild +[0-9a-f]{16}, ", "\nvulkan +loader 1\\.[0-9]+\\.",
          "Vulkan headers 1\\.[0-9]", "glslang [0-9]+\\.", "OpenEXR [0-9]+\\.", "GLFW [0-9]+\\.",
          "Dear ImGui [0-9]+\\.", "TinyGLTF [0-9]+\\.", "CLI11 [0-9]+\\."})
        EXPECT_FALSE(Pattern(part).find(ending.out).empty()) << part << ending.out;
}

}  // namespace
}  // namespace voxilux::test

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "support/scratch_folder.h"
#include "tools/cli/child_process.h"
#include "tools/cli/words.h"

namespace voxilux::test {
namespace {

Words small_bench(const Words& more) {
    return with({"bench", "march", "--size", "32x18", "--rounds", "1"}, more);
}

TEST(Bench, march_prints_rows_with_their_keys_and_no_mismatch) {
    const Ending ending = run(small_bench({"--extent", "32", "--json", "-"}));
    ASSERT_EQ(ending.code, 0) << ending.err;
    EXPECT_EQ(ending.err, "");
    const std::set<std::string> keys = {"scene", "extent", "traversal", "rays", "mrays_per_cpu_s",
                                        "mrays_per_s", "steps", "memory_bytes", "mismatches",
                                        // Beyond the contract:
                                        "fits", "count", "build_s", "checked"};
    const Json rows = Json::parse(ending.out);
    std::set<std::string> kinds;
    for (const Json& row : rows) {
        EXPECT_EQ(keys_of(row), keys);
        EXPECT_EQ(row["extent"], 32);
        EXPECT_EQ(row["mismatches"], 0) << row;
        EXPECT_GT(row["checked"], 0);
        kinds.insert(row["rays"]);
    }
    EXPECT_EQ(kinds, (std::set<std::string>{"primary", "ao", "long"}));
}

TEST(Bench, march_takes_lists_and_repeated_flags) {
    const Ending ending = run(small_bench({"--extent", "32,48", "--traversal", "dda,naadf", "--traversal",
                                           "dda", "--rays", "ao", "--rays", "primary", "--json", "-"}));
    ASSERT_EQ(ending.code, 0) << ending.err;
    const Json rows = Json::parse(ending.out);
    ASSERT_EQ(rows.size(), 8u);
    EXPECT_EQ(rows[0]["traversal"], "dda");
    EXPECT_EQ(rows[0]["rays"], "ao");
    EXPECT_EQ(rows[3]["traversal"], "naadf");
    EXPECT_EQ(rows[3]["rays"], "primary");
    EXPECT_EQ(rows[3]["extent"], 32);
    EXPECT_EQ(rows[4]["extent"], 48);
}

TEST(Bench, march_takes_scene_files_instead_of_procedural_worlds) {
    const ScratchFolder scratch;
    const Ending ending =
        run(small_bench({scene_file("mixed"), "--traversal", "naadf", "--json", scratch / "rows.json"}));
    ASSERT_EQ(ending.code, 0) << ending.err;
    EXPECT_NE(ending.out.find("scene     mixed.toml"), std::string::npos) << ending.out;
    const Json rows = Json::parse(bytes_of(scratch / "rows.json"));
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_EQ(rows[0]["scene"], "mixed.toml");
    EXPECT_EQ(rows[0]["mismatches"], 0);
}

// A byte per voxel of 1312^3 is 2.1 GiB: more than software devices allocate at once.
TEST(Bench, structure_that_does_not_fit_says_so) {
    const Ending ending =
        run(small_bench({"--extent", "1312", "--traversal", "dda", "--rays", "primary", "--json", "-"}));
    ASSERT_EQ(ending.code, 0) << ending.err;
    const Json rows = Json::parse(ending.out);
    ASSERT_EQ(rows.size(), 1u);
    if (rows[0]["fits"] == true) GTEST_SKIP() << "this device allocates more";
    EXPECT_EQ(keys_of(rows[0]),
              (std::set<std::string>{"scene", "extent", "traversal", "rays", "fits", "reason"}));
}

TEST(Bench, scene_without_voxels_is_refused) {
    const Ending ending = run(small_bench({scene_file("spheres")}));
    EXPECT_EQ(ending.code, 3) << ending.err;
    EXPECT_NE(ending.err.find("there is no voxel to march to"), std::string::npos) << ending.err;
}

Words small_ao(const Words& more) {
    return with({"bench", "ao", "--size", "64x36", "--extent", "64", "--frames", "4", "--reference", "16",
                 "--rounds", "1"},
                more);
}

TEST(BenchAo, prints_rows_with_their_keys_for_each_motion_and_variant) {
    const Ending ending =
        run(small_ao({"--motion", "still,walk", "--variant", "brute,reproject,filter-1", "--json", "-"}));
    ASSERT_EQ(ending.code, 0) << ending.err;
    EXPECT_EQ(ending.err, "");
    const Json rows = Json::parse(ending.out);
    ASSERT_EQ(rows.size(), 6u);
    const std::set<std::string> keys = {"scene",
                                        "motion",
                                        "variant",
                                        "frames",
                                        "rays_per_pixel",
                                        "ao_ms",
                                        "cpu_ms",
                                        "rays",
                                        "searched_percent",
                                        "probes_per_search",
                                        "passes_ms",
                                        "atomics",
                                        "flicker",
                                        "cells",
                                        "table_full",
                                        "load",
                                        "errors",
                                        "reference_noise"};
    const std::set<std::string> hash_passes = {"ao.reproject", "ao.search", "ao.sample", "ao.resolve"};
    for (const Json& row : rows) {
        EXPECT_EQ(keys_of(row), keys);
        EXPECT_EQ(row["errors"].size(), 2u);  // frames 1 and 4
        EXPECT_EQ(row["flicker"].is_null(), row["motion"] != "still" || row["variant"] == "brute");
        EXPECT_GT(row["ao_ms"], 0.0);
        if (row["variant"] == "reproject") {
            EXPECT_EQ(keys_of(row["passes_ms"]), hash_passes);
        }
    }
    EXPECT_EQ(keys_of(rows[0]["passes_ms"]), std::set<std::string>{"ao.trace"});
    EXPECT_EQ(rows[0]["cells"], 0);
    EXPECT_EQ(rows[1]["searched_percent"], 0.0);
    EXPECT_EQ(rows[1]["atomics"].get<double>(), 2.0 * rows[1]["rays"].get<double>());
    EXPECT_EQ(rows[3]["motion"], "walk");
    EXPECT_GT(rows[4]["searched_percent"], 0.0);
    // Cells that keep their samples are nearer to the truth than a single ray is.
    for (const std::size_t brute : {0u, 3u})
        EXPECT_LT(rows[brute + 1]["errors"][1]["rmse"], rows[brute]["errors"][1]["rmse"]);
}

TEST(BenchAo, floor_is_measured_for_widths_of_cells_of_scene_files_too) {
    const ScratchFolder scratch;
    const Ending ending = run({"bench", "ao", scene_file("mixed"), "--size", "32x18", "--reference", "16",
                               "--motion", "floor", "--rounds", "1", "--json", scratch / "rows.json"});
    ASSERT_EQ(ending.code, 0) << ending.err;
    EXPECT_NE(ending.out.find("mixed.toml, floor: 16 frames, 64 rays per pixel"), std::string::npos)
        << ending.out;
    std::set<std::string> variants;
    for (const Json& row : Json::parse(bytes_of(scratch / "rows.json")))
        variants.insert(row["variant"]);
    EXPECT_EQ(variants, (std::set<std::string>{"hash", "px-5", "px-16"}));
}

TEST(BenchAo, scene_without_voxels_is_refused) {
    const Ending ending = run(small_ao({scene_file("spheres")}));
    EXPECT_EQ(ending.code, 3) << ending.err;
    EXPECT_NE(ending.err.find("there is no voxel whose occlusion could be found"), std::string::npos)
        << ending.err;
}

Words small_photons(const Words& more) {
    return with({"bench", "photons", scene_file("cornell"), "--size", "32x32", "--photons", "2000",
                 "--iterations", "4", "--rounds", "1"},
                more);
}

TEST(BenchPhotons, prints_rows_with_their_keys_for_each_variant) {
    const Ending ending = run(small_photons({"--growth", "none", "--json", "-"}));
    ASSERT_EQ(ending.code, 0) << ending.err;
    EXPECT_EQ(ending.err, "");
    const Json json = Json::parse(ending.out);
    EXPECT_EQ(json["growth"].size(), 0u);
    const Json& rows = json["rows"];
    ASSERT_EQ(rows.size(), 4u);
    for (const Json& row : rows) {
        EXPECT_EQ(keys_of(row),
                  (std::set<std::string>{
                      "scene",     "series", "variant",  "photons",  "size",   "iterations", "radius",
                      "alpha",     "method", "classic",  "roulette", "wall_s", "cpu_s",      "photons_per_s",
                      "passes_ms", "stored", "segments", "faults",   "relmse", "mean_off",   "floor"}));
        EXPECT_EQ(row["photons"], 2000);
        EXPECT_EQ(row["iterations"], row["variant"] == "scatter" ? 1 : 4);
        EXPECT_EQ(row["passes_ms"].contains("photon.gather"), row["method"] == "gather");
        EXPECT_GT(row["passes_ms"]["photon.trace"], 0.0);
        EXPECT_GT(row["photons_per_s"], 0.0);
        EXPECT_TRUE(row["relmse"].is_null());
        EXPECT_EQ(row["faults"], 0) << row;
    }
    // Paths without roulette are longer.
    EXPECT_GT(rows[1]["segments"], rows[0]["segments"]);
    EXPECT_GT(rows[1]["stored"], rows[0]["stored"]);
}

TEST(BenchPhotons, errors_are_those_against_the_reference) {
    const ScratchFolder scratch;
    const Ending picture = run({"render", scene_file("cornell"), "--size", "32x32", "--photons", "2000",
                                "--radius", "2", "--iterations", "4", "-o", scratch / "a.exr"});
    ASSERT_EQ(picture.code, 0) << picture.err;
    const Ending ending =
        run(small_photons({"--growth", "none", "--variant", "gather,no-roulette", "--reference",
                           scratch / "a.exr", "--box", "8,8,24,24", "--json", "-"}));
    ASSERT_EQ(ending.code, 0) << ending.err;
    const Json rows = Json::parse(ending.out)["rows"];
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_LT(rows[0]["relmse"], 1e-6);  // the same render, rounded to half floats
    EXPECT_LT(rows[0]["floor"], 1e-3);
    EXPECT_GT(rows[1]["relmse"], 1e-4);
    EXPECT_GT(rows[1]["floor"], 1e-3);
}

TEST(BenchPhotons, growth_has_an_exponent_for_time_and_passes) {
    const ScratchFolder scratch;
    const Ending ending = run(
        small_photons({"--variant", "gather", "--growth", "iterations", "--json", scratch / "rows.json"}));
    ASSERT_EQ(ending.code, 0) << ending.err;
    EXPECT_NE(ending.out.find("exponent  of iterations: wall "), std::string::npos) << ending.out;
    const Json json = Json::parse(bytes_of(scratch / "rows.json"));
    EXPECT_EQ(json["rows"].size(), 4u);
    ASSERT_EQ(json["growth"].size(), 1u);
    EXPECT_EQ(json["growth"][0]["series"], "iterations");
    EXPECT_GT(json["growth"][0]["passes"]["photon.trace"], 0.0);
}

TEST(BenchPhotons, scene_that_calls_for_none_is_refused) {
    const Ending ending = run({"bench", "photons", scene_file("spheres"), "--size", "8x8"});
    EXPECT_EQ(ending.code, 3) << ending.err;
    EXPECT_NE(ending.err.find("no photons are called for"), std::string::npos) << ending.err;
}

}  // namespace
}  // namespace voxilux::test

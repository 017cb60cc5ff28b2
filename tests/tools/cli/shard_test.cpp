// Shards and their merging as a user runs them.

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "formats/exr.h"
#include "support/scratch_folder.h"
#include "tools/cli/child_process.h"
#include "tools/cli/words.h"

namespace voxilux::test {
namespace {

// A render of voxels and spheres with every plane that a film has.
Words mixed_of_7(const Words& more) {
    return with({"render", scene_file("mixed"), "--size", "48x27", "--spp", "7", "-q"}, more);
}

// Shards 1/N to N/N as p1.exr to pN.exr.
void render_shards(const ScratchFolder& scratch, int count, const Words& more) {
    for (int i = 1; i <= count; ++i) {
        Words words = mixed_of_7({"--shard", std::to_string(i) + "/" + std::to_string(count), "-o",
                                  "p" + std::to_string(i) + ".exr"});
        words.insert(words.end(), more.begin(), more.end());
        const Ending ending = run(words, {.folder = scratch.path()});
        ASSERT_EQ(ending.code, 0) << ending.err;
    }
}

Ending merge(const ScratchFolder& scratch, Words parts, const Words& more) {
    parts.insert(parts.begin(), "merge");
    parts.insert(parts.end(), more.begin(), more.end());
    return run(parts, {.folder = scratch.path()});
}

TEST(Merge, any_order_gives_the_bytes_of_the_uninterrupted_render) {
    const ScratchFolder scratch;
    EXPECT_EQ(
        run(mixed_of_7({"--reproducible", "-o", "whole.exr", "-o", "whole.png"}), {.folder = scratch.path()})
            .code,
        0);
    render_shards(scratch, 3, {"--reproducible"});
    Words order = {"p1.exr", "p2.exr", "p3.exr"};
    do {
        const Ending ending = merge(scratch, order, {"--reproducible", "-o", "m.exr", "-o", "m.png"});
        EXPECT_EQ(ending.code, 0) << ending.err;
        EXPECT_TRUE(bytes_of(scratch / "m.exr") == bytes_of(scratch / "whole.exr"));
        EXPECT_TRUE(bytes_of(scratch / "m.png") == bytes_of(scratch / "whole.png"));
    } while (std::ranges::next_permutation(order).found);
    EXPECT_FALSE(bytes_of(scratch / "p1.exr") == bytes_of(scratch / "whole.exr"));
}

TEST(Merge, crops_and_parts_with_times_merge_to_the_same_bytes) {
    const ScratchFolder scratch;
    const Words crop = {"--crop", "5,6,31,22"};
    EXPECT_EQ(run(mixed_of_7({"--crop", "5,6,31,22", "--reproducible", "-o", "whole.exr"}),
                  {.folder = scratch.path()})
                  .code,
              0);
    render_shards(scratch, 2, crop);
    EXPECT_EQ(merge(scratch, {"p2.exr", "p1.exr"}, {"--reproducible", "-q", "-o", "m.exr"}).code, 0);
    EXPECT_TRUE(bytes_of(scratch / "m.exr") == bytes_of(scratch / "whole.exr"));
    // With times: another header, the same picture.
    EXPECT_EQ(merge(scratch, {"p2.exr", "p1.exr"}, {"-q", "-o", "timed.exr"}).code, 0);
    const Image timed = read_exr(scratch / "timed.exr");
    EXPECT_TRUE(timed.attributes.contains("capDate"));
    EXPECT_EQ(timed.channels.at("R").pixels, read_exr(scratch / "whole.exr").channels.at("R").pixels);
}

TEST(Merge, one_shard_of_one_is_the_picture) {
    const ScratchFolder scratch;
    const Surroundings here{.folder = scratch.path()};
    const Words job = {"render", scene_file("mixed"), "--size", "32x18", "--spp",
                       "3",      "--reproducible",    "-q"};
    ASSERT_EQ(run(with(job, {"-o", "a.exr"}), here).code, 0);
    ASSERT_EQ(run(with(job, {"-o", "part.exr", "--shard", "1/1"}), here).code, 0);
    ASSERT_EQ(run({"merge", "part.exr", "-o", "b.exr", "--reproducible"}, here).code, 0);
    EXPECT_TRUE(bytes_of(scratch / "a.exr") == bytes_of(scratch / "b.exr"));
}

TEST(Merge, another_seed_gives_other_bytes) {
    const ScratchFolder scratch;
    EXPECT_EQ(run(mixed_of_7({"--reproducible", "-o", "whole.exr"}), {.folder = scratch.path()}).code, 0);
    render_shards(scratch, 2, {"--reproducible", "--seed", "1"});
    EXPECT_EQ(merge(scratch, {"p1.exr", "p2.exr"}, {"--reproducible", "-o", "m.exr"}).code, 0);
    EXPECT_FALSE(bytes_of(scratch / "m.exr") == bytes_of(scratch / "whole.exr"));
}

TEST(Merge, missing_part_is_named_and_partial_merges_what_is_there) {
    const ScratchFolder scratch;
    EXPECT_EQ(run(mixed_of_7({"--reproducible", "-o", "whole.exr"}), {.folder = scratch.path()}).code, 0);
    render_shards(scratch, 3, {"--reproducible"});
    const Ending refused = merge(scratch, {"p3.exr", "p1.exr"}, {"-o", "m.exr"});
    EXPECT_EQ(refused.code, 3);
    EXPECT_EQ(
        refused.err,
        "voxilux: the picture is not complete: samples 1,4 are missing; --partial merges what is there\n");
    EXPECT_FALSE(std::filesystem::exists(scratch / "m.exr"));

    const Ending partial =
        merge(scratch, {"p3.exr", "p1.exr"}, {"--partial", "--reproducible", "--json", "-", "-o", "two.exr"});
    EXPECT_EQ(partial.code, 0) << partial.err;
    EXPECT_EQ(Json::parse(partial.out)["samples"], 5);
    const Image two = read_exr(scratch / "two.exr");
    EXPECT_EQ(two.channels.at("sampleCount.Y").pixels.front(), 5.0f);
    EXPECT_EQ(two.channels.at("Z").pixels, read_exr(scratch / "whole.exr").channels.at("Z").pixels);
    // The sums went with it: the last shard completes them.
    EXPECT_EQ(merge(scratch, {"two.exr", "p2.exr"}, {"--reproducible", "-q", "-o", "m.exr"}).code, 0);
    EXPECT_TRUE(bytes_of(scratch / "m.exr") == bytes_of(scratch / "whole.exr"));
}

TEST(Merge, what_does_not_belong_together_ends_with_3) {
    const ScratchFolder scratch;
    render_shards(scratch, 2, {});
    const auto refusal = [&](const Words& parts) {
        const Ending ending = merge(scratch, parts, {"-o", "m.exr"});
        EXPECT_EQ(ending.code, 3);
        EXPECT_EQ(ending.out, "");
        return ending.err;
    };
    EXPECT_EQ(refusal({"p1.exr", "p1.exr"}), "voxilux: p1.exr: its sample 0 is in p1.exr already\n");
    const Surroundings here{.folder = scratch.path()};
    EXPECT_EQ(run(mixed_of_7({"--shard", "2/2", "--ao-rays", "2", "-o", "rays.exr"}), here).code, 0);
    EXPECT_EQ(refusal({"p1.exr", "rays.exr"}),
              "voxilux: rays.exr: not of the same render as p1.exr: its ao_rays is 2 and not 1\n");
    EXPECT_EQ(run(mixed_of_7({"--shard", "2/2", "-D", "sun.elevation=11", "-o", "sun.exr"}), here).code, 0);
    EXPECT_NE(refusal({"p1.exr", "sun.exr"}).find("its scene_hash is "), std::string::npos);
    EXPECT_EQ(run(mixed_of_7({"-o", "plain.exr"}), here).code, 0);
    EXPECT_NE(refusal({"p1.exr", "plain.exr"})
                  .find("plain.exr: not a part of a render: it is a picture without sums"),
              std::string::npos);
    EXPECT_NE(refusal({"p1.exr", "none.exr"}).find("none.exr: cannot open"), std::string::npos);
}

// A render of `flags` in one go, and in parts that are merged as a list and as a tree. Techniques that use
// paths or photons run other passes than occlusion does.
void expect_partitions_to_add_up(const Words& flags) {
    const ScratchFolder scratch;
    const Surroundings here{.folder = scratch.path()};
    const Words render = with({"render", "--size", "24x16", "--reproducible", "-q"}, flags);
    ASSERT_EQ(run(with(render, {"--spp", "9", "-o", "whole.exr"}), here).code, 0);
    const Words ranges = {"0-1,6", "2-4x2", "3,5", "7-8"};
    Words parts;
    for (const std::string& range : ranges) {
        parts.push_back("p" + range + ".exr");
        ASSERT_EQ(run(with(render, {"--samples", range, "-o", parts.back()}), here).code, 0);
    }
    const Words end = {"--reproducible", "-q", "-o"};
    ASSERT_EQ(run(with(with(with({"merge"}, parts), end), {"list.exr"}), here).code, 0);
    EXPECT_TRUE(bytes_of(scratch / "list.exr") == bytes_of(scratch / "whole.exr"));
    const Words group = {"merge", "--partial", parts[3], parts[0]};
    ASSERT_EQ(run(with(with(group, end), {"group.exr"}), here).code, 0);
    const Words tree = {"merge", parts[2], "group.exr", parts[1]};
    ASSERT_EQ(run(with(with(tree, end), {"tree.exr"}), here).code, 0);
    EXPECT_TRUE(bytes_of(scratch / "tree.exr") == bytes_of(scratch / "whole.exr"));
}

TEST(Samples, parts_of_paths_add_up_to_one_render) {
    expect_partitions_to_add_up({scene_file("mixed")});
}

TEST(Samples, parts_of_occlusion_add_up_to_one_render) {
    expect_partitions_to_add_up({scene_file("wall_corner"), "--ao", "brute"});
}

TEST(SamplesNightly, parts_of_photons_add_up_to_one_render) {
    expect_partitions_to_add_up(
        {scene_file("cornell"), "--photons", "2000", "--technique", "indirect=photons"});
}

// The total number of samples is not stored in a part: the parts of another command continue where the first
// one ended.
TEST(Samples, more_samples_can_be_added_later) {
    const ScratchFolder scratch;
    const Surroundings here{.folder = scratch.path()};
    const Words render = {"render", scene_file("one_voxel"), "--size", "16x9", "--reproducible", "-q"};
    ASSERT_EQ(run(with(render, {"--spp", "6", "-o", "whole.exr"}), here).code, 0);
    ASSERT_EQ(run(with(render, {"--spp", "4", "--samples", "0-3", "-o", "a.exr"}), here).code, 0);
    ASSERT_EQ(run(with(render, {"--spp", "6", "--samples", "4-5", "-o", "b.exr"}), here).code, 0);
    EXPECT_EQ(run({"merge", "a.exr", "-o", "four.exr"}, here).code, 0) << "all that it was asked for";
    const Ending hole = run({"merge", "b.exr", "-o", "m.exr"}, here);
    EXPECT_EQ(hole.code, 3);
    EXPECT_NE(hole.err.find("samples 0-3 are missing"), std::string::npos) << hole.err;
    ASSERT_EQ(run({"merge", "b.exr", "a.exr", "--reproducible", "-o", "m.exr"}, here).code, 0);
    EXPECT_TRUE(bytes_of(scratch / "m.exr") == bytes_of(scratch / "whole.exr"));
}

TEST(Samples, finished_part_ends_the_command_at_once) {
    const ScratchFolder scratch;
    const Surroundings here{.folder = scratch.path()};
    const Words part = {"render", scene_file("one_voxel"), "--size", "16x9", "--samples", "2-5", "-o",
                        "p.exr"};
    ASSERT_EQ(run(part, here).code, 0);
    const std::string before = bytes_of(scratch / "p.exr");
    const Ending again = run(with(part, {"--json", "-"}), here);
    EXPECT_EQ(again.code, 0);
    EXPECT_EQ(again.err, "note: p.exr has these samples already\n");
    EXPECT_EQ(Json::parse(again.out)["samples"], 4);
    EXPECT_TRUE(bytes_of(scratch / "p.exr") == before) << "not written anew, with other times";
    // With other samples, another scene or damage, it is rendered again.
    for (const Words& more : {Words{"--samples", "2-6"}, Words{"--seed", "5"}})
        EXPECT_EQ(run(with(part, with(more, {"-q"})), here).code, 0);
    EXPECT_FALSE(bytes_of(scratch / "p.exr") == before);
    std::filesystem::resize_file(scratch / "p.exr", before.size() / 2);
    EXPECT_EQ(run(with(part, {"--seed", "5"}), here).err, "");
}

TEST(Shard, plan_shows_its_share) {
    const Words whole = {"plan", scene_file("mixed"), "--spp", "16", "-o", "a.exr", "--json", "-"};
    Words third = whole;
    third.insert(third.end(), {"--shard", "2/3"});
    const Json all = Json::parse(run(whole).out);
    const Json own = Json::parse(run(third).out);
    EXPECT_EQ(own["sample_ranges"], "1-13x3");
    EXPECT_FALSE(all.contains("sample_ranges"));
    EXPECT_EQ(all["rays"]["primary"].get<int>() / 16, own["rays"]["primary"].get<int>() / 5);
}

TEST(Iterations, are_samples_by_another_name) {
    const ScratchFolder scratch;
    const Words base = {"render", scene_file("one_voxel"), "--size", "16x9", "--reproducible", "-q", "-o"};
    const auto with = [&](const Words& more) {
        Words words = base;
        words.insert(words.end(), more.begin(), more.end());
        return run(words, {.folder = scratch.path()});
    };
    EXPECT_EQ(with({"a.exr", "--spp", "3"}).code, 0);
    EXPECT_EQ(with({"b.exr", "--iterations", "3"}).code, 0);
    EXPECT_EQ(with({"c.exr", "--iterations", "4"}).code, 0);
    EXPECT_TRUE(bytes_of(scratch / "a.exr") == bytes_of(scratch / "b.exr"));
    EXPECT_FALSE(bytes_of(scratch / "a.exr") == bytes_of(scratch / "c.exr"));
    const Ending both = with({"d.exr", "--iterations", "4", "--spp", "4"});
    EXPECT_EQ(both.code, 2);
    EXPECT_NE(both.err.find("--spp excludes --iterations"), std::string::npos) << both.err;
}

}  // namespace
}  // namespace voxilux::test

#include <gtest/gtest.h>

#include <fstream>

#include "formats/png.h"
#include "support/scratch_folder.h"
#include "tools/cli/child_process.h"
#include "tools/cli/words.h"

namespace voxilux::test {
namespace {

struct Refused {
    std::string name;
    Words words;
    std::string message;  // a part of standard error
};

void PrintTo(const Refused& refused, std::ostream* os) {
    *os << refused.name;
}

std::string name_of_refused(const testing::TestParamInfo<Refused>& test) {
    return test.param.name;
}

class UsageError : public testing::TestWithParam<Refused> {};

TEST_P(UsageError, ends_with_2_and_says_why) {
    const ScratchFolder scratch;
    const Ending ending = run(GetParam().words, {.folder = scratch.path()});
    EXPECT_EQ(ending.code, 2) << ending.err;
    EXPECT_EQ(ending.out, "");
    EXPECT_NE(ending.err.find(GetParam().message), std::string::npos) << ending.err;
    EXPECT_EQ(names_in(scratch.path()), Words{});
}

Words one_voxel_with(Words more) {
    return with({"render", scene_file("one_voxel"), "-o", "a.png"}, more);
}

Words bench_ao(Words more) {
    return with({"bench", "ao"}, more);
}

Words bench(Words more) {
    return with({"bench", "march"}, more);
}

INSTANTIATE_TEST_SUITE_P(
    flags, UsageError,
    testing::Values(
        Refused{"no_words", {}, "Usage: voxilux"},
        Refused{"unknown_subcommand", {"rendr"}, "there is no subcommand 'rendr'; did you mean 'render'?"},
        Refused{"flag_without_subcommand", {"--size", "1x1"}, "subcommand"},
        Refused{"unknown_flag", one_voxel_with({"--time-limt", "3s"}),
                "no flag --time-limt; did you mean '--time-limit'?"},
        Refused{"unknown_flag_with_value", one_voxel_with({"--spq=3"}),
                "no flag --spq; did you mean '--spp'?"},
        Refused{"no_input", {"render", "-o", "a.png"}, "INPUT is required"},
        Refused{"two_inputs", {"plan", scene_file("one_voxel"), "b.vox"}, "the plan is of one INPUT"},
        Refused{"size_without_value", one_voxel_with({"--size"}), "--size"},
        Refused{"size_not_a_size", one_voxel_with({"--size", "640"}), "--size: '640' is not WIDTHxHEIGHT"},
        Refused{"size_of_nothing", one_voxel_with({"--size", "0x9"}), "--size: '0x9' is not WIDTHxHEIGHT"},
        Refused{"crop_outside", one_voxel_with({"--crop", "0,0,641,9"}), "leaves the picture of 640x360"},
        Refused{"crop_not_a_window", one_voxel_with({"--crop", "1,2,3"}),
                "--crop: '1,2,3' is not X0,Y0,X1,Y1"},
        Refused{"spp_not_a_number", one_voxel_with({"--spp", "many"}), "--spp"},
        Refused{"spp_negative", one_voxel_with({"--spp", "-1"}), "--spp"},
        Refused{"sequence", one_voxel_with({"--sequence", "sobl"}),
                "--sequence: there is no 'sobl'; did you mean 'sobol'?"},
        Refused{"camera", one_voxel_with({"--camera", "frnt"}),
                "--camera: there is no 'frnt'; did you mean 'front'?"},
        Refused{"viewpoint_and_camera", one_voxel_with({"--viewpoint", "1,2,3,0,0,40", "--camera", "front"}),
                "--camera excludes --viewpoint"},
        Refused{"viewpoint_and_turntable",
                one_voxel_with({"--viewpoint", "1,2,3,0,0,40", "--turntable", "4"}),
                "--viewpoint excludes --turntable"},
        Refused{"two_backgrounds", one_voxel_with({"--background", "#102030", "--transparent"}),
                "--background excludes --transparent"},
        Refused{"background_and_alpha", one_voxel_with({"--alpha", "--background", "sky"}),
                "--background excludes --transparent"},
        Refused{"effect_unknown", one_voxel_with({"--effect", "fog=on"}),
                "there is no effect 'fog'; known are lens, voxels, spheres, specular, ao, sun, sky"},
        Refused{"effect_without_state", one_voxel_with({"--effect", "ao"}),
                "must be NAME=on, NAME=off or NAME=auto"},
        Refused{"technique_unknown", one_voxel_with({"--technique", "ao=hsh"}),
                "--technique: 'ao=hsh' names no technique of ao; did you mean 'hash'?"},
        Refused{"technique_of_unknown", one_voxel_with({"--technique", "indirct=none"}),
                "--technique: 'indirct=none' names no effect with techniques; did you mean 'indirect'?"},
        Refused{"technique_without_name", one_voxel_with({"--technique", "ao"}), "'ao' must be EFFECT=NAME"},
        Refused{"techniques_of_unlike_photons",
                one_voxel_with({"--technique", "caustics=photons", "--technique", "indirect=splatting"}),
                "'caustics=photons' excludes another technique of photons"},
        Refused{"time_limit", one_voxel_with({"--time-limit", "soon"}), "--time-limit: 'soon' is not a time"},
        Refused{"error", one_voxel_with({"--error", "0"}), "--error: '0' is not a share above 0"},
        Refused{"progress", one_voxel_with({"--progress", "loud"}),
                "--progress: 'loud' is not auto, never or json"},
        Refused{"frame", one_voxel_with({"--frame", "-1"}), "--frame: is not 0 or above"},
        Refused{"frames_backwards", one_voxel_with({"--frames", "3-1"}), "--frames: '3-1' must go upwards"},
        Refused{"frames_no_range", one_voxel_with({"--frames", "1..3"}),
                "--frames: '1..3' is not FIRST-LAST"},
        Refused{"frames_of_a_still", one_voxel_with({"--frames", "1-3"}), "--frames: the scene is still"},
        Refused{"frame_and_frames", one_voxel_with({"--frame", "1", "--frames", "1-3"}), "--frame"},
        Refused{"exposure", one_voxel_with({"--exposure", "nan"}),
                "--exposure: nan is not a number of stops, nor auto"},
        Refused{"tone", one_voxel_with({"--tone", "warm"}), "--tone: 'warm' is not filmic or plain"},
        Refused{"group_size", one_voxel_with({"--group-size", "8"}), "--group-size: '8' is not"},
        Refused{"device", one_voxel_with({"--device", "no such"}),
                "--device no such: no such device; there are: 0: "},
        Refused{"device_number", one_voxel_with({"--device", "99"}), "--device 99"},
        Refused{"output_ending", {"render", scene_file("one_voxel"), "-o", "a.jpg"}, "must be .exr or .png"},
        Refused{"bench_what", {"bench"}, "bench what? known: march, ao, photons"},
        Refused{"bench_unknown", {"bench", "marsh"}, "there is no bench 'marsh'; did you mean 'march'?"},
        Refused{"bench_unknown_flag", bench({"--extents", "32"}),
                "no flag --extents; did you mean '--extent'?"},
        Refused{"bench_extent", bench({"--extent", "32,40"}), "--extent: 40 is not a multiple of 16"},
        Refused{"bench_extent_too_large", bench({"--extent", "8192"}), "from 32 to 4096"},
        Refused{"bench_extent_no_number", bench({"--extent", "big"}), "--extent"},
        Refused{"bench_traversal", bench({"--traversal", "octree"}), "no traversal 'octree'"},
        Refused{"bench_rays", bench({"--rays", "short"}), "no rays 'short'; there are primary, ao, long"},
        Refused{"bench_size", bench({"--size", "64"}), "--size: '64' is not WIDTHxHEIGHT"},
        Refused{"bench_rounds", bench({"--rounds", "0"}), "--rounds: 0 is not from 1 to 1000"},
        Refused{"bench_build", bench({"--build", "gpu"}), "--build: 'gpu' is not cpu, device or both"},
        Refused{"bench_ao_variant", bench_ao({"--variant", "hsh"}),
                "no variant 'hsh'; there are brute, hash"},
        Refused{"bench_ao_motion", bench_ao({"--motion", "run"}),
                "no motion 'run'; there are still, pan, walk, floor"},
        Refused{"bench_ao_frames", bench_ao({"--frames", "0"}), "--frames: 0 is not from 1 to 4096"},
        Refused{"bench_ao_rounds", bench_ao({"--rounds", "-1"}), "--rounds: -1 is not from 1 to 1000"},
        Refused{"bench_ao_reference", bench_ao({"--reference", "65536"}),
                "--reference: 65536 is not from 1 to 65535"},
        Refused{"bench_ao_extent", bench_ao({"--extent", "40"}), "--extent: 40 is not a multiple of 16"},
        Refused{"bench_ao_size", bench_ao({"--size", "64"}), "--size: '64' is not WIDTHxHEIGHT"},
        Refused{"bench_photons_variant",
                {"bench", "photons", "--variant", "scater"},
                "no variant 'scater'; there are gather, no-roulette, classic, scatter"},
        Refused{"bench_photons_growth",
                {"bench", "photons", "--growth", "time"},
                "--growth: there is no 'time'; there are photons, size, iterations, none"},
        Refused{"bench_photons_rounds", {"bench", "photons", "--rounds", "0"}, "--rounds: 0 is not from 1"},
        Refused{
            "bench_photons_iterations", {"bench", "photons", "--iterations", "0"}, "--iterations: 0 is not"},
        Refused{
            "bench_photons_radius", {"bench", "photons", "--radius", "0"}, "--radius: '0' is neither auto"},
        Refused{"bench_photons_box", {"bench", "photons", "--box", "0,0,2,2"}, "--box: there is nothing"},
        Refused{"bench_device", bench({"--device", "no such"}), "--device no such: no such device"},
        Refused{"compare_one_image", {"compare", "a.exr"}, "TEST is required"},
        Refused{"compare_box", {"compare", "a", "b", "--box", "1,2,3"}, "--box: '1,2,3' is not X0,Y0,X1,Y1"},
        Refused{
            "compare_limit", {"compare", "a", "b", "--max-flip", "-1"}, "--max-flip: -1 is not 0 or above"}),
    name_of_refused);

Words with_exr(Words more) {
    return with({"render", scene_file("turntable"), "-o", "a.exr", "-o", "b.png"}, more);
}

Words classic_exr(Words more) {
    return with(
        {"render", scene_file("cornell"), "-D", "photons.classic=true", "--size", "8x8", "-o", "a.exr"},
        more);
}

INSTANTIATE_TEST_SUITE_P(
    parts, UsageError,
    testing::Values(
        Refused{"shard_0", with_exr({"--shard", "0/2"}), "--shard: '0/2' is not I/N with I from 1 to N"},
        Refused{"shard_over", with_exr({"--shard", "3/2"}), "--shard: '3/2' is not I/N"},
        Refused{"shard_open", with_exr({"--shard", "1/"}), "--shard: '1/' is not I/N"},
        Refused{"shard_more", with_exr({"--shard", "1/2x"}), "--shard: '1/2x' is not I/N"},
        Refused{"shard_signed", with_exr({"--shard", "-1/2"}), "--shard"},
        Refused{"shard_of_a_png", one_voxel_with({"--shard", "1/2"}),
                "--shard: its part of the picture goes into an EXR"},
        Refused{"shard_of_a_range", with_exr({"--shard", "1/2", "--frames", "1-3"}),
                "--shard is for one picture"},
        Refused{"shard_with_error", with_exr({"--shard", "1/2", "--error", "1%"}), "--shard and --error"},
        Refused{"shard_of_cells", with_exr({"--shard", "1/2", "--ao", "hash"}),
                "samples cannot be rendered in parts: pixels that share"},
        Refused{"shard_without_samples", with_exr({"--shard", "4/4", "--spp", "3"}),
                "--shard 4/4: a render of 3 samples has no such shard"},
        Refused{"samples_none", with_exr({"--samples", ""}),
                "--samples: '' is not a list of different samples"},
        Refused{"samples_twice", with_exr({"--samples", "0-3,2"}), "--samples: '0-3,2' is not"},
        Refused{"samples_backwards", with_exr({"--samples", "3-2"}), "--samples: '3-2' is not"},
        Refused{"samples_too_many", with_exr({"--samples", "0-1048576"}), "samples from 0 to 1048575"},
        Refused{"samples_over_spp", with_exr({"--samples", "2-4", "--spp", "4"}),
                "--samples 2-4: a render of 4 samples has 0 to 3"},
        Refused{"samples_and_shard", with_exr({"--samples", "0", "--shard", "1/2"}), "excludes"},
        Refused{"samples_of_a_png", one_voxel_with({"--samples", "0"}),
                "--samples: its part of the picture goes into an EXR"},
        Refused{"samples_of_a_range", with_exr({"--samples", "0", "--frames", "1-3"}),
                "--samples is for one picture"},
        Refused{"samples_with_error", with_exr({"--samples", "0", "--error", "1%"}), "--samples and --error"},
        Refused{"samples_of_cells", with_exr({"--samples", "0", "--ao", "hash"}),
                "samples cannot be rendered in parts: pixels that share"},
        Refused{"shards_of_too_many", with_exr({"--shard", "1/2", "--spp", "2000000"}),
                "--shard: sums are exact up to 1048576 samples"},
        Refused{"resume_of_a_png", one_voxel_with({"--resume"}), "checkpoints lie beside an EXR"},
        Refused{"resume_of_a_range", with_exr({"--resume", "--frames", "1-3"}),
                "--resume is for one picture"},
        Refused{"shard_of_technique", with_exr({"--shard", "1/2", "--technique", "ao=hash"}),
                "samples cannot be rendered in parts: pixels that share"},
        Refused{"shard_of_classic_radii", classic_exr({"--shard", "1/2"}),
                "samples cannot be rendered in parts: classic radii"},
        Refused{"resume_of_classic_radii", classic_exr({"--resume"}), "--resume: classic radii"},
        Refused{"resume_of_cells", with_exr({"--resume", "--ao", "hash"}), "--resume: pixels that share"},
        Refused{"checkpoint_of_a_png", one_voxel_with({"--checkpoint", "5"}),
                "checkpoints lie beside an EXR"},
        Refused{"checkpoint_below_0", with_exr({"--checkpoint=-1"}),
                "--checkpoint: -1 is not a number of seconds"},
        Refused{"merge_of_nothing", {"merge", "-o", "a.exr"}, "PART is required"},
        Refused{"merge_without_output", {"merge", "a.exr"}, "--output is required"},
        Refused{"merge_to_a_jpeg", {"merge", "a.exr", "-o", "b.jpg"}, "the ending must be .exr or .png"}),
    name_of_refused);

// Flags of effects and tools that do not exist yet must not be taken silently.
INSTANTIATE_TEST_SUITE_P(
    later, UsageError,
    testing::Values(Refused{"traversal", one_voxel_with({"--traversal", "octree"}), "no traversal 'octree'"},
                    Refused{"metric", one_voxel_with({"--metric", "flip"}), "no flag --metric"}),
    name_of_refused);

INSTANTIATE_TEST_SUITE_P(
    photons, UsageError,
    testing::Values(
        Refused{"photons_negative", one_voxel_with({"--photons=-1"}),
                "--photons: -1 is not in [0, 16777216]"},
        Refused{"photons_too_many", one_voxel_with({"--photons", "16777217"}),
                "--photons: 16777217 is not in [0, "},
        Refused{"photons_no_number", one_voxel_with({"--photons", "many"}), "--photons"},
        Refused{"radius_0", one_voxel_with({"--radius", "0"}),
                "--radius: '0' is neither auto nor a number of voxels"},
        Refused{"radius_negative", one_voxel_with({"--radius=-2"}), "--radius: '-2' is neither auto"},
        Refused{"radius_too_large", one_voxel_with({"--radius", "65537"}),
                "a number of voxels in (0, 65536]"},
        Refused{"radius_no_number", one_voxel_with({"--radius", "2x"}), "--radius: '2x' is neither auto"},
        Refused{"radius_nan", one_voxel_with({"--radius", "nan"}), "--radius: 'nan' is neither auto"},
        Refused{"alpha_0", one_voxel_with({"--alpha", "0"}), "--alpha: 0 is not in (0, 1]"},
        Refused{"alpha_too_large", one_voxel_with({"--alpha", "1.01"}), "--alpha: 1.01 is not in (0, 1]"},
        Refused{"alpha_nan", one_voxel_with({"--alpha", "nan"}), "--alpha: nan is not in (0, 1]"},
        Refused{"photons_before_the_file",
                {"plan", "no_such_file.toml", "--photons=-1"},
                "--photons: -1 is not in [0, "},
        Refused{"no_iterations", one_voxel_with({"--iterations", "0"}),
                "--iterations: 0 is not in [1, 4294967295]"},
        Refused{"iterations_and_spp", one_voxel_with({"--iterations", "2", "--spp", "2"}), "--spp"}),
    name_of_refused);

// Flags have the ranges of the keys that they set.
INSTANTIATE_TEST_SUITE_P(ranges, UsageError,
                         testing::Values(Refused{"no_samples", one_voxel_with({"--spp", "0"}),
                                                 "--spp: 0 is not in [1, 4294967295]"},
                                         Refused{"no_rays", one_voxel_with({"--ao-rays", "0"}),
                                                 "--ao-rays: 0 is not in [1, 65535]"},
                                         Refused{"too_many_rays", one_voxel_with({"--ao-rays", "4294967295"}),
                                                 "--ao-rays: 4294967295 is not in [1, "},
                                         Refused{"no_reach", one_voxel_with({"--ao-radius", "-3"}),
                                                 "--ao-radius: -3 is not in (0, 65536]"},
                                         Refused{"endless_reach", one_voxel_with({"--ao-radius", "inf"}),
                                                 "--ao-radius: inf is not in (0, 65536]"}),
                         name_of_refused);

TEST(UsageErrorOf, unnamed_picture_never_replaces_a_file) {
    const ScratchFolder scratch;
    write_text(scratch / "one_voxel.png", "kept");
    const Ending ending = run({"render", scene_file("one_voxel")}, {.folder = scratch.path()});
    EXPECT_EQ(ending.code, 2);
    EXPECT_NE(ending.err.find("-o one_voxel.png overwrites it"), std::string::npos) << ending.err;
    EXPECT_EQ(bytes_of(scratch / "one_voxel.png"), "kept");
}

class InputRefused : public testing::TestWithParam<Refused> {};

TEST_P(InputRefused, ends_with_3_and_says_where) {
    const ScratchFolder scratch;
    write_text(scratch / "broken.vox", "VOX \x96");
    write_text(scratch / "broken.toml", "[sun]\nelevaton = 3\n");
    write_text(scratch / "broken.exr", "no picture");
    write_text(scratch / "broken.png", "no picture");
    write_text(scratch / "broken.obj", "v 0 0 0");
    const Words before = names_in(scratch.path());
    const Ending ending = run(GetParam().words, {.folder = scratch.path()});
    EXPECT_EQ(ending.code, 3) << ending.err;
    EXPECT_EQ(ending.out, "");
    EXPECT_NE(ending.err.find(GetParam().message), std::string::npos) << ending.err;
    EXPECT_EQ(names_in(scratch.path()), before);
}

INSTANTIATE_TEST_SUITE_P(
    files, InputRefused,
    testing::Values(
        Refused{"absent_vox", {"render", "no.vox", "-o", "a.png"}, "no.vox"},
        Refused{"absent_toml", {"plan", "no.toml"}, "no.toml"},
        Refused{"folder", {"render", ".", "-o", "a.png"}, "."},
        Refused{"broken_vox", {"render", "broken.vox", "-o", "a.png"}, "broken.vox"},
        Refused{"broken_toml", {"render", "broken.toml", "-o", "a.png"}, "broken.toml:2:1"},
        Refused{"unknown_kind", {"render", "broken.stp", "-o", "a.png"}, "broken.stp: unknown kind"},
        Refused{"unknown_key", one_voxel_with({"-D", "sun.elevaton=3"}), "did you mean 'elevation'?"},
        Refused{"picture_of_nothing", one_voxel_with({"-D", "render.size=[0, 9]"}), "size"},
        Refused{"too_many_pixels", one_voxel_with({"--size", "65536x65536"}), "over 2^32 pixels"},
        Refused{"info_broken_vox", {"info", "broken.vox"}, "broken.vox"},
        Refused{"info_broken_exr", {"info", "broken.exr"}, "broken.exr"},
        Refused{"info_broken_png", {"info", "broken.png"}, "broken.png"},
        Refused{"info_unknown_kind", {"info", "broken.stp"}, "info reads .vox, .toml, .exr and .png"},
        Refused{"info_broken_mesh", {"info", "broken.obj"}, "broken.obj"},
        Refused{"render_absent_mesh", {"render", "no.glb", "-o", "a.png"}, "no.glb"},
        Refused{"convert_broken_vox", {"convert", "broken.vox", "a.vox"}, "broken.vox"},
        Refused{"convert_unknown_kind", {"convert", "broken.stp", "a.vox"}, ".qb, .kv6, .vxl, .binvox"},
        Refused{"bench_absent", {"bench", "march", "no.vox"}, "no.vox"},
        Refused{"bench_ao_absent", {"bench", "ao", "no.vox"}, "no.vox"},
        Refused{"compare_broken", {"compare", "broken.exr", "broken.png"}, "broken.exr"}),
    name_of_refused);

TEST(InputRefusedOf, pictures_of_two_sizes_cannot_be_compared) {
    const ScratchFolder scratch;
    write_png(scratch / "a.png", make_image(2, 2, Words{"R", "G", "B"}));
    write_png(scratch / "b.png", make_image(2, 3, Words{"R", "G", "B"}));
    EXPECT_EQ(run({"compare", scratch / "a.png", scratch / "b.png"}).code, 3);
}

}  // namespace
}  // namespace voxilux::test

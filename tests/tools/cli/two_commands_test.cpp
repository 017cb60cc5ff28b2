// Two ways to ask for the same thing give the same answer.

#include <gtest/gtest.h>

#include "support/scratch_folder.h"
#include "support/vox_builder.h"
#include "tools/cli/child_process.h"
#include "tools/cli/words.h"

namespace voxilux::test {
namespace {

// A block of a medium beside one whose roughness is not a number.
std::string vox_of_a_medium(const ScratchFolder& scratch) {
    using namespace vox_builder;
    const std::string file = scratch / "medium.vox";
    write_text(file, file_text(size_chunk(2, 1, 1) + voxels_chunk({{0, 0, 0, 1}, {1, 0, 0, 2}}) +
                               record("MATL", 1, {{"_type", "_media"}}) +
                               record("MATL", 2, {{"_type", "_metal"}, {"_rough", "much"}})));
    return file;
}

TEST(SceneMessages, are_the_same_in_render_plan_and_info) {
    const ScratchFolder scratch;
    const std::string file = vox_of_a_medium(scratch);
    const std::string medium = "a medium is shown as an opaque diffuse surface ('palette 1')";
    const std::string number = "material 2: _rough is 'much', not a number: ignored";
    const Ending render = run({"render", file, "--size", "8x8", "--spp", "1", "-o", scratch / "a.png"});
    const Ending plan = run({"plan", file, "-o", scratch / "a.png"});
    const Ending info = run({"info", file});
    for (const Ending& ending : {render, plan, info}) {
        EXPECT_EQ(ending.code, 0) << ending.err;
        const std::string said = ending.out + ending.err;
        EXPECT_NE(said.find(medium), std::string::npos) << said;
        EXPECT_NE(said.find(number), std::string::npos) << said;
    }
}

TEST(SceneMessages, are_none_for_materials_that_are_simulated) {
    const ScratchFolder scratch;
    using namespace vox_builder;
    const std::string file = scratch / "plain.vox";
    write_text(file, file_text(size_chunk(1, 1, 1) + voxels_chunk({{0, 0, 0, 1}}) +
                               record("MATL", 2, {{"_type", "_media"}})));  // of no voxel
    const Ending info = run({"info", file});
    EXPECT_EQ(info.out.find("medium"), std::string::npos) << info.out;
}

// The same pixels with the same random numbers, but only some of them.
TEST(CompareCrop, is_in_the_window_that_both_images_have) {
    const ScratchFolder scratch;
    const std::string whole = scratch / "whole.exr", crop = scratch / "crop.exr",
                      other = scratch / "other.exr";
    const Words words = {"render", scene_file("mixed"), "--size", "32x18", "--spp", "2",
                         "-q",     "--reproducible"};
    ASSERT_EQ(run(with(words, {"-o", whole})).code, 0);
    ASSERT_EQ(run(with(words, {"-o", crop, "--crop", "8,4,20,12"})).code, 0);
    ASSERT_EQ(run(with(words, {"-o", other, "--crop", "8,4,20,12", "--seed", "5"})).code, 0);
    const Ending same = run({"compare", whole, crop, "--json", "-"});
    EXPECT_EQ(same.code, 0) << same.err;
    EXPECT_NE(same.err.find("compared in the window 8,4,20,12 of both"), std::string::npos) << same.err;
    EXPECT_EQ(Json::parse(same.out)["rmse"], 0.0);
    EXPECT_EQ(Json::parse(same.out)["flip"], 0.0);
    EXPECT_GT(Json::parse(run({"compare", whole, other, "--json", "-"}).out)["rmse"], 0.0)
        << "negative control";
    EXPECT_EQ(run({"compare", whole, crop, "--strict"}).code, 3);
    EXPECT_EQ(run({"compare", whole, whole, "--strict"}).err, "");
    EXPECT_EQ(run({"compare", whole, crop, "--box", "0,0,4,4"}).code, 3) << "outside the crop window";
}

}  // namespace
}  // namespace voxilux::test

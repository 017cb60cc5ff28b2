// A render of many samples needs as much memory as one of few: only sums are kept.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/scratch_folder.h"
#include "tools/cli/child_process.h"
#include "tools/cli/words.h"

namespace voxilux::test {
namespace {

constexpr int kFewSamples = 20;
constexpr int kManySamples = 220;
// MiB. A shader that is compiled anew for each sample leaves at least 0.14 MiB each time, 28 in all.
constexpr double kSteady = 8.0;

double peak_mib(const Words& scene, int samples) {
    const ScratchFolder scratch;
    Words words{"render", "--size", "32x32", "--json", "-", "-o", scratch / "a.exr"};
    words.insert(words.end(), scene.begin(), scene.end());
    words.insert(words.end(), {"--spp", std::to_string(samples)});
    const Ending ending = run(words);
    EXPECT_EQ(ending.code, 0) << ending.err;
    return nlohmann::json::parse(ending.out)["peak_rss_mib"];
}

// The first render makes the pipelines, so that the second one only finds them.
double growth_mib(const Words& scene) {
    (void)peak_mib(scene, 1);
    return peak_mib(scene, kManySamples) - peak_mib(scene, kFewSamples);
}

TEST(SteadyMemory, of_sun_and_occlusion) {
    EXPECT_LT(growth_mib({scene_file("first_light")}), kSteady);
}

TEST(SteadyMemory, of_several_rays_of_occlusion) {
    EXPECT_LT(growth_mib({scene_file("wall_corner"), "--ao-rays", "3"}), kSteady);
}

TEST(SteadyMemoryNightly, of_every_structure) {
    for (const char* traversal : {"dda", "brick4", "brick8", "naadf", "deep", "wide"})
        EXPECT_LT(growth_mib({scene_file("first_light"), "--traversal", traversal}), kSteady) << traversal;
}

TEST(SteadyMemoryNightly, of_every_sequence) {
    for (const char* sequence : {"sobol", "halton", "white"})
        EXPECT_LT(growth_mib({scene_file("turntable"), "--sequence", sequence}), kSteady) << sequence;
}

TEST(SteadyMemory, of_cells_of_occlusion) {
    EXPECT_LT(growth_mib({scene_file("first_light"), "--ao", "hash"}), kSteady);
}

TEST(SteadyMemoryNightly, of_emitters_and_photons) {
    for (const char* scene : {"emitters", "glass_block"})
        EXPECT_LT(growth_mib({scene_file(scene), "--photons", "256"}), kSteady) << scene;
}

// Negative control: the memory of a larger picture is noticed.
TEST(SteadyMemory, sees_what_a_larger_picture_takes) {
    const Words scene{scene_file("first_light")};
    Words larger = scene;
    larger.insert(larger.end(), {"--size", "480x480"});
    EXPECT_GT(peak_mib(larger, 1) - peak_mib(scene, 1), kSteady);
}

}  // namespace
}  // namespace voxilux::test

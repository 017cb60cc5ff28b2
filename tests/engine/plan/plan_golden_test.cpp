#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "engine/plan/plan_scenes.h"
#include "jobs/report.h"

namespace voxilux {
namespace {

namespace fs = std::filesystem;

// Set it to anything and run this binary: the plans of today become the expected ones.
constexpr const char* kBless = "VOXILUX_BLESS";

fs::path golden_folder() {
    return fs::path(VX_SOURCE_DIR) / "tests" / "engine" / "plan" / "golden";
}

std::string text_of(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

// What the plan decides: the text without what follows from recordings, because other tests compare that.
std::string decisions_of(const RenderPlan& plan) {
    std::istringstream lines(describe(plan));
    std::string text;
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("pass ") && !line.starts_with("buffer ") && !line.starts_with("memory "))
            text += line + "\n";
    }
    return text;
}

class PlanGolden : public testing::TestWithParam<std::string> {};

TEST_P(PlanGolden, plan_is_the_expected_text) {
    const std::string plan = decisions_of(test::plan_of(test::repository_scene(GetParam())));
    const fs::path golden = golden_folder() / (GetParam() + ".txt");
    if (std::getenv(kBless) != nullptr) std::ofstream(golden) << plan;
    EXPECT_EQ(plan, text_of(golden)) << "when the new plan is right, run this test once with " << kBless
                                     << "=1";
}

TEST_P(PlanGolden, plan_is_pure) {
    const Scene scene = test::repository_scene(GetParam());
    const RenderPlan once = test::plan_of(scene);
    EXPECT_EQ(once, test::plan_of(scene));
    EXPECT_EQ(once, test::plan_of(test::repository_scene(GetParam())));
    EXPECT_EQ(plan_json(scene, once).dump(), plan_json(scene, test::plan_of(scene)).dump());
}

TEST_P(PlanGolden, plan_that_differs_is_told_apart) {
    Scene scene = test::repository_scene(GetParam());
    const RenderPlan plan = test::plan_of(scene);
    ++scene.settings.spp;
    EXPECT_NE(plan, test::plan_of(scene));
    EXPECT_NE(describe(plan), describe(test::plan_of(scene)));
}

INSTANTIATE_TEST_SUITE_P(scenes, PlanGolden, testing::ValuesIn(test::scene_names()),
                         [](const auto& test) { return test.param; });

TEST(PlanGoldenFolder, golden_without_a_scene_is_forgotten) {
    for (const auto& entry : fs::directory_iterator(golden_folder()))
        EXPECT_TRUE(fs::exists(test::scene_path(entry.path().stem().string()))) << entry.path();
}

// plan_json must say what the plan says, for every key that scripts rely on.
TEST(PlanJson, plan_has_the_promised_keys) {
    const Scene scene = test::repository_scene("mixed");
    const RenderPlan plan = test::plan_of(scene);
    const nlohmann::ordered_json json = plan_json(scene, plan);
    EXPECT_EQ(json.at("command"), "plan");
    EXPECT_EQ(json.at("size"), (nlohmann::ordered_json{plan.settings.size.x, plan.settings.size.y}));
    ASSERT_EQ(json.at("effects").size(), kEffectCount);
    EXPECT_EQ(json["effects"][1].at("name"), "voxels");
    EXPECT_EQ(json["effects"][1].at("on"), true);
    EXPECT_EQ(json["effects"][1].at("reason"), plan.effects[1].reason);
    const Footprint needs = footprint(plan);
    ASSERT_EQ(json.at("passes").size(), needs.passes.size());
    EXPECT_EQ(json["passes"][0].at("label"), needs.passes[0].label);
    EXPECT_EQ(json["passes"][0].at("count"), needs.passes[0].count);
    ASSERT_EQ(json.at("memory").size(), needs.buffers.size());
    EXPECT_EQ(json["memory"][0].at("buffer"), needs.buffers[0].buffer);
    EXPECT_EQ(json["memory"][0].at("bytes"), needs.buffers[0].bytes);
    EXPECT_TRUE(json.contains("forecast"));
}

}  // namespace
}  // namespace voxilux

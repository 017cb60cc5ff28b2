#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "formats/scene_toml.h"
#include "plan/techniques.h"
#include "scene/facts.h"

namespace voxilux {
namespace {

// "voxels, ao, sky": the effects that a picture of colour alone needs.
std::string effects_of(const Scene& scene) {
    std::string names;
    for (const EffectState& state : decide_effects(measure_scene(scene), with_techniques({}, scene.settings)))
        if (state.on) names += (names.empty() ? "" : ", ") + std::string(name_of(state.effect));
    return names;
}

// What the comment at the head of a scene says: "# Plan: voxels, ao, sky. No sun: ...".
std::string promised_effects(const std::filesystem::path& path) {
    std::ifstream in(path);
    for (std::string line; std::getline(in, line) && line.starts_with("# ");)
        if (line.starts_with("# Plan: ")) return line.substr(8, line.find('.') - 8);
    return "no '# Plan: ' line at the head of the file";
}

TEST(SceneComment, plan_is_what_the_file_promises) {
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(VX_SOURCE_DIR) / "scenes")) {
        if (entry.path().extension() != ".toml") continue;
        EXPECT_EQ(effects_of(load_scene(entry.path())), promised_effects(entry.path()))
            << entry.path().filename();
    }
}

// Negative control: with the sun switched off the promise of a sunny scene must fail.
TEST(SceneComment, changed_scene_breaks_the_promise) {
    const auto path = std::filesystem::path(VX_SOURCE_DIR) / "scenes/one_voxel.toml";
    EXPECT_NE(effects_of(load_scene(path, {.overrides = {"sun.on=false"}})), promised_effects(path));
}

}  // namespace
}  // namespace voxilux

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "engine/plan/plan_scenes.h"

namespace voxilux {
namespace {

constexpr std::uint64_t kMiB = std::uint64_t{1} << 20;

// The message that refuses a plan, or "accepted".
std::string refusal(const Scene& scene, const PlanRequest& request, const DeviceLimits& limits,
                    ExitCode code) {
    try {
        (void)prepare_scene(scene, request, limits);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), code) << error.what();
        return error.what();
    }
    return "accepted";
}

std::string memory_refusal(const Scene& scene, const PlanRequest& request, const DeviceLimits& limits = {}) {
    return refusal(scene, request, limits, ExitCode::out_of_memory);
}

PlanRequest with_budget(std::uint64_t bytes) {
    PlanRequest request = test::exr_request();
    request.memory_budget_bytes = bytes;
    return request;
}

std::uint64_t largest_buffer(const RenderPlan& plan) {
    return std::ranges::max(footprint(plan).buffers, {}, &PlannedBuffer::bytes).bytes;
}

TEST(PlanMemory, total_is_the_sum_of_the_buffers) {
    const Footprint needs = footprint(test::plan_of(test::repository_scene("mixed")));
    std::uint64_t sum = 0;
    for (const PlannedBuffer& planned : needs.buffers)
        sum += planned.bytes;
    EXPECT_EQ(needs.total_bytes(), sum);
    EXPECT_GT(sum, 0u);
}

TEST(PlanMemory, budget_is_kept_to_the_byte) {
    const Scene scene = test::repository_scene("mixed");
    const std::uint64_t needed = footprint(test::plan_of(scene)).total_bytes();
    EXPECT_EQ(memory_refusal(scene, with_budget(needed)), "accepted");
    EXPECT_NE(memory_refusal(scene, with_budget(needed - 1)), "accepted");
    EXPECT_EQ(memory_refusal(scene, with_budget(0)), "accepted") << "0 is no limit";
}

TEST(PlanMemory, budget_refusal_names_the_sums_and_the_largest_buffer) {
    const Scene scene = test::repository_scene("night", {"render.size=[1024, 1024]"});
    const std::string message = memory_refusal(scene, with_budget(50 * kMiB));
    EXPECT_NE(message.find("MiB on the device, over the budget of 50 MiB"), std::string::npos) << message;
    // A start of a path, 64 bytes, for each of 2^20 pixels.
    EXPECT_NE(message.find("the largest buffer is 'path.starts' with 64 MiB"), std::string::npos) << message;
}

TEST(PlanMemory, binding_limit_is_kept_to_the_byte) {
    const Scene scene = test::repository_scene("one_voxel");
    const std::uint64_t largest = largest_buffer(test::plan_of(scene));
    EXPECT_EQ(memory_refusal(scene, test::exr_request(), {.max_binding_bytes = largest}), "accepted");
    EXPECT_NE(memory_refusal(scene, test::exr_request(), {.max_binding_bytes = largest - 1}), "accepted");
    EXPECT_NE(memory_refusal(scene, test::exr_request(), {.max_allocation_bytes = largest - 1}), "accepted");
}

TEST(PlanMemory, buffer_over_the_device_limit_is_named_with_its_device_and_its_cure) {
    const DeviceLimits tiny{.max_binding_bytes = 4096, .name = "tiny"};
    EXPECT_EQ(
        memory_refusal(test::repository_scene("one_voxel", {"render.size=[64, 64]"}), PlanRequest{}, tiny),
        "buffer 'primary.hits' needs 163840 bytes but tiny takes 4096 at most; make the picture smaller");
}

TEST(PlanMemory, world_over_the_device_limit_asks_for_a_smaller_scene) {
    const DeviceLimits tiny{.max_allocation_bytes = 4096, .name = "tiny"};
    const std::string message =
        memory_refusal(test::repository_scene("plane", {"render.size=[8, 8]"}), PlanRequest{}, tiny);
    EXPECT_NE(message.find("buffer 'world."), std::string::npos) << message;
    EXPECT_NE(message.find("make the scene smaller"), std::string::npos) << message;
}

// The world and the scratch memory of its growth are reached by address; its other buffers are bound.
TEST(PlanMemory, world_may_pass_the_binding_limit_and_nothing_else_may) {
    const Scene scene = test::repository_scene("one_voxel");
    const SceneFacts facts = measure_scene(scene);
    const auto refusal_of = [&](const WorldFacts& world) -> std::string {
        try {
            (void)plan_within_memory(scene, facts, world, PlanRequest{}, DeviceLimits{});
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::out_of_memory);
            return error.what();
        }
        return "accepted";
    };
    const std::uint64_t most = DeviceLimits{}.max_allocation_bytes;
    WorldFacts world{.size = glm::ivec3(4096), .root_bytes = most, .node_bytes = most, .leaf_bytes = most};
    world.growth = {.home_bytes = 128 * kMiB, .grown_bytes = most, .levels = {{.log2 = 2, .cells = 64}}};
    EXPECT_EQ(refusal_of(world), "accepted");
    WorldFacts over = world;
    over.leaf_bytes += 4;
    EXPECT_EQ(refusal_of(over),
              "buffer 'world.leaves' needs 2147483652 bytes but lavapipe takes 2147483648 at most; make the "
              "scene smaller");
    over = world;
    over.growth.home_bytes += 8;
    EXPECT_EQ(refusal_of(over),
              "buffer 'world.homes' needs 134217736 bytes but lavapipe takes 134217728 at most; make the "
              "scene smaller");
}

// Pictures of every shape, up to the largest that a shader can number, keep each buffer below 128 MiB.
TEST(PlanMemory, buffers_of_large_pictures_stay_below_the_binding_limit) {
    Scene scene = test::repository_scene("one_voxel");
    for (const glm::ivec2 size :
         {glm::ivec2{16384, 16}, {16, 16384}, {16384, 16384}, {65535, 65536}, {100000, 3}}) {
        scene.settings.size = size;
        const RenderPlan plan = test::plan_of(scene);
        EXPECT_LE(largest_buffer(plan), 128 * kMiB) << size.x << "x" << size.y;
        EXPECT_GE(std::uint64_t{plan.film_tile_rows} * plan.film_tile_count,
                  static_cast<std::uint64_t>(size.y));
        EXPECT_LT(std::uint64_t{plan.film_tile_rows} * (plan.film_tile_count - 1),
                  static_cast<std::uint64_t>(size.y));
    }
}

TEST(PlanSettings, crop_outside_the_picture_or_of_nothing_is_refused) {
    const Scene scene;  // 640 x 360
    const auto crop = [&](glm::ivec2 first, glm::ivec2 end) {
        PlanRequest request;
        request.crop = PixelWindow{first, end};
        return refusal(scene, request, {}, ExitCode::usage);
    };
    EXPECT_EQ(crop({0, 0}, {640, 360}), "accepted");
    EXPECT_EQ(crop({639, 359}, {640, 360}), "accepted");
    EXPECT_EQ(crop({0, 0}, {641, 360}), "the crop 0,0,641,360 is empty or leaves the picture of 640x360");
    EXPECT_NE(crop({0, 0}, {640, 361}), "accepted");
    EXPECT_NE(crop({-1, 0}, {640, 360}), "accepted");
    EXPECT_NE(crop({0, -1}, {640, 360}), "accepted");
    EXPECT_NE(crop({5, 5}, {5, 6}), "accepted");
    EXPECT_NE(crop({5, 5}, {6, 4}), "accepted");
}

struct BadSetting {
    const char* message;
    void (*set)(RenderSettings&);
};

TEST(PlanSettings, setting_out_of_range_is_refused_with_its_value) {
    const std::vector<BadSetting> bad = {
        {"picture size 0x360: both sides must be at least 1", [](RenderSettings& s) { s.size.x = 0; }},
        {"picture size 640x-1: both sides must be at least 1", [](RenderSettings& s) { s.size.y = -1; }},
        {"picture size 65536x65536: over 2^32 pixels",
         [](RenderSettings& s) {
             s.size = {65536, 65536};
         }},
        {"spp must be at least 1", [](RenderSettings& s) { s.spp = 0; }},
        {"ao_rays must be at least 1", [](RenderSettings& s) { s.ao_rays = 0; }},
        {"ao_radius 0 must be above 0", [](RenderSettings& s) { s.ao_radius = 0.0f; }},
        {"ao_radius nan must be above 0", [](RenderSettings& s) { s.ao_radius = std::nanf(""); }},
    };
    for (const BadSetting& row : bad) {
        Scene scene;
        row.set(scene.settings);
        EXPECT_EQ(refusal(scene, PlanRequest{}, {}, ExitCode::input_refused), row.message);
    }
    EXPECT_EQ(refusal(Scene{}, PlanRequest{}, {}, ExitCode::input_refused), "accepted");
}

// As many photons as pixels, unless the device's store has no room for them. If more are asked for, they are
// traced in runs.
TEST(PlanPhotons, large_picture_takes_as_many_photons_as_fit) {
    const Scene scene = test::repository_scene("cornell", {"render.size=[4096, 4096]"});
    const RenderPlan plan = test::plan_of(scene);
    EXPECT_GT(plan.photons.count(), 100000u);
    EXPECT_LT(plan.photons.count(), 4096u * 4096u);
    Scene greedy = scene;
    greedy.settings.photons.count = 4096 * 4096;
    const RenderPlan in_runs = test::plan_of(greedy);
    EXPECT_EQ(plan.photons.run_count(), 1u);
    EXPECT_EQ(in_runs.photons.count(), 4096u * 4096u);
    EXPECT_GT(in_runs.photons.run_count(), 1u);
}

TEST(PlanPhotons, runs_shrink_to_a_budget) {
    Scene scene = test::repository_scene("cornell", {"render.size=[64, 64]"});
    scene.settings.photons.count = 1u << 20;
    const std::uint64_t most = footprint(test::plan_of(scene)).total_bytes();
    PlanRequest request{.memory_budget_bytes = most / 3};
    EXPECT_EQ(refusal(scene, request, {}, ExitCode::out_of_memory), "accepted");
    request.memory_budget_bytes = 1u << 20;
    EXPECT_NE(refusal(scene, request, {}, ExitCode::out_of_memory), "accepted");
}

TEST(PlanNotes, what_the_picture_lacks_is_said) {
    const auto notes_of = [](const char* technique) {
        return test::plan_of(test::repository_scene("spheres", {"material.red.surface=\"glass\"", technique}))
            .notes;
    };
    EXPECT_TRUE(notes_of("technique.indirect=auto").empty());
    EXPECT_EQ(notes_of("technique.indirect=photons"),
              std::vector<std::string>{"glass and mirrors block the light of the sky as walls do"});
    EXPECT_EQ(notes_of("technique.caustics=paths"),
              std::vector<std::string>{
                  "sunlight by way of spheres of metal and glass is found by chance: it is noisy"});
    EXPECT_TRUE(test::plan_of(test::repository_scene("night")).notes.empty());
}

// The bound of the series: half of the light comes back at each bounce, so all bounces give as much again.
TEST(PlanNotes, light_between_surfaces_that_is_left_out_has_a_bound) {
    const auto words_without = [](Effect effect, const char* surface) {
        PlanRequest request;
        request.effects.switches[effect] = Switch::off;
        const Scene scene =
            test::repository_scene("one_voxel", {"material.white.albedo=[0.5, 0.2, 0.1]", surface});
        return test::plan_of(scene, request).without;
    };
    const char* matt = "material.white.surface=\"diffuse\"";
    const std::string words = ", which the claimed error does not count";
    EXPECT_EQ(
        words_without(Effect::indirect, matt),
        std::vector<std::string>{"indirect" + words + ": at most 100 % of the strongest direct irradiance"});
    EXPECT_EQ(words_without(Effect::sun, matt), std::vector<std::string>{"sun" + words});
    EXPECT_EQ(words_without(Effect::indirect, "material.white.surface=\"metal\"").front(),
              "indirect" + words);
    EXPECT_TRUE(words_without(Effect::caustics, matt).empty()) << "the scene has none";
}

}  // namespace
}  // namespace voxilux

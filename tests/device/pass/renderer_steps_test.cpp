// The renderer as a window drives it, against a fresh one.

#include <gtest/gtest.h>

#include <map>

#include "base/error.h"
#include "film/film.h"
#include "passes/plane.h"
#include "renderer/renderer.h"
#include "support/device_fixture.h"
#include "support/edited_scene.h"
#include "support/light_scenes.h"
#include "support/traversal_name.h"

namespace voxilux::test {
namespace {

constexpr std::uint32_t kSamples = 3;

PlanRequest with_aov() {
    return {.effects = {.wants_aov = true}};
}

Renderer& prepared(Renderer& renderer, const Scene& scene, const PlanRequest& request = with_aov()) {
    renderer.prepare_editable(scene, request);
    return renderer;
}

ExecutorOptions poisoned() {
    return {.poison_transients = true};
}

// Renders in the smallest possible steps.
FilmSums film_after(Renderer& renderer, std::uint32_t samples) {
    while (renderer.film().position().samples < samples)
        (void)renderer.step(0.0);
    return renderer.read_film();
}

// The film of a fresh renderer, in steps of the size that suits the device.
FilmSums fresh_film(const Scene& scene, std::uint32_t samples = kSamples,
                    const PlanRequest& request = with_aov()) {
    Renderer renderer(test_device(), poisoned());
    renderer.prepare(scene, request);
    while (renderer.film().position().samples < samples)
        (void)renderer.step_tile();
    return renderer.read_film();
}

const Camera kHere = camera_towards({20, -40, 25}, {5, 0, 0});
const Camera kThere = camera_towards({-14, -25, 18}, {0, 2, 1});

// Two boxes under sun and sky on 40 x 24 pixels; a third material lights up.
Scene yard() {
    Scene scene = white_scene();
    scene.settings = {.size = {40, 24}, .spp = kSamples};
    scene.settings.ao.method = AoMethod::brute;
    add_diffuse(scene, 0.5f);
    add_emitter(scene, 4.0f);
    add_box(scene, {-8, -8, -1}, {8, 8, 0});
    add_box(scene, {-8, 2, 0}, {3, 4, 9}, 1);
    scene.sun.irradiance = glm::vec3(2.0f);
    scene.camera = kHere;
    return scene;
}

Scene yard_of_cells() {
    Scene scene = yard();
    scene.settings.ao.method = AoMethod::hash;
    return scene;
}

// A room with a light, and a glass sphere for caustics.
Scene lit_room() {
    Scene scene = dark_scene(24, 500, 1.0);
    add_room(scene, {8, 8, 6}, add_diffuse(scene, 0.7f));
    const std::uint16_t emitter = add_emitter(scene, 6.0f);
    add_box(scene, {3, 3, 5}, {5, 5, 6}, emitter);
    scene.spheres = {{{4.0, 4.0, 1.5}, 1.0, add_glass(scene, 1.5f)}};
    scene.camera = camera_towards({1, 1, 3}, {6, 6, 2}, 70.0);
    return scene;
}

Scene per_pixel_radii() {
    Scene scene = lit_room();
    scene.settings.photons.classic = true;
    return scene;
}

// Photons that start towards the glass.
Scene caustics_alone() {
    Scene scene = lit_room();
    scene.settings.photons.indirect = false;
    return scene;
}

Scene spheres() {
    Scene scene = yard();
    scene.models.clear();
    scene.instances.clear();
    scene.spheres = {{{0.5, 0.25, 0.0}, 3.0, 0}, {{6.0, 1.0, 1.0}, 2.0, 1}};
    return scene;
}

// Settings that ask for another technique.
RenderSettings other_technique(RenderSettings settings) {
    settings.ao.method = settings.ao.method == AoMethod::hash ? AoMethod::brute : AoMethod::hash;
    settings.photons.scatter = !settings.photons.scatter;
    settings.photons.classic = false;
    settings.ao_rays = 2;
    return settings;
}

struct Case {
    const char* name;
    Scene (*scene)();
};

void PrintTo(const Case& one, std::ostream* out) {
    *out << one.name;
}

class RendererSteps : public testing::TestWithParam<Case> {
  protected:
    Scene scene_ = GetParam().scene();
};

TEST_P(RendererSteps, any_cut_into_steps_gives_the_same_film) {
    Renderer renderer(test_device(), poisoned());
    EXPECT_EQ(film_after(prepared(renderer, scene_), kSamples), fresh_film(scene_));
}

TEST_P(RendererSteps, changes_between_steps_end_as_a_fresh_render) {
    Renderer renderer(test_device(), poisoned());
    prepared(renderer, scene_);
    (void)renderer.step(0.0);
    renderer.set_camera(kThere);
    (void)renderer.step(0.002);
    (void)renderer.display({});
    RenderSettings settings = scene_.settings;
    settings.size = {31, 17};
    renderer.change(settings, {});
    (void)film_after(renderer, 1);
    const std::vector<BoxEdit> edits = {{.box = {{1, 1, 1}, {3, 4, 3}}, .material = 1},
                                        {.box = {{2, 2, 1}, {3, 3, 4}}}};
    renderer.edit(edits);
    (void)renderer.step(0.0);
    renderer.change(other_technique(scene_.settings), with_aov());
    (void)film_after(renderer, 2);
    renderer.set_camera(*scene_.camera);
    (void)renderer.step(0.001);
    renderer.change(scene_.settings, with_aov());

    const Scene edited = edited_scene(scene_, edits);
    EXPECT_EQ(film_after(renderer, kSamples), fresh_film(edited));
    EXPECT_NE(renderer.read_film(), fresh_film(scene_)) << "the edits show";
}

class RendererLens : public RendererSteps {};

TEST_P(RendererLens, other_projection_ends_as_a_fresh_render) {
    Renderer renderer(test_device(), poisoned());
    prepared(renderer, scene_);
    (void)renderer.step(0.0);
    Scene parallel = scene_;
    parallel.camera = kThere;
    parallel.camera->projection = Projection::orthographic;
    parallel.camera->pixels_per_voxel = 2.5;
    Camera far_away = *parallel.camera;
    far_away.position = {1e9, 0, 0};
    EXPECT_THROW(renderer.set_camera(far_away), Error);
    EXPECT_EQ(film_after(renderer, kSamples), fresh_film(scene_)) << "what is refused leaves it as it was";
    renderer.set_camera(*parallel.camera);
    EXPECT_EQ(film_after(renderer, kSamples), fresh_film(parallel));
    EXPECT_NE(renderer.read_film(), fresh_film(scene_)) << "the projection shows";
    renderer.set_camera(*scene_.camera);
    EXPECT_EQ(film_after(renderer, kSamples), fresh_film(scene_));
}

// From far away, the air before the yard is seen.
TEST(RendererAir, camera_that_goes_far_away_and_back_ends_as_a_fresh_render) {
    Scene scene = yard();
    scene.sky.model = SkyModel::atmosphere;
    scene.sky.metres_per_voxel = 0.25f;
    scene.sun.on = true;
    Scene far = scene;
    far.camera->position *= 10.0;
    Renderer renderer(test_device(), poisoned());
    prepared(renderer, scene);
    (void)renderer.step(0.0);
    EXPECT_FALSE(renderer.plan().has(Effect::aerial));
    renderer.set_camera(*far.camera);
    EXPECT_TRUE(renderer.plan().has(Effect::aerial));
    EXPECT_EQ(film_after(renderer, kSamples), fresh_film(far));
    renderer.set_camera(*scene.camera);
    EXPECT_EQ(film_after(renderer, kSamples), fresh_film(scene));
}

TEST(RendererSun, sun_that_moves_sets_and_rises_ends_as_a_fresh_render) {
    const Scene first = yard();
    Renderer renderer(test_device(), poisoned());
    prepared(renderer, first);
    (void)renderer.step(0.0);
    Scene scene = first;
    const auto set_sun = [&](bool is_on, float elevation_deg) {
        scene.sun.on = is_on;
        scene.sun.elevation_deg = elevation_deg;
        scene.sun.azimuth_deg = 100.0f;
        renderer.set_sun(scene.sun);
    };
    set_sun(true, -20.0f);
    EXPECT_FALSE(renderer.plan().has(Effect::sun));
    set_sun(true, 30.0f);
    EXPECT_TRUE(renderer.plan().has(Effect::sun));
    EXPECT_EQ(film_after(renderer, kSamples), fresh_film(scene));
    renderer.set_sun(first.sun);
    EXPECT_EQ(film_after(renderer, kSamples), fresh_film(first));
    EXPECT_NE(renderer.read_film(), fresh_film(scene)) << "the sun shows";
}

TEST(RendererSun, occlusion_that_frames_share_stays) {
    Scene scene = yard_of_cells();
    scene.sun.on = true;
    Renderer moved(test_device(), poisoned());
    (void)film_after(prepared(moved, scene), 2);
    Renderer still(test_device(), poisoned());
    (void)film_after(prepared(still, scene), 2);
    still.set_camera(*scene.camera);
    scene.sun.elevation_deg = 12.0f;
    moved.set_sun(scene.sun);
    const auto occlusion = film_after(moved, 2).sums.at("ao");
    EXPECT_EQ(occlusion, film_after(still, 2).sums.at("ao"));
    EXPECT_NE(occlusion, fresh_film(scene, 2).sums.at("ao")) << "the negative control";
    EXPECT_NE(moved.read_film(), still.read_film()) << "the sun shows";
}

// The table of the sky follows the sun.
TEST(RendererAir, sun_that_moves_in_an_atmosphere_ends_as_a_fresh_render) {
    Scene scene = yard();
    scene.sky.model = SkyModel::atmosphere;
    scene.sun.on = true;
    Renderer renderer(test_device(), poisoned());
    prepared(renderer, scene);
    (void)renderer.step(0.0);
    scene.sun.elevation_deg = 3.0f;
    renderer.set_sun(scene.sun);
    EXPECT_EQ(film_after(renderer, kSamples), fresh_film(scene));
}

// The air before a wall far away is seen.
TEST(RendererAir, edit_that_widens_the_scene_and_its_undo_end_as_a_fresh_render) {
    Scene scene = yard();
    scene.sky.model = SkyModel::atmosphere;
    scene.sky.metres_per_voxel = 0.25f;
    scene.sun.on = true;
    Renderer renderer(test_device(), poisoned());
    prepared(renderer, scene);
    (void)renderer.step(0.0);
    EXPECT_FALSE(renderer.plan().has(Effect::aerial));
    const BoxEdit wall{.box = {{-700, -9, 0}, {-699, 9, 9}}, .material = 1};
    const std::vector<BoxEdit> back = renderer.edit(std::span(&wall, 1));
    EXPECT_TRUE(renderer.plan().has(Effect::aerial));
    EXPECT_EQ(film_after(renderer, kSamples), fresh_film(edited_scene(scene, std::span(&wall, 1))));
    renderer.edit(back);
    EXPECT_FALSE(renderer.plan().has(Effect::aerial));
    EXPECT_EQ(film_after(renderer, kSamples), fresh_film(scene));
}

TEST_P(RendererSteps, last_edit_ends_as_a_fresh_render) {
    Renderer renderer(test_device(), poisoned());
    (void)film_after(prepared(renderer, scene_), 2);
    std::vector<BoxEdit> edits = {{.box = {{2, 2, 0}, {4, 4, 2}}, .material = 1}};
    renderer.edit(edits);
    (void)renderer.step(0.0);
    const std::vector<BoxEdit> more = {{.box = {{2, 2, 0}, {3, 3, 9}}}};
    renderer.edit(more);
    edits.insert(edits.end(), more.begin(), more.end());
    EXPECT_EQ(film_after(renderer, kSamples), fresh_film(edited_scene(scene_, edits)));
}

INSTANTIATE_TEST_SUITE_P(scenes, RendererSteps,
                         testing::Values(Case{"caustics_alone", &caustics_alone}, Case{"yard", &yard},
                                         Case{"cells", &yard_of_cells}, Case{"photons", &lit_room},
                                         Case{"radii", &per_pixel_radii}, Case{"spheres", &spheres}),
                         [](const auto& test) { return test.param.name; });

INSTANTIATE_TEST_SUITE_P(scenes, RendererLens,
                         testing::Values(Case{"yard", &yard}, Case{"cells", &yard_of_cells}),
                         [](const auto& test) { return test.param.name; });
INSTANTIATE_TEST_SUITE_P(Nightly, RendererLens,
                         testing::Values(Case{"photons", &lit_room}, Case{"radii", &per_pixel_radii},
                                         Case{"spheres", &spheres}),
                         [](const auto& test) { return test.param.name; });

// Negative control: samples from before a move of the camera stay in the film.
TEST(Renderer, film_that_is_not_restarted_is_caught) {
    const Scene scene = yard();
    Scene moved = scene;
    moved.camera = kThere;
    for (const bool moves : {false, true}) {
        Renderer renderer(test_device(), poisoned());
        FilmSums film = film_after(prepared(renderer, moves ? scene : moved), 1);
        renderer.set_camera(kThere);
        renderer.restart({.samples = 1});
        add_film(film, film_after(renderer, kSamples));
        EXPECT_EQ(film.even, fresh_film(moved).even);
        EXPECT_EQ(film.sums == fresh_film(moved).sums, !moves);
    }
}

TEST(Renderer, step_without_time_takes_one_slice_and_more_time_takes_more) {
    Renderer renderer(test_device(), {});
    Scene scene = yard();
    scene.settings.size = {320, 200};
    (void)film_after(prepared(renderer, scene), 1);  // makes the pipelines
    renderer.restart();
    const StepResult least = renderer.step(0.0);
    EXPECT_EQ(least.tiles, 1u);
    EXPECT_EQ(least.pixels, 320u);
    EXPECT_EQ(least.samples, 0u);
    const StepResult most = renderer.step(2.0);
    EXPECT_GT(most.tiles, 1u);
    EXPECT_GT(most.samples, 0u);
    EXPECT_FALSE(most.passes.empty());
}

TEST(Renderer, steps_count_what_they_did) {
    Renderer renderer(test_device(), poisoned());
    prepared(renderer, yard());
    StepResult sum;
    while (sum.samples < kSamples) {
        const StepResult step = renderer.step(0.0);
        sum.samples += step.samples;
        sum.pixels += step.pixels;
        sum.counters[gpu::kWorkHits] += step.counters[gpu::kWorkHits];
    }
    EXPECT_EQ(sum.pixels, kSamples * 40u * 24u);
    EXPECT_GT(sum.counters[gpu::kWorkHits], 0u);
    EXPECT_LE(sum.counters[gpu::kWorkHits], sum.pixels);
}

TEST(Renderer, refused_change_leaves_it_as_it_was) {
    const Scene scene = yard();
    Renderer renderer(test_device(), poisoned());
    (void)film_after(prepared(renderer, scene), 1);
    RenderSettings settings = scene.settings;
    settings.size = {0, 24};
    EXPECT_THROW(renderer.change(settings, with_aov()), Error);
    PlanRequest request = with_aov();
    request.memory_budget_bytes = 1;
    EXPECT_THROW(renderer.change(scene.settings, request), Error);
    EXPECT_THROW(renderer.prepare(scene, request), Error);
    EXPECT_THROW(renderer.set_camera(camera_towards({1e9, 0, 0}, {0, 0, 0})), Error);
    const BoxEdit unknown{.box = {{0, 0, 0}, {1, 1, 1}}, .material = 99};
    EXPECT_THROW(renderer.edit(std::span(&unknown, 1)), Error);
    EXPECT_EQ(film_after(renderer, kSamples), fresh_film(scene));
}

// Structure words on the device.
std::vector<std::uint32_t> device_words(Renderer& renderer, const std::string& buffer) {
    Recording recording;
    (void)world_buffers(renderer.plan(), recording);
    recording.readback(buffer);
    return values_of<std::uint32_t>(renderer.executor().run(recording), buffer);
}

void expect_device_holds(Renderer& renderer, const MarchWorld& world) {
    for (const auto& [buffer, words] : std::map<std::string, std::vector<std::uint32_t>>{
             {"world.roots", world.roots}, {"world.nodes", world.nodes}, {"world.leaves", world.leaves}}) {
        std::vector<std::uint32_t> held = device_words(renderer, buffer);
        ASSERT_GE(held.size(), words.size()) << buffer;
        held.resize(words.size());
        EXPECT_EQ(held, words) << buffer;
    }
}

bool built_a_world(const StepResult& step) {
    return std::ranges::find(step.built, "structure", &StepTime::label) != step.built.end();
}

class RendererEdits : public testing::TestWithParam<Traversal> {};

// That the structure on the host is that of a rebuild: edit_world_test.cpp.
TEST_P(RendererEdits, device_has_the_words_of_the_edited_structure) {
    const Scene scene = yard();
    PlanRequest request = with_aov();
    request.traversal = GetParam();
    Renderer renderer(test_device(), poisoned());
    EXPECT_TRUE(built_a_world(prepared(renderer, scene, request).step_tile()));
    std::vector<BoxEdit> edits;
    for (int i = 0; i < 6; ++i) {
        const glm::ivec3 low(-7 + 2 * i, -6 + 2 * i, i);
        edits.push_back({.box = {low, low + glm::ivec3(3, 2, 1 + i % 3)}, .material = i % 3 == 2 ? 0 : 1});
        if (i == 4) edits.back().material.reset();
        renderer.edit(std::span(&edits.back(), 1));
        expect_device_holds(renderer, renderer.prepared().march_world);
        // Boxes grow to the end, or are about to when the next edit comes.
        for (int steps = 0; (i % 2 == 1 || steps < 2) && renderer.regrow_boxes(); ++steps) {
        }
        expect_device_holds(renderer, renderer.prepared().march_world);
        EXPECT_EQ(built_a_world(renderer.step_tile()), !has_free_boxes(GetParam())) << "edit " << i;
        EXPECT_EQ(film_after(renderer, 1), fresh_film(edited_scene(scene, edits), 1, request))
            << "edit " << i;
    }
}

INSTANTIATE_TEST_SUITE_P(structures, RendererEdits,
                         testing::Values(Traversal::wide, Traversal::deep, Traversal::naadf),
                         [](const auto& test) { return std::string(name_of(test.param)); });

TEST(RendererEdit, words_that_were_not_sent_are_caught) {
    Renderer renderer(test_device(), poisoned());
    const MarchWorld before = prepared(renderer, yard()).prepared().march_world;
    const BoxEdit edit{.box = {{0, 0, 1}, {2, 2, 3}}, .material = 1};
    renderer.edit(std::span(&edit, 1));
    std::vector<std::uint32_t> held = device_words(renderer, "world.roots");
    held.resize(before.roots.size());
    EXPECT_NE(held, before.roots);
}

TEST(RendererEdit, voxels_beyond_the_box_and_none_at_all_end_as_a_fresh_render) {
    const Scene scene = yard();
    Renderer renderer(test_device(), poisoned());
    (void)prepared(renderer, scene).step(0.0);
    std::vector<BoxEdit> edits;
    for (const BoxEdit& edit : {BoxEdit{.box = {{-30, 0, 0}, {-28, 3, 3}}, .material = 1},  // another corner
                                BoxEdit{.box = {{-40, -40, -40}, {40, 40, 40}}},            // nothing left
                                BoxEdit{.box = {{0, 0, 0}, {2, 2, 2}}, .material = 2}}) {   // a light
        renderer.edit(std::span(&edit, 1));
        edits.push_back(edit);
        EXPECT_EQ(film_after(renderer, 1), fresh_film(edited_scene(scene, edits), 1));
    }
}

TEST(RendererEdit, more_than_there_is_room_for_ends_as_a_fresh_render) {
    Scene scene = yard();
    add_box(scene, {-100, -100, -1}, {100, 100, 0});
    Renderer renderer(test_device(), poisoned());
    (void)prepared(renderer, scene).step(0.0);
    // Every fourth cell, so that each brick is mixed and unlike most others.
    std::vector<BoxEdit> edits;
    for (int i = 0; i < 12000; ++i) {
        const glm::ivec3 low(-100 + 4 * (i % 50) + i % 3, -100 + 4 * (i / 50 % 50) + i / 7 % 4,
                             4 * (i / 2500));
        edits.push_back({.box = {low, low + 1}, .material = static_cast<std::uint32_t>(i % 2)});
    }
    renderer.edit(edits);
    EXPECT_TRUE(built_a_world(renderer.step(0.0)));
    EXPECT_EQ(film_after(renderer, 1), fresh_film(edited_scene(scene, edits), 1));
}

}  // namespace
}  // namespace voxilux::test

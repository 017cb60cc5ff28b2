#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <set>
#include <string>
#include <utility>

#include "base/error.h"
#include "scene/facts.h"
#include "scene/lobe_weights.h"
#include "scene/scene_bounds.h"
#include "scene/scene_hash.h"

namespace voxilux {
namespace {

// Four materials, two models, an instance of the first only, one sphere.
Scene small_scene() {
    Scene scene;
    scene.materials = {{.name = "plain"},
                       {.name = "lamp", .emission = glm::vec3(1.0f), .surface = Surface::emit},
                       {.name = "pane", .surface = Surface::glass, .transmission = 1.0f},
                       {.name = "coin", .surface = Surface::metal, .roughness = 0.5f, .metallic = 1.0f}};
    scene.models = {
        {.name = "used", .size = {4, 5, 6}, .voxels = {{1, 2, 3, 0}, {3, 4, 5, 0}}},
        {.name = "hidden", .size = {2, 2, 2}, .voxels = {{0, 0, 0, 1}, {1, 0, 0, 2}, {0, 1, 0, 3}}}};
    scene.instances = {{.model = 0, .translation = {10, 20, 30}}};
    scene.spheres = {{.centre = {1, 2, 3}, .radius = 2.0, .material = 0}};
    return scene;
}

TEST(Facts, empty_scene_has_nothing) {
    const SceneFacts facts = measure_scene({});
    EXPECT_EQ(facts.voxel_count, 0u);
    EXPECT_FALSE(facts.has_voxels);
    EXPECT_FALSE(facts.has_spheres);
    EXPECT_TRUE(facts.box.empty());
    EXPECT_EQ(facts.fill_ratio, 0.0);
    EXPECT_TRUE(facts.has_sky);
    EXPECT_TRUE(facts.sun_reaches);
}

TEST(Facts, materials_of_hidden_models_do_not_count) {
    Scene scene = small_scene();
    SceneFacts facts = measure_scene(scene);
    EXPECT_FALSE(facts.has_emitters || facts.has_glass || facts.has_metal);
    EXPECT_EQ(facts.material_count, 1u);
    scene.instances.push_back({.model = 1});  // negative control: shown, they all do
    facts = measure_scene(scene);
    EXPECT_TRUE(facts.has_emitters && facts.has_glass && facts.has_metal);
    EXPECT_EQ(facts.material_count, 4u);
}

TEST(Facts, albedo_that_bounds_paths_is_that_of_used_materials_with_a_diffuse_lobe) {
    Scene scene;
    scene.materials = {
        {.albedo = glm::vec3(0.2f, 0.5f, 0.1f)}, {.albedo = glm::vec3(1.0f)}, {.albedo = glm::vec3(0.9f)}};
    scene.materials[2].surface = Surface::metal;
    scene.materials[2].metallic = 1.0f;
    scene.materials[2].roughness = 0.0f;
    scene.models.emplace_back().voxels = {{.material = 0}, {.x = 1, .material = 2}};
    scene.instances = {{.model = 0}};
    EXPECT_EQ(measure_scene(scene).max_albedo, 0.5f);
    scene.models[0].voxels.push_back({.x = 2, .material = 1});
    EXPECT_EQ(measure_scene(scene).max_albedo, 1.0);
    Scene on_ground;
    on_ground.ground = {.on = true, .albedo = glm::vec3(0.25f, 0.5f, 0.125f)};
    EXPECT_EQ(measure_scene(on_ground).max_albedo, 0.5) << "photons and paths leave the ground, too";
}

TEST(Facts, materials_that_are_shown_as_something_simpler_are_named_once_a_kind) {
    Scene scene = small_scene();
    EXPECT_TRUE(measure_scene(scene).simplified.empty()) << "the coin is hidden";
    scene.instances.push_back({.model = 1});
    scene.materials[2].roughness = 0.0f;
    const std::vector<std::string> rough = {
        "rough metal is shown as a mix of a mirror and a diffuse surface ('coin')"};
    EXPECT_EQ(measure_scene(scene).simplified_rough, rough);
    EXPECT_TRUE(measure_scene(scene).simplified.empty());
    scene.materials[1].surface = scene.materials[2].surface = Surface::media;
    EXPECT_EQ(
        measure_scene(scene).simplified,
        (std::vector<std::string>{"a medium is shown as an opaque diffuse surface ('lamp' and 1 more)"}));
    scene.materials[3].roughness = 0.0f;
    scene.materials[1].surface = scene.materials[2].surface = Surface::diffuse;
    EXPECT_TRUE(measure_scene(scene).simplified.empty());
    EXPECT_TRUE(measure_scene(scene).simplified_rough.empty());
}

TEST(Facts, rough_and_sharp_surfaces_are_told_apart) {
    Scene scene = small_scene();
    EXPECT_FALSE(measure_scene(scene).has_rough || measure_scene(scene).has_sharp);
    scene.spheres[0].material = 3;
    EXPECT_TRUE(measure_scene(scene).has_rough);
    EXPECT_FALSE(measure_scene(scene).has_sharp);
    scene.materials[3].roughness = 1e-4f;
    EXPECT_FALSE(measure_scene(scene).has_rough) << "below the least roughness";
    EXPECT_TRUE(measure_scene(scene).has_sharp);
    scene.materials[3].metallic = 0.0f;
    EXPECT_FALSE(measure_scene(scene).has_rough || measure_scene(scene).has_sharp);
}

TEST(Facts, rows_of_gains_are_those_of_rough_materials_each_once) {
    Scene scene = small_scene();
    scene.materials.push_back(scene.materials[3]);
    scene.materials[2].roughness = 0.5f;  // glass
    const std::vector<GainRow> rows = gain_rows(scene);
    EXPECT_EQ(rows, (std::vector<GainRow>{{0.25f, 1.5f}, {0.25f, 1.0f / 1.5f}, {0.25f, 0.0f}}));
    EXPECT_EQ(gain_row_of(rows, {0.25f, 0.0f}), 2u);
    EXPECT_EQ(gain_row_of(rows, {0.5f, 0.0f}), 0u) << "smooth: there is none";
}

TEST(Facts, boxes_of_shapes_count_as_their_cells) {
    Scene scene = small_scene();
    scene.models[0].boxes = {{{{0, 0, 0}, {2, 3, 2}}, 1}};
    const SceneFacts facts = measure_scene(scene);
    EXPECT_EQ(facts.voxel_count, 2u + 2u * 3u * 2u);
    EXPECT_TRUE(facts.has_emitters);
    EXPECT_EQ(facts.material_count, 2u);
}

// Palettes of many files add up, too.
TEST(Facts, more_materials_than_voxels_can_number_are_refused) {
    Scene scene = small_scene();
    scene.materials.resize(kMaxMaterials);
    EXPECT_NO_THROW((void)measure_scene(scene));
    scene.materials.emplace_back();
    EXPECT_THROW((void)measure_scene(scene), Error);
}

TEST(Facts, sphere_material_counts) {
    Scene scene = small_scene();
    scene.spheres[0].material = 2;
    EXPECT_TRUE(measure_scene(scene).has_glass);
    scene.materials[2].transmission = 0.0f;
    EXPECT_FALSE(measure_scene(scene).has_glass) << "negative control: nothing comes through";
}

TEST(Facts, emitter_without_power_is_none) {
    Scene scene = small_scene();
    scene.spheres[0].material = 1;
    EXPECT_TRUE(measure_scene(scene).has_emitters);
    scene.materials[1].emission = glm::vec3(0.0f);
    EXPECT_FALSE(measure_scene(scene).has_emitters);
}

TEST(Facts, counts_are_per_instance) {
    Scene scene = small_scene();
    scene.instances.push_back({.model = 0, .translation = {10, 20, 30}});
    const SceneFacts facts = measure_scene(scene);
    EXPECT_EQ(facts.voxel_count, 4u);
    EXPECT_EQ(facts.instance_count, 2u);
    // Cells (1,2,3) and (3,4,5) with pivot (2,2,3): (9,20,30) and (11,22,32), a box of 3^3.
    EXPECT_EQ(facts.box, (Box{{9, 20, 30}, {12, 23, 33}}));
    EXPECT_EQ(facts.extent, glm::i64vec3(3));
    EXPECT_DOUBLE_EQ(facts.fill_ratio, 4.0 / 27.0);
}

TEST(Facts, sun_needs_power_height_and_its_switch) {
    Scene scene;
    EXPECT_TRUE(measure_scene(scene).sun_reaches);
    scene.sun.on = false;
    EXPECT_FALSE(measure_scene(scene).sun_reaches);
    scene.sun = {.elevation_deg = 0.0f};
    EXPECT_FALSE(measure_scene(scene).sun_reaches);
    scene.sun = {.elevation_deg = 1e-30f};
    EXPECT_TRUE(measure_scene(scene).sun_reaches);
    scene.sun = {.elevation_deg = -10.0f};
    EXPECT_FALSE(measure_scene(scene).sun_reaches);
    scene.sun = {.irradiance = glm::vec3(0.0f)};
    EXPECT_FALSE(measure_scene(scene).sun_reaches);
    scene.sky.radiance = glm::vec3(0.0f);
    EXPECT_FALSE(measure_scene(scene).has_sky);
}

TEST(Facts, description_names_the_facts) {
    const std::string text = describe(measure_scene(small_scene()));
    EXPECT_NE(text.find("voxels: 2\n"), std::string::npos);
    EXPECT_NE(text.find("box: (9 20 30) to (12 23 33), 3 x 3 x 3 voxels\n"), std::string::npos);
    EXPECT_NE(text.find("emitters: no\n"), std::string::npos);
}

// Against world_cell, voxel by voxel, for every signed permutation of the axes.
TEST(SceneBounds, boxes_equal_brute_force_for_all_rotations) {
    std::mt19937 random(7);
    const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    constexpr std::uint8_t kOrders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    for (int symmetry = 0; symmetry < 48; ++symmetry) {
        Scene scene;
        scene.models.push_back({.size = {1 + below(9), 1 + below(9), 1 + below(9)}});
        VoxelModel& model = scene.models[0];
        for (int i = 0; i < 3; ++i)
            model.voxels.push_back({static_cast<std::uint16_t>(below(model.size.x)),
                                    static_cast<std::uint16_t>(below(model.size.y)),
                                    static_cast<std::uint16_t>(below(model.size.z)), 0});
        Instance instance{.translation = {below(99) - 50, below(99) - 50, below(99) - 50}};
        for (std::size_t i = 0; i < 3; ++i) {
            instance.rotation.axis[i] = kOrders[symmetry % 6][i];
            instance.rotation.sign[i] = ((symmetry / 6) >> i & 1) != 0 ? -1 : 1;
        }
        scene.instances.push_back(instance);
        Box wanted;
        for (const Voxel& v : model.voxels) {
            const glm::ivec3 cell = world_cell(instance, model.size, {v.x, v.y, v.z});
            wanted = united(wanted, {cell, cell + 1});
        }
        EXPECT_EQ(voxel_bounds(scene), wanted) << "symmetry " << symmetry;
    }
}

TEST(SceneBounds, coordinates_beyond_the_limit_are_refused) {
    Scene scene = small_scene();
    scene.models[0] = {.size = {1, 1, 1}, .voxels = {{0, 0, 0, 0}}};
    scene.instances[0].translation = {kMaxCoordinate - 1, 0, -kMaxCoordinate};
    EXPECT_EQ(voxel_bounds(scene).hi.x, kMaxCoordinate);
    EXPECT_EQ(voxel_bounds(scene).lo.z, -kMaxCoordinate);
    for (const int beyond : {kMaxCoordinate, std::numeric_limits<int>::max(), -kMaxCoordinate - 1,
                             std::numeric_limits<int>::min()}) {
        scene.instances[0].translation = {0, beyond, 0};
        EXPECT_THROW((void)voxel_bounds(scene), Error) << beyond;
    }
}

TEST(SceneBounds, spheres_round_outwards) {
    Scene scene;
    scene.spheres = {{.centre = {0.5, 10.0, -3.25}, .radius = 1.5}};
    EXPECT_EQ(scene_bounds(scene), (Box{{-1, 8, -5}, {2, 12, -1}}));
    EXPECT_TRUE(voxel_bounds(scene).empty());
    scene.spheres[0].radius = std::numeric_limits<double>::infinity();
    EXPECT_THROW((void)scene_bounds(scene), Error);
    scene.spheres[0].radius = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW((void)scene_bounds(scene), Error);
}

TEST(SceneHash, equal_scenes_have_equal_hashes) {
    Scene renamed = small_scene();
    renamed.materials[0].name = "other";
    renamed.models[0].name = "other";
    renamed.warnings = {"something"};
    EXPECT_EQ(scene_hash(small_scene()), scene_hash(small_scene()));
    EXPECT_EQ(scene_hash(small_scene()), scene_hash(renamed));
}

TEST(SceneHash, every_field_changes_the_hash) {
    const std::function<void(Scene&)> changes[] = {
        [](Scene& s) { s.materials[1].albedo.z += 0.1f; },
        [](Scene& s) { s.materials[1].emission.x = 2.0f; },
        [](Scene& s) { s.materials[1].surface = Surface::media; },
        [](Scene& s) { s.materials[1].roughness = 0.5f; },
        [](Scene& s) { s.materials[1].ior = 1.4f; },
        [](Scene& s) { s.materials[1].metallic = 0.5f; },
        [](Scene& s) { s.materials[1].transmission = 0.5f; },
        [](Scene& s) { s.materials.pop_back(); },
        [](Scene& s) { s.models[1].size.y = 3; },
        [](Scene& s) { s.models[1].voxels[1].x = 0; },
        [](Scene& s) { s.models[1].voxels[1].y = 1; },
        [](Scene& s) { s.models[1].voxels[1].z = 1; },
        [](Scene& s) { s.models[1].voxels[1].material = 1; },
        [](Scene& s) { s.models[1].voxels.pop_back(); },
        [](Scene& s) { s.instances[0].model = 1; },
        [](Scene& s) { std::swap(s.instances[0].rotation.axis[0], s.instances[0].rotation.axis[1]); },
        [](Scene& s) { s.instances[0].rotation.sign[2] = -1; },
        [](Scene& s) { s.instances[0].translation.x = 0; },
        [](Scene& s) { s.instances.push_back(s.instances[0]); },
        [](Scene& s) { s.spheres[0].centre.y = 2.5; },
        [](Scene& s) { s.spheres[0].radius = 2.5; },
        [](Scene& s) { s.spheres[0].material = 1; },
        [](Scene& s) { s.spheres.clear(); },
        [](Scene& s) { s.sun.azimuth_deg += 1.0f; },
        [](Scene& s) { s.sun.elevation_deg += 1.0f; },
        [](Scene& s) { s.sun.angular_diameter_deg += 1.0f; },
        [](Scene& s) { s.sun.irradiance.y += 1.0f; },
        [](Scene& s) { s.sun.on = false; },
        [](Scene& s) { s.sky.radiance.x = 0.0f; },
        [](Scene& s) { s.camera = Camera{}; },
        [](Scene& s) {
            s.camera = Camera{.position = {0, 1, 0}};
        },
        [](Scene& s) { s.camera = Camera{.yaw_deg = 1.0}; },
        [](Scene& s) { s.camera = Camera{.pitch_deg = 1.0}; },
        [](Scene& s) { s.camera = Camera{.fov_y_deg = 1.0}; },
        [](Scene& s) { s.settings.size.y = 1; },
        [](Scene& s) { s.settings.spp = 1; },
        [](Scene& s) { s.settings.ao_rays = 2; },
        [](Scene& s) { s.settings.ao_radius = 1.0f; },
        [](Scene& s) { s.settings.seed = 1; },
        [](Scene& s) { s.settings.sequence = Sequence::white; },
        [](Scene& s) { s.settings.ao.method = AoMethod::hash; },
        [](Scene& s) { s.settings.ao.cell_px = 5.0f; },
        [](Scene& s) { s.settings.ao.reproject = false; },
        [](Scene& s) { s.settings.ao.merged = true; },
        [](Scene& s) { s.settings.ao.checkerboard = true; },
        [](Scene& s) { s.settings.ao.by_pixel = true; },
        [](Scene& s) { s.settings.ao.filter = 1; },
        [](Scene& s) { s.settings.ao.sample_limit = 1; },
        [](Scene& s) { s.settings.ao.slots = 1; },
        [](Scene& s) { s.settings.photons.aim = false; },
        [](Scene& s) { s.settings.photons.caustics = false; },
        [](Scene& s) { s.settings.photons.indirect = false; },
    };
    std::set<std::uint64_t> hashes{scene_hash(small_scene())};
    for (std::size_t i = 0; i < std::size(changes); ++i) {
        Scene scene = small_scene();
        changes[i](scene);
        EXPECT_TRUE(hashes.insert(scene_hash(scene)).second) << "change " << i;
    }
}

// Machines and builds agree on the key of parts and caches, so it has a fixed value.
TEST(SceneHash, value_is_stable) {
    EXPECT_EQ(scene_hash(Scene{}), 0x3daade6de185768eu) << std::hex << scene_hash(Scene{});
}

}  // namespace
}  // namespace voxilux

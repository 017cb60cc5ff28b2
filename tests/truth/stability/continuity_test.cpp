// Rows D4 to D7 of the list of hard cases: changes of a scene that do not change its picture, or change it by
// a known amount.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "formats/vox_read.h"
#include "scene/vox_scene.h"
#include "support/frame_fixture.h"
#include "support/light_pictures.h"
#include "support/light_scenes.h"
#include "support/same_bits.h"
#include "support/vox_builder.h"

namespace voxilux {
namespace {

using test::FramePlanes;
using test::LightPicture;

// A floor, a wall, a pillar and a ball under a sky and a sun that casts soft shadows.
Scene courtyard() {
    Scene scene = test::white_scene();
    scene.materials[0].albedo = glm::vec3(0.7f, 0.5f, 0.3f);
    test::add_box(scene, {-16, -16, -1}, {16, 16, 0});
    test::add_box(scene, {4, -16, 0}, {6, 16, 9});
    test::add_box(scene, {-3, 2, 0}, {0, 5, 5}, test::add_diffuse(scene, 0.9f));
    scene.spheres.push_back({glm::dvec3(0.5, -3.0, 1.5), 1.5, test::add_diffuse(scene, 0.4f)});
    scene.sky.radiance = glm::vec3(0.6f, 0.8f, 1.1f);
    scene.sun = {.azimuth_deg = 200.0f, .elevation_deg = 50.0f, .angular_diameter_deg = 5.0f};
    scene.camera = test::camera_towards({-11, -8, 12}, {0, 0, 1}, 50.0);
    scene.settings.size = {40, 40};
    scene.settings.ao_radius = 12.0f;
    return scene;
}

// A room with an emitter under the ceiling, whose light reaches other surfaces by photons.
Scene lit_room() {
    Scene scene = test::dark_scene(32, 8192, 0.25);
    test::add_room(scene, {10, 10, 8}, test::add_diffuse(scene, 0.7f));
    test::add_box(scene, {4, 4, 7}, {6, 6, 8}, test::add_emitter(scene, 12.0f));
    test::add_box(scene, {7, 7, 0}, {9, 9, 4}, test::add_diffuse(scene, 0.4f));
    scene.camera = test::camera_towards({5.0, 0.4, 4.0}, {5.0, 10.0, 2.5}, 75.0);
    return scene;
}

template <class T>
std::size_t count_of_differences(const std::vector<T>& a, const std::vector<T>& b) {
    EXPECT_EQ(a.size(), b.size());
    return test::differing_bits(std::span<const T>(a), std::span<const T>(b)).count;
}

// Elements of all planes that differ in any bit.
std::size_t differences(const FramePlanes& a, const FramePlanes& b) {
    EXPECT_GT(a.color.size(), 0u);
    return count_of_differences(a.hits, b.hits) + count_of_differences(a.ao, b.ao) +
           count_of_differences(a.sun, b.sun) + count_of_differences(a.color, b.color);
}

std::size_t differences(const Scene& a, const Scene& b) {
    return differences(test::render_first_sample(a), test::render_first_sample(b));
}

// The scene of a file: a wall and a floor in colour 1, and whatever `chunks` add.
Scene scene_of(const std::string& models, const std::string& graph, const std::string& materials = "") {
    using namespace vox_builder;
    std::vector<Cell> cells;
    for (int x = 0; x < 8; ++x)
        for (int y = 0; y < 8; ++y)
            for (int z = 0; z < (y == 7 ? 6 : 1); ++z)
                cells.push_back({x, y, z, 1});
    const auto file =
        read_vox(vox_builder::file(size_chunk(8, 8, 8) + voxels_chunk(cells) + models + graph + materials));
    EXPECT_TRUE(file);
    Scene scene = scene_from_vox(file.value());
    scene.camera = test::camera_towards({-3, -9, 9}, {0, 0, 2}, 50.0);
    scene.settings.size = {40, 40};
    return scene;
}

TEST(Continuity, d4_emitter_covered_on_all_sides_changes_no_bit) {
    const Scene scene = lit_room();
    Scene with_emitter = scene;
    test::add_box(with_emitter, {8, 8, 1}, {9, 9, 2},
                  test::add_emitter(with_emitter, 50.0f));  // two sides open
    EXPECT_GT(differences(scene, with_emitter), 0u) << "the negative control: its other sides show";
    with_emitter.instances.back().translation += glm::ivec3(0, 0, -2);  // into the floor
    Scene with_floor = scene;
    for (Scene* floored : {&with_emitter, &with_floor})
        test::add_box(*floored, {-1, -1, -2}, {11, 11, -1});
    EXPECT_EQ(differences(with_floor, with_emitter), 0u);
}

TEST(Continuity, d4_hidden_layer_empty_model_and_unused_material_change_no_bit) {
    using namespace vox_builder;
    const std::string one =
        transform(0, 1, -1, {{}}) + group(1, {2}) + transform(2, 3, 0, {{}}) + shape(3, {{0, {}}});
    const std::string two = transform(0, 1, -1, {{}}) + group(1, {2, 4}) + transform(2, 3, 0, {{}}) +
                            shape(3, {{0, {}}}) + transform(4, 5, 1, {{}}) + shape(5, {{1, {}}});
    const std::string hidden = layer(1, {{"_hidden", "1"}}), shown = layer(1, {});
    const std::string emitter = record("MATL", 2, {{"_type", "_emit"}, {"_emit", "1"}, {"_flux", "4"}});
    const std::string tower = size_chunk(4, 4, 12) + voxels_chunk({{1, 1, 11, 2}});
    const FramePlanes plain = test::render_first_sample(scene_of("", one));
    const auto changed = [&](const Scene& scene) {
        return differences(plain, test::render_first_sample(scene));
    };
    EXPECT_EQ(changed(scene_of(tower, two + hidden, emitter)), 0u);
    EXPECT_EQ(changed(scene_of(size_chunk(9, 9, 9) + voxels_chunk({}), two + shown)), 0u);
    EXPECT_EQ(changed(scene_of("", one, emitter)), 0u);
    EXPECT_GT(changed(scene_of(tower, two + shown)), 0u) << "the negative control: a layer that is shown";
}

// Voxels in z order, cut into columns of one model each.
Scene in_columns(const Scene& scene) {
    Scene cut = scene;
    cut.models.clear();
    cut.instances.clear();
    for (const Instance& instance : scene.instances) {
        const VoxelModel& model = scene.models[instance.model];
        for (const Voxel& voxel : model.voxels) {
            const glm::ivec3 cell = world_cell(instance, model.size, {voxel.x, voxel.y, voxel.z});
            if (voxel.z == 0) test::add_box(cut, cell, cell + glm::ivec3(1, 1, model.size.z), voxel.material);
        }
    }
    return cut;
}

// The same materials in the opposite order.
Scene renumbered(Scene scene) {
    const std::size_t last = scene.materials.size() - 1;
    std::ranges::reverse(scene.materials);
    for (VoxelModel& model : scene.models)
        for (Voxel& voxel : model.voxels)
            voxel.material = static_cast<std::uint16_t>(last - voxel.material);
    for (Sphere& sphere : scene.spheres)
        sphere.material = static_cast<std::uint32_t>(last - sphere.material);
    return scene;
}

// Only colours: a hit names the number of its material.
std::size_t differing_colours(const Scene& a, const Scene& b) {
    return count_of_differences(test::render_first_sample(a).color, test::render_first_sample(b).color);
}

TEST(Continuity, d5_models_cut_into_columns_and_renumbered_materials_change_no_bit) {
    for (const Scene& scene : {courtyard(), lit_room()}) {
        EXPECT_EQ(differences(scene, in_columns(scene)), 0u);
        EXPECT_EQ(differing_colours(scene, renumbered(scene)), 0u);
        Scene swapped = scene;
        std::swap(swapped.materials.front(), swapped.materials.back());
        EXPECT_GT(differing_colours(scene, swapped), 0u) << "the negative control: other materials";
    }
}

Scene moved(Scene scene, glm::ivec3 by) {
    for (Instance& instance : scene.instances)
        instance.translation += by;
    for (Sphere& sphere : scene.spheres)
        sphere.centre += glm::dvec3(by);
    scene.camera->position += glm::dvec3(by);
    return scene;
}

TEST(Continuity, d6_scene_moved_by_whole_voxels_keeps_every_bit) {
    for (const Scene& scene : {courtyard(), lit_room()}) {
        const FramePlanes here = test::render_first_sample(scene);
        for (const glm::ivec3 by : {glm::ivec3(1, -3, 7), glm::ivec3(-4096, 20000, 1023)})
            EXPECT_EQ(differences(here, test::render_first_sample(moved(scene, by))), 0u);
        Scene stayed = moved(scene, {1, 0, 0});
        stayed.camera->position.x -= 1.0;
        EXPECT_GT(differences(here, test::render_first_sample(stayed)), 0u) << "the negative control";
    }
}

TEST(ContinuityNightly, d6_moved_scene_keeps_every_bit_in_every_projection_and_on_a_ground) {
    for (const Projection projection : {Projection::perspective, Projection::orthographic,
                                        Projection::equirectangular, Projection::fisheye}) {
        Scene scene = courtyard();
        scene.ground = {.on = true, .albedo = glm::vec3(0.4f), .height = -1.0};
        scene.camera->projection = projection;
        scene.camera->pixels_per_voxel = 1.7;
        const FramePlanes here = test::render_first_sample(scene);
        for (const glm::ivec3 by : {glm::ivec3(1, -3, 7), glm::ivec3(-4096, 20000, 1023)}) {
            Scene there = moved(scene, by);
            there.ground.height = *scene.ground.height + by.z;
            EXPECT_EQ(differences(here, test::render_first_sample(there)), 0u)
                << static_cast<int>(projection);
        }
        EXPECT_GT(differences(here, test::render_first_sample(moved(scene, {0, 0, 7}))), 0u)
            << "the negative control: the ground stays";
    }
}

// A signed permutation of the axes that keeps z, applied to everything with a position or a direction.
Scene turned(const Scene& scene, const Rotation& rotation) {
    const auto point = [&](glm::dvec3 p) {
        glm::dvec3 result;
        for (int i = 0; i < 3; ++i)
            result[i] =
                rotation.sign[static_cast<std::size_t>(i)] * p[rotation.axis[static_cast<std::size_t>(i)]];
        return result;
    };
    Scene result = scene;
    result.models.clear();
    result.instances.clear();
    for (const Instance& instance : scene.instances) {
        const VoxelModel& model = scene.models[instance.model];
        const glm::dvec3 a = point(glm::dvec3(world_cell(instance, model.size, {0, 0, 0})));
        const glm::dvec3 b = point(glm::dvec3(world_cell(instance, model.size, model.size - 1) + 1));
        test::add_box(result, glm::ivec3(glm::min(a, b)), glm::ivec3(glm::max(a, b)),
                      model.voxels.front().material);
    }
    for (Sphere& sphere : result.spheres)
        sphere.centre = point(sphere.centre);
    const glm::dvec3 sun = point(glm::dvec3(scene.sun.direction()));
    result.sun.azimuth_deg = static_cast<float>(glm::degrees(std::atan2(sun.y, sun.x)));
    const double yaw = glm::radians(scene.camera->yaw_deg);
    const glm::dvec3 view = point({std::cos(yaw), std::sin(yaw), 0.0});
    result.camera->position = point(scene.camera->position);
    result.camera->yaw_deg = glm::degrees(std::atan2(view.y, view.x));
    return result;
}

LightPicture picture_of(const Scene& scene) {
    const std::array blocks{4};
    return test::render_light(scene, {.iterations = 32, .blocks = blocks, .effects = {}}).front();
}

LightPicture mirrored(LightPicture picture) {
    for (int y = 0; y < picture.size.y; ++y) {
        const auto row = picture.pixels.begin() + y * picture.size.x;
        std::reverse(row, row + picture.size.x);
    }
    return picture;
}

constexpr Rotation kQuarter{.axis = {1, 0, 2}, .sign = {-1, 1, 1}};
constexpr Rotation kMirror{.axis = {0, 1, 2}, .sign = {-1, 1, 1}};

// Directions are drawn about axes of the surface, which do not turn with the scene, so pictures are equal but
// for noise.
TEST(Continuity, d6_scene_turned_by_quarters_gives_the_same_picture) {
    for (const Scene& scene : {courtyard(), lit_room()}) {
        const LightPicture straight = picture_of(scene);
        Scene other = scene;
        for (int quarters = 1; quarters < 4; ++quarters) {
            other = turned(other, kQuarter);
            test::expect_equal_light(picture_of(other), straight, "quarters");
        }
        other = turned(scene, kMirror);
        EXPECT_FALSE(test::is_equal_light(picture_of(other), straight)) << "the negative control";
    }
}

TEST(Continuity, d6_mirrored_scene_gives_the_mirrored_picture) {
    for (const Scene& scene : {courtyard(), lit_room()})
        test::expect_equal_light(mirrored(picture_of(turned(scene, kMirror))), picture_of(scene), "mirror");
}

// The greatest difference between the light of sky and sun together and the sum of both, per sample.
double additivity_error(const Scene& scene, const Scene& sky, const Scene& sun) {
    double greatest = 0.0;
    const FramePlanes both = test::render_first_sample(scene);
    const FramePlanes of_sky = test::render_first_sample(sky), of_sun = test::render_first_sample(sun);
    for (std::size_t i = 0; i < both.color.size(); ++i) {
        const glm::dvec3 sum = glm::dvec3(of_sky.color[i]) + glm::dvec3(of_sun.color[i]);
        const glm::dvec3 off = glm::abs(glm::dvec3(both.color[i]) - sum);
        greatest = std::max({greatest, off.x, off.y, off.z});
    }
    return greatest;
}

TEST(Continuity, d7_sky_and_sun_together_are_the_sum_of_both_in_every_sample) {
    const Scene both = courtyard();
    Scene sky = both, sun = both;
    sky.sun.on = false;
    sun.sky.radiance = glm::vec3(0.0f);
    EXPECT_LT(additivity_error(both, sky, sun), 1e-6);
    sun.settings.seed += 1;
    EXPECT_GT(additivity_error(both, sky, sun), 1e-2) << "the negative control: other points of the sun";
}

}  // namespace
}  // namespace voxilux

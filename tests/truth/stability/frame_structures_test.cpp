// Whole frames through every structure of the world give the same bits, also from places where earlier
// renderers failed.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "support/frame_fixture.h"
#include "support/test_scenes.h"

namespace voxilux {
namespace {

// A floor, a wall, a pillar and loose voxels of two materials under a sky and a sun; a picture of odd width.
Scene courtyard() {
    Scene scene = test::white_scene();
    scene.materials.push_back({.name = "grey", .albedo = glm::vec3(0.5f)});
    test::add_box(scene, {-20, -20, 0}, {20, 20, 1});
    test::add_box(scene, {10, -20, 1}, {11, 20, 15}, 1);
    test::add_box(scene, {2, 3, 1}, {5, 6, 12}, 1);
    for (int i = 0; i < 20; ++i)
        test::add_box(scene, {i - 8, (i * 7) % 15 - 8, 2 + i % 9}, {i - 7, (i * 7) % 15 - 7, 3 + i % 9},
                      i % 2 == 0 ? 0 : 1);
    scene.sun.on = true;
    scene.settings.size = {33, 17};
    scene.settings.ao_rays = 2;
    return scene;
}

struct NamedCamera {
    std::string name;
    Camera camera;
};

std::vector<NamedCamera> cameras() {
    return {
        {"b01_yaw_0_and_an_odd_width", {.position = {-15.5, 0.5, 4.5}}},
        {"b02_integer_position_and_axial_view", {.position = {-40.0, 1.0, 4.0}, .yaw_deg = 0.0}},
        {"b02_integer_position_looking_down",
         {.position = {0.0, 0.0, 40.0}, .yaw_deg = 90.0, .pitch_deg = -90.0}},
        {"b07_3000_voxels_away", {.position = {-3000.3, 5.2, 400.1}, .pitch_deg = -7.5, .fov_y_deg = 0.8}},
        {"b09_a_fifth_of_a_voxel_before_a_wall", {.position = {9.8, 0.5, 5.5}, .yaw_deg = 20.0}},
        {"b10_inside_a_solid", {.position = {3.5, 4.5, 5.5}}},
        {"a_million_voxels_away",
         {.position = {-1e6 - 0.3, 5.2, 1e5 + 0.1}, .pitch_deg = -5.7106, .fov_y_deg = 0.0024}},
    };
}

// Bits that differ, as counts of bytes.
template <class T>
std::size_t differing_bytes(const std::vector<T>& a, const std::vector<T>& b) {
    if (a.size() != b.size()) return std::max(a.size(), b.size()) * sizeof(T);
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size() * sizeof(T); ++i)
        count +=
            reinterpret_cast<const char*>(a.data())[i] != reinterpret_cast<const char*>(b.data())[i] ? 1 : 0;
    return count;
}

std::size_t differing_bytes(const test::FramePlanes& a, const test::FramePlanes& b) {
    return differing_bytes(a.hits, b.hits) + differing_bytes(a.ao, b.ao) + differing_bytes(a.sun, b.sun) +
           differing_bytes(a.color, b.color);
}

test::FramePlanes planes_of(const Scene& scene, Traversal traversal) {
    const test::FramePlanes planes = test::FrameFixture(scene, test_executor(), traversal).render(0);
    for (std::size_t i = 0; i < gpu::kFaultCount; ++i)
        EXPECT_EQ(planes.counters[i], 0u) << name_of(traversal) << " fault " << gpu::kCounterNames[i];
    return planes;
}

void expect_same_frames(const Scene& scene) {
    const test::FramePlanes first = planes_of(scene, all_traversals().front());
    for (const glm::vec3& color : first.color)
        ASSERT_TRUE(std::isfinite(color.x + color.y + color.z));
    std::size_t hits = 0;
    for (const gpu::Hit& hit : first.hits)
        hits += hit.face != ~0u ? 1 : 0;
    EXPECT_GT(hits, first.hits.size() / 4);
    for (const Traversal traversal : all_traversals())
        EXPECT_EQ(differing_bytes(planes_of(scene, traversal), first), 0u) << name_of(traversal);
}

TEST(HardCase, row16_frames_are_the_same_bits_through_every_structure) {
    Scene scene = courtyard();
    for (const NamedCamera& from : cameras()) {
        SCOPED_TRACE(from.name);
        scene.camera = from.camera;
        expect_same_frames(scene);
    }
}

TEST(HardCase, row16_comparison_of_frames_notices_one_voxel_more) {
    Scene scene = courtyard();
    scene.camera = cameras().front().camera;
    const test::FramePlanes before = planes_of(scene, all_traversals().front());
    test::add_box(scene, {-10, 0, 4}, {-9, 1, 5});
    EXPECT_GT(differing_bytes(planes_of(scene, all_traversals().front()), before), 0u);
}

}  // namespace
}  // namespace voxilux

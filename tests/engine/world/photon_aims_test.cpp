#include "world/photon_aims.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shared/light.h"
#include "shared/photon_aim.h"
#include "support/draws.h"
#include "support/light_scenes.h"
#include "world/lights.h"

namespace voxilux {
namespace {

using test::Draws;

// A floor with a glass ball, a mirror of voxels, and two emitters: a face of a voxel and a ball.
Scene lit_scene() {
    Scene scene = test::dark_scene(16, 1000, 0.5);
    test::add_box(scene, {-8, -8, -1}, {8, 8, 0}, test::add_diffuse(scene, 0.5f));
    test::add_box(scene, {4, -2, 0}, {5, 2, 3}, test::add_mirror(scene));
    test::add_box(scene, {0, 6, 6}, {1, 7, 7}, test::add_emitter(scene, 3.0f));
    scene.spheres = {{{-3.0, -1.0, 2.0}, 1.5, test::add_glass(scene, 1.5f)},
                     {{1.0, -6.0, 4.0}, 0.5, test::add_emitter(scene, 2.0f)}};
    return scene;
}

struct Aimed {
    LightList lights;
    PhotonAims aims;
    glm::ivec3 origin{0};
};

Aimed aim(const Scene& scene) {
    const VoxelWorld world = build_world(scene);
    Aimed aimed{.origin = world.origin()};
    aimed.lights = find_lights(scene, &world, aimed.origin);
    aimed.aims = find_photon_aims(scene, aimed.lights, aimed.origin);
    return aimed;
}

constexpr int kNoCell = -1;

// The numbers of the cells of a map that points of its grid lie in, or kNoCell.
std::vector<int> cells_of(const std::vector<glm::dvec2>& points, const PhotonAims& aims,
                          const gpu::AimMap& map) {
    std::vector<int> numbers(std::size_t{gpu::kAimEdge} * gpu::kAimEdge, kNoCell);
    for (gpu::uint i = 0; i < map.count; ++i) {
        const gpu::AimCell cell = gpu::unpack_aim_cell(aims.cells[map.first + i]);
        numbers[cell.row * gpu::kAimEdge + cell.column] = static_cast<int>(i);
    }
    std::vector<int> found;
    for (const glm::dvec2& point : points) {
        const glm::dvec2 cell = glm::floor((point - glm::dvec2(map.low)) / glm::dvec2(map.cell));
        const bool is_inside = glm::all(glm::greaterThanEqual(cell, glm::dvec2(0.0))) &&
                               glm::all(glm::lessThan(cell, glm::dvec2(gpu::kAimEdge)));
        const glm::uvec2 place(is_inside ? cell : glm::dvec2(0.0));
        found.push_back(is_inside ? numbers[place.y * gpu::kAimEdge + place.x] : kNoCell);
    }
    return found;
}

// A map without one of its cells.
PhotonAims without_cell(PhotonAims aims, gpu::AimMap& map, int lost) {
    aims.cells[map.first + static_cast<gpu::uint>(lost)] = aims.cells[map.first + map.count - 1];
    --map.count;
    return aims;
}

// All points lie in cells of the map, and without one of these cells they do not.
void expect_complete(const std::vector<glm::dvec2>& points, const PhotonAims& aims, gpu::AimMap map) {
    ASSERT_GT(points.size(), 1000u);
    const std::vector<int> cells = cells_of(points, aims, map);
    EXPECT_EQ(std::ranges::count(cells, kNoCell), 0);
    const PhotonAims poorer = without_cell(aims, map, cells.front());
    EXPECT_GT(std::ranges::count(cells_of(points, poorer, map), kNoCell), 0) << "the negative control";
}

// Whether a ray meets the glass or the mirror of lit_scene(), whatever else is in its way.
bool meets_specular(const Scene& scene, const glm::dvec3& from, const glm::dvec3& direction) {
    const glm::dvec3 to_ball = scene.spheres[0].centre - from;
    const double along = glm::dot(to_ball, direction);
    if (along > 0.0 && glm::length(to_ball - along * direction) < scene.spheres[0].radius) return true;
    const glm::dvec3 a = (glm::dvec3(4.0, -2.0, 0.0) - from) / direction;
    const glm::dvec3 b = (glm::dvec3(5.0, 2.0, 3.0) - from) / direction;
    const glm::dvec3 in = glm::min(a, b), out = glm::max(a, b);
    const double last = std::min({out.x, out.y, out.z});
    return last > 0.0 && std::max({in.x, in.y, in.z}) < last;
}

double turn_of(double x, double y) {
    const double turn = std::atan2(y, x) / (2.0 * std::numbers::pi);
    return turn < 0.0 ? turn + 1.0 : turn;
}

TEST(PhotonAims, no_direction_of_a_face_misses_what_is_specular) {
    const Scene scene = lit_scene();
    const Aimed aimed = aim(scene);
    Draws draw;
    std::vector<glm::dvec2> points;
    for (int i = 0; i < 100000; ++i) {
        const glm::dvec3 from = draw.in({0.0, 6.0, 6.0}, {1.0, 7.0, 6.0}), way = draw.direction();
        if (way.z < 0.0 && meets_specular(scene, from, way))
            points.emplace_back(turn_of(way.x, way.y), 1.0 - way.z * way.z);
    }
    for (std::size_t light = 0; light < aimed.lights.records.size(); ++light) {
        const gpu::LightParts parts = gpu::light_parts(aimed.lights.records[light].what);
        if (parts.kind == gpu::kLightFace && parts.face == 4u)  // looks down
            expect_complete(points, aimed.aims, aimed.aims.maps[aimed.aims.map_of_light[light]]);
    }
}

TEST(PhotonAims, no_direction_of_a_ball_misses_what_is_specular) {
    const Scene scene = lit_scene();
    const Aimed aimed = aim(scene);
    ASSERT_EQ(gpu::light_parts(aimed.lights.records[0].what).kind, gpu::kLightSphere);
    Draws draw;
    std::vector<glm::dvec2> points;
    for (int i = 0; i < 100000; ++i) {
        const glm::dvec3 normal = draw.direction(), way = draw.direction();
        const glm::dvec3 from = scene.spheres[1].centre + scene.spheres[1].radius * normal;
        if (glm::dot(normal, way) > 0.0 && meets_specular(scene, from, way))
            points.emplace_back(turn_of(way.x, way.y), 0.5 * (1.0 - way.z));
    }
    expect_complete(points, aimed.aims, aimed.aims.maps[aimed.aims.map_of_light[0]]);
}

// Sunlight of all directions of a wide sun that goes through points of the ball and of the mirror.
TEST(PhotonAims, no_place_on_the_disc_misses_what_is_specular) {
    Scene scene = lit_scene();
    scene.sun = {.azimuth_deg = 30.0f, .elevation_deg = 40.0f, .angular_diameter_deg = 20.0f};
    const Aimed aimed = aim(scene);
    const gpu::vec3 sun = scene.sun.direction();
    const float height = gpu::cone_height(static_cast<float>(std::numbers::pi / 18.0));
    Draws draw;
    std::vector<glm::dvec2> points;
    for (int i = 0; i < 50000; ++i) {
        const glm::dvec3 thing = i % 2 == 0 ? scene.spheres[0].centre + 1.5 * draw.direction()
                                            : draw.in({4.0, -2.0, 0.0}, {5.0, 2.0, 3.0});
        const glm::dvec3 place = thing - glm::dvec3(aimed.origin) - aimed.lights.sun_disc.centre;
        const gpu::vec2 u(static_cast<float>(draw()), static_cast<float>(draw()));
        // The axes of the plane that this direction of the sun is seen from.
        const glm::dvec3 across(gpu::aimed_sun(sun, height, u, {1.0f, 0.0f}, 0.0f).place);
        const glm::dvec3 along(gpu::aimed_sun(sun, height, u, {0.0f, 1.0f}, 0.0f).place);
        points.emplace_back(glm::dot(place, across), glm::dot(place, along));
    }
    expect_complete(points, aimed.aims, aimed.aims.maps[0]);
    EXPECT_LT(aimed.aims.sun_area, std::numbers::pi * std::pow(aimed.lights.sun_disc.radius, 2.0));
}

TEST(PhotonAims, points_fill_all_marked_cells_evenly) {
    const Aimed aimed = aim(lit_scene());
    const gpu::AimMap& map = aimed.aims.maps[aimed.aims.map_of_light[0]];
    const auto side = static_cast<int>(map.count);
    std::vector<int> met(map.count);
    // As many points as there are cells, times 8 x 8: each one gets as many but for those of its borders.
    for (int i = 0; i < 8 * side; ++i) {
        for (int j = 0; j < 8; ++j) {
            const float along = (static_cast<float>(i) + 0.5f) / static_cast<float>(8 * side);
            const gpu::AimCell row =
                gpu::unpack_aim_cell(aimed.aims.cells[map.first + gpu::aim_number(along, map.count)]);
            const float across = (static_cast<float>(j) + 0.5f) / 8.0f;
            const gpu::uint number = row.row_first + gpu::aim_number(across, row.row_count);
            const gpu::AimCell cell = gpu::unpack_aim_cell(aimed.aims.cells[map.first + number]);
            EXPECT_EQ(cell.row, row.row);
            const gpu::vec2 point = gpu::aim_point(map, row, cell.column, {across, along});
            const gpu::vec2 part = (point - map.low) / map.cell - gpu::vec2(cell.column, cell.row);
            EXPECT_NEAR(part.x, 0.5f, 0.501f);
            EXPECT_NEAR(part.y, 0.5f, 0.501f);
            ++met[number];
        }
    }
    int of_all = 0;
    for (const int count : met)
        of_all += count;
    EXPECT_EQ(of_all, 64 * side);
}

TEST(PhotonAims, emitters_carry_what_their_maps_let_through) {
    const Aimed aimed = aim(lit_scene());
    double power = 0.0, drawn = 0.0;
    for (std::size_t i = 0; i < aimed.lights.records.size(); ++i) {
        const bool is_ball = gpu::light_parts(aimed.lights.records[i].what).kind == gpu::kLightSphere;
        const double whole =
            is_ball ? 6.0 * 4.0 * std::numbers::pi * std::numbers::pi * 0.25 : 9.0 * std::numbers::pi;
        const gpu::AimMap& map = aimed.aims.maps[aimed.aims.map_of_light[i]];
        power += whole * map.count * static_cast<double>(map.cell.x) * static_cast<double>(map.cell.y);
        drawn += static_cast<double>(aimed.aims.table[i].pdf);
        EXPECT_EQ(aimed.aims.table[i].pdf > 0.0f, map.count != 0u);
    }
    EXPECT_NEAR(aimed.aims.power, power, 1e-5 * power);
    EXPECT_NEAR(drawn, 1.0, 1e-6);
    EXPECT_LT(aimed.aims.power, 0.3 * aimed.lights.power);
}

// Hard cases: no target, one voxel, the whole sky of directions.

TEST(PhotonAims, without_a_target_carry_nothing) {
    Scene scene = lit_scene();
    for (Material& material : scene.materials)
        material = {.name = "diffuse", .emission = material.emission, .surface = material.surface};
    for (Material& material : scene.materials)
        if (gpu::brightness(material.emission) == 0.0f) material.surface = Surface::diffuse;
    const Aimed aimed = aim(scene);
    EXPECT_TRUE(aimed.lights.specular.empty());
    EXPECT_GT(aimed.lights.power, 0.0);
    EXPECT_EQ(aimed.aims.power, 0.0);
    EXPECT_EQ(aimed.aims.sun_area, 0.0);
    EXPECT_TRUE(aimed.aims.cells.empty());
}

TEST(PhotonAims, towards_one_far_voxel_are_as_narrow_as_it_is_seen) {
    Scene scene = test::dark_scene(16, 1000, 0.5);
    test::add_box(scene, {0, 0, 0}, {1, 1, 1}, test::add_mirror(scene));
    test::add_box(scene, {0, 0, 40}, {1, 1, 41}, test::add_emitter(scene, 1.0f));
    const Aimed aimed = aim(scene);
    ASSERT_EQ(aimed.lights.specular.size(), 1u);
    // Seen from above, 39 voxels away: a form factor of 1 / (pi 39^2). The cone and its cells are wider.
    const double seen = 1.0 / (std::numbers::pi * 39.0 * 39.0);
    double widest = 0.0;
    for (std::size_t i = 0; i < aimed.lights.records.size(); ++i) {
        const gpu::AimMap& map = aimed.aims.maps[aimed.aims.map_of_light[i]];
        widest = std::max(widest, static_cast<double>(gpu::aim_area(map)));
        const gpu::LightParts parts = gpu::light_parts(aimed.lights.records[i].what);
        EXPECT_EQ(map.count == 0u, parts.face == 5u) << "the face that looks away";
    }
    EXPECT_GT(widest, seen);
    EXPECT_LT(widest, 12.0 * seen);
}

TEST(PhotonAims, of_an_emitter_within_glass_go_everywhere) {
    Scene scene = test::dark_scene(16, 1000, 0.5);
    test::add_box(scene, {0, 0, 0}, {1, 1, 1}, test::add_emitter(scene, 1.0f));
    scene.spheres = {{{0.5, 0.5, 0.5}, 4.0, test::add_glass(scene, 1.5f)}};
    const Aimed aimed = aim(scene);
    ASSERT_EQ(aimed.lights.records.size(), 6u);
    EXPECT_NEAR(aimed.aims.power, aimed.lights.power, 1e-6 * aimed.lights.power);
}

}  // namespace
}  // namespace voxilux

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>
#include <tuple>

#include "formats/scene_toml.h"
#include "scene/scene_bounds.h"
#include "scene/shapes.h"
#include "support/scene_voxels.h"

namespace voxilux {
namespace {

using ShapeCells = std::map<std::tuple<int, int, int>, int>;

// Every cell of a box in which `holds` is true.
template <class Holds>
ShapeCells filtered(glm::ivec3 lo, glm::ivec3 hi, int material, const Holds& holds) {
    ShapeCells cells;
    for (int z = lo.z; z < hi.z; ++z)
        for (int y = lo.y; y < hi.y; ++y)
            for (int x = lo.x; x < hi.x; ++x)
                if (holds(glm::ivec3(x, y, z))) cells[{x, y, z}] = material;
    return cells;
}

// What the scene's instances fill, each cell once.
ShapeCells shape_cells_of(const Scene& scene) {
    ShapeCells cells;
    test::for_each_scene_voxel(scene, [&](glm::ivec3 c, std::uint16_t material) {
        EXPECT_TRUE(cells.insert({{c.x, c.y, c.z}, material}).second) << "a cell twice";
    });
    for (const VoxelModel& model : scene.models)
        for (const VoxelBox& box : model.boxes)
            EXPECT_EQ(united(box.cells, {{0, 0, 0}, model.size}), (Box{{0, 0, 0}, model.size}));
    return cells;
}

ShapeCells drawn(const std::vector<Shape>& shapes) {
    VoxelGrid grid;
    for (const Shape& shape : shapes)
        draw_shape(grid, shape);
    Scene scene;
    grid.append_to(scene, "test");
    return shape_cells_of(scene);
}

template <class Holds>
auto shell_of(const Holds& holds) {
    return [holds](glm::ivec3 c) {
        if (!holds(c)) return false;
        for (int axis = 0; axis < 3; ++axis) {
            glm::ivec3 step(0);
            step[axis] = 1;
            if (!holds(c + step) || !holds(c - step)) return true;
        }
        return false;
    };
}

TEST(SceneShape, boxes_equal_brute_force) {
    std::mt19937 random(3);
    const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    for (int trial = 0; trial < 60; ++trial) {
        const glm::ivec3 from(below(30) - 15, below(30) - 15, below(30) - 15);
        const glm::ivec3 to = from + glm::ivec3(1 + below(12), 1 + below(12), 1 + below(12));
        const auto holds = [&](glm::ivec3 c) {
            return glm::all(glm::greaterThanEqual(c, from)) && glm::all(glm::lessThan(c, to));
        };
        const ShapeCells solid = drawn({BoxShape{from, to, false, std::uint16_t{5}}});
        EXPECT_EQ(solid, filtered(from - 2, to + 2, 5, holds));
        EXPECT_EQ(drawn({BoxShape{from, to, true, std::uint16_t{5}}}),
                  filtered(from - 2, to + 2, 5, shell_of(holds)));
        // Negative control: one cell more must be noticed.
        EXPECT_NE(solid, filtered(from - 2, to + 2, 5, [&](glm::ivec3 c) { return holds(c) || c == to; }));
    }
}

TEST(SceneShape, balls_equal_brute_force) {
    std::mt19937 random(4);
    const auto unit = [&] { return static_cast<double>(random()) / 4294967296.0; };
    for (int trial = 0; trial < 80; ++trial) {
        // Every other ball sits on lattice points with a whole radius, where cells lie exactly on its
        // surface.
        const bool exact = trial % 2 == 0;
        glm::dvec3 centre(20 * unit() - 10, 20 * unit() - 10, 20 * unit() - 10);
        double radius = 0.3 + 9 * unit();
        if (exact) {
            centre = glm::floor(centre) + 0.5;
            radius = std::ceil(radius);
        }
        const auto holds = [&](glm::ivec3 c) {
            const glm::dvec3 d = glm::dvec3(c) + 0.5 - centre;
            return d.x * d.x + d.y * d.y + d.z * d.z <= radius * radius;
        };
        const glm::ivec3 lo(-22), hi(22);
        EXPECT_EQ(drawn({BallShape{centre, radius, false, std::uint16_t{1}}}), filtered(lo, hi, 1, holds));
        EXPECT_EQ(drawn({BallShape{centre, radius, true, std::uint16_t{1}}}),
                  filtered(lo, hi, 1, shell_of(holds)));
    }
}

TEST(SceneShape, later_shape_wins_and_air_carves) {
    const BoxShape block{{0, 0, 0}, {9, 9, 9}, false, std::uint16_t{1}};
    const BoxShape core{{3, 3, 3}, {6, 6, 6}, false, std::uint16_t{2}};
    const BoxShape shaft{{4, 4, 0}, {5, 5, 9}, false, std::nullopt};
    ShapeCells wanted = filtered({0, 0, 0}, {9, 9, 9}, 1, [](glm::ivec3 c) { return c.x != 4 || c.y != 4; });
    for (auto& [cell, material] : wanted) {
        const auto [x, y, z] = cell;
        if (x >= 3 && x < 6 && y >= 3 && y < 6 && z >= 3 && z < 6) material = 2;
    }
    EXPECT_EQ(drawn({block, core, shaft}), wanted);
    EXPECT_NE(drawn({shaft, block, core}), wanted);
    EXPECT_TRUE(drawn({shaft}).empty());
}

TEST(SceneShape, carving_everything_leaves_no_model) {
    VoxelGrid grid;
    draw_shape(grid, BoxShape{{0, 0, 0}, {9, 9, 9}, false, std::uint16_t{1}});
    draw_shape(grid, BoxShape{{-1, -1, -1}, {10, 10, 10}, false, std::nullopt});
    Scene scene;
    grid.append_to(scene, "test");
    EXPECT_TRUE(scene.models.empty());
    EXPECT_TRUE(scene.instances.empty());
}

TEST(SceneShape, wide_scene_is_one_model) {
    constexpr int kEnd = kMaxGridCoordinate;
    const BoxShape near{{-70000, 3, -5}, {70000, 4, -4}, false, std::uint16_t{3}};
    const BoxShape low{{-kEnd, -kEnd, -kEnd}, {-kEnd + 1, -kEnd + 1, -kEnd + 1}, false, std::uint16_t{4}};
    const BoxShape high{{kEnd - 1, kEnd - 1, kEnd - 1}, {kEnd, kEnd, kEnd}, false, std::uint16_t{5}};
    const ShapeCells cells = drawn({near, low, high});
    EXPECT_EQ(cells.size(), 140002u);
    EXPECT_EQ(cells.at({-kEnd, -kEnd, -kEnd}), 4);
    EXPECT_EQ(cells.at({kEnd - 1, kEnd - 1, kEnd - 1}), 5);
    for (const int x : {-70000, -1, 0, 65535, 69999})
        EXPECT_EQ(cells.at({x, 3, -5}), 3);
}

// Shapes whose cells would take gigabytes: 645^3 cells of a solid box, 2.6e8 of a shell.
TEST(SceneShapeNightly, large_boxes_are_few_boxes) {
    const BoxShape solid{{0, 0, 0}, {645, 645, 645}, false, std::uint16_t{1}};
    const BoxShape room{{0, 0, 0}, {16000, 8000, 200}, true, std::uint16_t{1}};
    for (const BoxShape& box : {solid, room}) {
        VoxelGrid grid;
        draw_shape(grid, box);
        Scene scene;
        grid.append_to(scene, "test");
        ASSERT_EQ(scene.models.size(), 1u);
        std::int64_t cells = 0;
        for (const VoxelBox& part : scene.models[0].boxes)
            cells += part.cells.volume();
        const Box whole{box.from, box.to}, inside{box.from + 1, box.to - 1};
        EXPECT_EQ(cells, whole.volume() - (box.hollow ? inside.volume() : 0));
        EXPECT_LE(scene.models[0].boxes.size(), box.hollow ? 6u : 1u);
    }
}

// Rows of random runs, among them air, equal a plain array of cells; joined boxes touch without being alike.
TEST(SceneShape, rows_equal_brute_force) {
    std::mt19937 random(6);
    const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    for (int trial = 0; trial < 40; ++trial) {
        VoxelGrid grid;
        ShapeCells wanted;
        for (int i = 0; i < 60; ++i) {
            const int x0 = below(12), x1 = x0 + below(8), y = below(3), z = below(4) - 2;
            const int material = below(3);
            grid.fill_row(x0, x1, {y, z}, material == 0 ? Filling() : Filling(material));
            for (int x = x0; x < x1; ++x) {
                wanted.erase({x, y, z});
                if (material != 0) wanted[{x, y, z}] = material;
            }
        }
        Scene scene;
        grid.append_to(scene, "test");
        EXPECT_EQ(shape_cells_of(scene), wanted);
        for (int y = 0; y < 3; ++y)
            for (int x = 0; x < 20; ++x) {
                std::optional<int> top;
                for (int z = -2; z < 2; ++z)
                    if (wanted.contains({x, y, z})) top = z;
                EXPECT_EQ(grid.top_of_column(x, y), top);
            }
    }
}

int terrain_height(const TerrainShape& terrain, int x, int y) {
    int height = 0;
    terrain_heights(terrain, x, y, {&height, 1});
    return height;
}

TEST(SceneTerrain, rows_equal_their_columns) {
    for (const int feature : {1, 3, 9, 64, 65536}) {
        const TerrainShape terrain{
            .from = {-70, -5, 0}, .to = {71, 6, 300}, .seed = 7, .feature = feature, .island = feature == 9};
        std::vector<int> row(141);
        for (int y = -5; y < 6; ++y) {
            terrain_heights(terrain, -70, y, row);
            for (int x = -70; x < 71; ++x)
                ASSERT_EQ(row[static_cast<std::size_t>(x + 70)], terrain_height(terrain, x, y))
                    << x << ' ' << y;
        }
    }
}

TEST(SceneTerrain, columns_are_filled_to_their_height_in_layers) {
    const TerrainShape terrain{.from = {-20, -10, -3}, .to = {25, 18, 13}, .seed = 5, .feature = 9};
    const ShapeCells cells =
        drawn({GroundShape{terrain, {std::uint16_t{7}, std::nullopt, std::uint16_t{8}}}});
    ShapeCells wanted;
    std::set<int> heights;
    for (int y = -10; y < 18; ++y) {
        for (int x = -20; x < 25; ++x) {
            const int height = terrain_height(terrain, x, y);
            heights.insert(height);
            ASSERT_GE(height, 0);
            ASSERT_LE(height, 16);
            for (int z = 0; z < height; ++z)
                if (z * 3 / 16 != 1) wanted[{x, y, -3 + z}] = z * 3 / 16 == 0 ? 7 : 8;
        }
    }
    EXPECT_EQ(cells, wanted);
    EXPECT_GT(heights.size(), 8u);  // hills, not a plate
}

TEST(SceneTerrain, neighbours_differ_by_little) {
    const TerrainShape terrain{.from = {-200, -200, 0}, .to = {200, 200, 100}, .seed = 1, .feature = 64};
    for (int y = -200; y < 199; ++y)
        for (int x = -200; x < 199; ++x) {
            const int here = terrain_height(terrain, x, y);
            // The steepest octave rises 1.5 / 8 cells of its 8/15 weight per voxel and the stretch doubles
            // it: far less than the 12 allowed, and a seam between lattice cells would jump by tens.
            ASSERT_LE(std::abs(here - terrain_height(terrain, x + 1, y)), 12) << x << ' ' << y;
            ASSERT_LE(std::abs(here - terrain_height(terrain, x, y + 1)), 12) << x << ' ' << y;
        }
}

TEST(SceneTerrain, island_sinks_at_its_sides) {
    const TerrainShape terrain{.from = {0, 0, 0}, .to = {65, 65, 40}, .seed = 2, .island = true};
    for (int i = 0; i < 65; ++i) {
        EXPECT_LE(terrain_height(terrain, i, 0), 1);
        EXPECT_LE(terrain_height(terrain, 64, i), 1);
    }
    EXPECT_GE(terrain_height(terrain, 32, 32), 10);  // at least a quarter of the height in the middle
}

// Fixed values: the same scene on every machine and in every release.
TEST(SceneTerrain, heights_are_stable) {
    const TerrainShape terrain{.from = {-64, -64, 0}, .to = {64, 64, 1000}, .seed = 42, .feature = 32};
    std::uint64_t mix = 0;
    for (int y = -64; y < 64; ++y)
        for (int x = -64; x < 64; ++x)
            mix = mix * 6364136223846793005u + static_cast<std::uint64_t>(terrain_height(terrain, x, y));
    EXPECT_EQ(mix, 15801718597151061885u);
    TerrainShape other = terrain;
    other.seed = 43;
    EXPECT_NE(terrain_height(other, 3, 3), terrain_height(terrain, 3, 3));
}

TEST(SceneTree, stands_on_the_ground_of_its_column) {
    const Scene scene = parse_scene(
        "[material.a]\n[material.b]\n[material.c]\n"
        "[[shape]]\nshape = \"box\"\nfrom = [-20,-20,-3]\nto = [20,20,5]\nmaterial = \"a\"\n"
        "[[shape]]\nshape = \"tree\"\nbase = [-9, 4]\nheight = 12\ncrown = 4\ntrunk = \"b\"\nleaves = "
        "\"c\"\n",
        "s.toml");
    const ShapeCells cells = shape_cells_of(scene);
    for (int z = 5; z < 17; ++z)
        EXPECT_EQ(cells.at({-9, 4, z}), 1) << z;
    int leaves = 0;
    for (const auto& [cell, material] : cells) {
        if (material != 2) continue;
        ++leaves;
        const auto [x, y, z] = cell;
        const glm::dvec3 d = glm::dvec3(x, y, z) + 0.5 - glm::dvec3(-8.5, 4.5, 17.0);
        EXPECT_LE(glm::length(d), 4.0);
    }
    // Between the ball of two thirds of the radius, which is always full, and the whole one.
    EXPECT_GT(leaves, 60);
    EXPECT_LT(leaves, 268);
}

}  // namespace
}  // namespace voxilux

// A mesh to voxels: coverage, thin and solid, colours, threads.

#include "voxelizer/voxelize_mesh.h"

#include <gtest/gtest.h>

#include <bit>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <tuple>

#include "base/error.h"
#include "support/mesh_shapes.h"
#include "voxelizer/surface_look.h"
#include "voxelizer/vox_output.h"
#include "voxelizer/winding_number.h"

namespace voxilux {
namespace {

using test::cube;
using test::mesh_of;
using test::torus;
using Cell = std::tuple<int, int, int>;
using Colours = std::map<Cell, ColouredVoxel>;

VoxelizeRequest request_at(int resolution) {
    return {.grid = {.resolution = resolution, .up = UpAxis::z}, .threads = 1};
}

glm::ivec3 cell_of(const VoxelBlock& block, const ColouredVoxel& voxel) {
    return block.low / kModelCells * kModelCells + glm::ivec3(voxel.x, voxel.y, voxel.z);
}

Colours surface_of(const VoxelSet& set) {
    Colours colours;
    for (const VoxelBlock& block : set.blocks) {
        for (const ColouredVoxel& voxel : block.surface) {
            const glm::ivec3 c = cell_of(block, voxel);
            EXPECT_TRUE(colours.emplace(Cell{c.x, c.y, c.z}, voxel).second) << "a cell comes once";
        }
    }
    return colours;
}

std::set<Cell> cells_of(const VoxelSet& set) {
    std::set<Cell> cells;
    for (const auto& [cell, voxel] : surface_of(set))
        cells.insert(cell);
    return cells;
}

std::set<Cell> interior_of(const VoxelSet& set) {
    std::set<Cell> cells;
    for (const VoxelBlock& block : set.blocks) {
        for (const InteriorRow& row : block.interior) {
            for (std::uint64_t rest = row.cells; rest != 0; rest &= rest - 1) {
                const glm::ivec3 c = block.low + glm::ivec3(std::countr_zero(rest), row.row % kBlockCells,
                                                            row.row / kBlockCells);
                EXPECT_TRUE(cells.insert(Cell{c.x, c.y, c.z}).second);
            }
        }
    }
    return cells;
}

// The cells that a 6-connected walk from outside the grid reaches without crossing set cells.
std::set<Cell> outside_of(const std::set<Cell>& cells, glm::ivec3 size) {
    std::set<Cell> seen;
    std::vector<glm::ivec3> open = {{-1, -1, -1}};
    while (!open.empty()) {
        const glm::ivec3 c = open.back();
        open.pop_back();
        if (glm::any(glm::lessThan(c, glm::ivec3(-1))) || glm::any(glm::greaterThan(c, size))) continue;
        if (cells.contains(Cell{c.x, c.y, c.z}) || !seen.insert(Cell{c.x, c.y, c.z}).second) continue;
        for (int axis = 0; axis < 3; ++axis) {
            for (const int step : {-1, 1}) {
                glm::ivec3 next = c;
                next[axis] += step;
                open.push_back(next);
            }
        }
    }
    return seen;
}

// The winding number of a closed mesh about a point. Source: A. van Oosterom and J. Strackee, "The Solid
// Angle of a Plane Triangle", 1983.
double winding_about(const Mesh& mesh, glm::dvec3 p) {
    double sum = 0.0;
    for (const MeshTriangle& t : mesh.triangles) {
        const glm::dvec3 a = mesh.positions[t.vertices.x] - p;
        const glm::dvec3 b = mesh.positions[t.vertices.y] - p;
        const glm::dvec3 c = mesh.positions[t.vertices.z] - p;
        const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
        sum += 2.0 * std::atan2(glm::dot(a, glm::cross(b, c)), la * lb * lc + glm::dot(a, b) * lc +
                                                                   glm::dot(b, c) * la + glm::dot(c, a) * lb);
    }
    return sum / (4.0 * 3.141592653589793);
}

glm::dvec3 middle_of(const VoxelSet& set, const Cell& cell) {
    const auto [x, y, z] = cell;
    return set.grid.low + (glm::dvec3(x, y, z) + 0.5) / set.grid.scale;
}

TEST(VoxelizeMesh, grid_follows_the_longest_side) {
    const VoxelSet set = voxelize_mesh(cube({-1, 2, 5}, {3, 4, 6}), request_at(64));
    EXPECT_EQ(set.grid.cells, glm::ivec3(64, 32, 16));
    VoxelizeRequest metres = request_at(64);
    metres.grid.metres_per_voxel = 0.5;
    EXPECT_EQ(voxelize_mesh(cube({-1, 2, 5}, {3, 4, 6}), metres).grid.cells, glm::ivec3(8, 4, 2));
}

TEST(VoxelizeMesh, y_up_turns_x_y_z_to_x_minus_z_y) {
    const MeshGrid grid = grid_of(cube({0, 0, 0}, {4, 2, 1}), {.resolution = 4});
    EXPECT_EQ(grid.cells, glm::ivec3(4, 1, 2));
    EXPECT_EQ(grid.to_grid({1, 2, 1}), glm::dvec3(1, 0, 2));
    for (const UpAxis up :
         {UpAxis::x, UpAxis::y, UpAxis::z, UpAxis::minus_x, UpAxis::minus_y, UpAxis::minus_z}) {
        for (int turns = 0; turns < 4; ++turns)
            EXPECT_EQ(glm::determinant(grid_of(cube({0, 0, 0}, {4, 2, 1}),
                                               {.resolution = 4, .up = up, .quarter_turns = turns})
                                           .axes),
                      1.0);
    }
}

TEST(VoxelizeMesh, cube_on_grid_planes_is_its_shell) {
    const std::set<Cell> cells = cells_of(voxelize_mesh(cube({0, 0, 0}, {1, 1, 1}), request_at(80)));
    EXPECT_EQ(cells.size(), 80u * 80 * 80 - 78u * 78 * 78);
}

// Each point of the surface lies in a cell that is set; the file is cut into blocks at 64.
TEST(VoxelizeMesh, points_of_the_surface_lie_in_voxels) {
    const Mesh mesh = torus(1.0, 0.4, 37, 17);
    const VoxelSet set = voxelize_mesh(mesh, request_at(150));
    std::set<Cell> cells = cells_of(set);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> part(0.0, 1.0);
    const auto is_covered = [&](glm::dvec3 p) {
        const glm::ivec3 c(glm::floor(set.grid.to_grid(p)));
        return cells.contains(Cell{c.x, c.y, c.z});
    };
    std::vector<glm::dvec3> points;
    for (const MeshTriangle& t : mesh.triangles) {
        for (int i = 0; i < 20; ++i) {
            const double a = part(random), b = part(random) * (1.0 - a);
            points.push_back(mesh.positions[t.vertices.x] * a + mesh.positions[t.vertices.y] * b +
                             mesh.positions[t.vertices.z] * (1.0 - a - b));
        }
    }
    // Points within the lattice's rounding of a cell's face may lie on its other side.
    std::size_t missing = 0;
    for (const glm::dvec3 p : points)
        missing += is_covered(p) ? 0 : 1;
    EXPECT_LE(missing, points.size() / 500);
    cells.erase(cells.begin(), std::next(cells.begin(), static_cast<std::ptrdiff_t>(cells.size() / 10)));
    std::size_t missing_then = 0;
    for (const glm::dvec3 p : points)
        missing_then += is_covered(p) ? 0 : 1;
    EXPECT_GT(missing_then, points.size() / 50);
}

TEST(VoxelizeMesh, thin_surface_is_part_of_the_conservative_one_and_keeps_inside_and_outside_apart) {
    const Mesh mesh = torus(1.0, 0.35, 23, 11);
    VoxelizeRequest request = request_at(44);
    const VoxelSet whole = voxelize_mesh(mesh, request);
    request.coverage = Coverage::thin;
    const VoxelSet thin = voxelize_mesh(mesh, request);
    const std::set<Cell> all = cells_of(whole);
    std::set<Cell> cells = cells_of(thin);
    EXPECT_LT(cells.size(), all.size() * 3 / 4);
    EXPECT_TRUE(std::ranges::includes(all, cells));
    const std::set<Cell> outside = outside_of(cells, thin.grid.cells);
    std::size_t inside = 0;
    for (int i = 0; i < 44 * 44 * 44; ++i) {
        const Cell cell{i % 44, i / 44 % 44, i / 1936};
        const bool is_in_grid = i / 44 % 44 < thin.grid.cells.y && i / 1936 < thin.grid.cells.z;
        if (!is_in_grid || cells.contains(cell) || outside.contains(cell)) continue;
        ++inside;
        EXPECT_GT(winding_about(mesh, middle_of(thin, cell)), 0.5);
    }
    EXPECT_GT(inside, 200u);
    // Removing a voxel that separates the outside from the inside leaves a hole.
    for (const auto& [x, y, z] : std::set<Cell>(cells)) {
        const bool is_wall = outside.contains(Cell{x - 1, y, z}) && !outside.contains(Cell{x + 1, y, z}) &&
                             !cells.contains(Cell{x + 1, y, z});
        if (!is_wall) continue;
        cells.erase(Cell{x, y, z});
        EXPECT_GT(outside_of(cells, thin.grid.cells).size(), outside.size() + 200);
        return;
    }
    FAIL() << "no wall of one voxel";
}

TEST(VoxelizeMesh, solid_fill_is_where_the_winding_number_is_one) {
    const Mesh mesh = torus(1.0, 0.35, 23, 11);
    VoxelizeRequest request = request_at(44);
    request.is_solid = true;
    const VoxelSet set = voxelize_mesh(mesh, request);
    EXPECT_EQ(set.solid.open_edges, 0u);
    EXPECT_EQ(set.solid.open_rows, 0u);
    EXPECT_EQ(set.solid.disputed, 0u);
    const std::set<Cell> inside = interior_of(set);
    const std::set<Cell> surface = cells_of(set);
    EXPECT_EQ(inside.size(), set.interior);
    for (int i = 0; i < 44 * 44 * 44; i += 7) {
        const Cell cell{i % 44, i / 44 % 44, i / 1936};
        if (surface.contains(cell)) {
            EXPECT_FALSE(inside.contains(cell));
        } else {
            EXPECT_EQ(inside.contains(cell), winding_about(mesh, middle_of(set, cell)) > 0.5);
        }
    }
}

TEST(VoxelizeMesh, blocks_without_surface_are_filled) {
    VoxelizeRequest request = request_at(200);
    request.is_solid = true;
    const VoxelSet set = voxelize_mesh(cube({0, 0, 0}, {1, 1, 1}), request);
    EXPECT_EQ(set.interior, 198u * 198 * 198);
}

TEST(VoxelizeMesh, open_mesh_is_reported_and_by_parity_not_filled_past_its_hole) {
    Mesh mesh = cube({0, 0, 0}, {1, 1, 1});
    mesh.triangles.erase(mesh.triangles.begin(), mesh.triangles.begin() + 2);  // the face at x = 0
    VoxelizeRequest request = request_at(32);
    request.is_solid = true;
    request.inside = InsideRule::parity;
    const VoxelSet set = voxelize_mesh(mesh, request);
    EXPECT_EQ(set.solid.open_edges, 4u);
    EXPECT_EQ(set.solid.open_rows, 32u * 32);
    EXPECT_EQ(set.interior, 0u);
}

TEST(VoxelizeMesh, overlap_is_where_parity_and_winding_disagree) {
    Mesh mesh = cube({0, 0, 0}, {4, 4, 4});
    test::append(mesh, cube({2, 2, 2}, {8, 8, 8}));
    VoxelizeRequest request = request_at(16);
    request.is_solid = true;
    const VoxelSet set = voxelize_mesh(mesh, request);
    EXPECT_EQ(set.solid.open_edges, 0u);
    EXPECT_EQ(set.solid.disputed, 4u * 4 * 4);
}

// Two cubes of 4 overlap by half: together 6 x 4 x 4 cells, of which 2 x 2 x 2 are in both and touch no
// surface.
TEST(VoxelizeMesh, overlapping_parts_are_one_by_winding_number_and_hollow_by_parity) {
    Mesh mesh = cube({0, 0, 0}, {4, 4, 4});
    test::append(mesh, cube({2, 0, 0}, {6, 4, 4}));
    VoxelizeRequest request = request_at(6);
    request.is_solid = true;
    const auto voxels = [&] {
        const VoxelSet set = voxelize_mesh(mesh, request);
        return set.surface + set.interior;
    };
    EXPECT_EQ(voxels(), 96u);
    request.inside = InsideRule::parity;
    EXPECT_EQ(voxels(), 92u);
}

TEST(VoxelizeMesh, cavity_stays_hollow_where_its_wall_faces_inwards) {
    Mesh mesh = cube({0, 0, 0}, {30, 30, 30});
    Mesh cavity = cube({10, 10, 10}, {20, 20, 20});
    for (MeshTriangle& triangle : cavity.triangles)
        std::swap(triangle.vertices.x, triangle.vertices.y);
    test::append(mesh, cavity);
    VoxelizeRequest request = request_at(30);
    request.is_solid = true;
    const VoxelSet set = voxelize_mesh(mesh, request);
    EXPECT_FALSE(interior_of(set).contains(Cell{15, 15, 15}));
    EXPECT_TRUE(interior_of(set).contains(Cell{5, 5, 5}));
    EXPECT_EQ(set.solid.open_edges + set.solid.turned_edges, 0u);
}

TEST(VoxelizeMesh, closed_mesh_that_is_not_oriented_is_filled_by_parity) {
    Mesh mesh = cube({0, 0, 0}, {1, 1, 1});
    for (const std::size_t turned : {0u, 5u, 6u})
        std::swap(mesh.triangles[turned].vertices.x, mesh.triangles[turned].vertices.y);
    VoxelizeRequest request = request_at(20);
    request.is_solid = true;
    const VoxelSet set = voxelize_mesh(mesh, request);
    EXPECT_EQ(set.interior, 18u * 18 * 18);
    EXPECT_EQ(set.solid.open_edges, 0u);
    EXPECT_GT(set.solid.turned_edges, 0u);
}

Mesh open_torus() {
    Mesh mesh = torus(1.0, 0.35, 23, 11);
    std::erase_if(mesh.triangles, [&](const MeshTriangle& t) { return t.vertices.x % 17 == 3; });
    return mesh;
}

// The truth is the plain sum over all triangles. Cells within 0.02 of the threshold may be either.
TEST(VoxelizeMesh, open_mesh_is_filled_where_the_generalised_winding_number_is_above_a_half) {
    const Mesh mesh = open_torus();
    VoxelizeRequest request = request_at(44);
    request.is_solid = true;
    const VoxelSet set = voxelize_mesh(mesh, request);
    EXPECT_GT(set.solid.open_edges, 50u);
    const std::set<Cell> inside = interior_of(set);
    const std::set<Cell> surface = cells_of(set);
    const auto count_wrong = [&](double threshold) {
        std::size_t wrong = 0;
        for (int i = 0; i < 44 * 44 * 44; i += 3) {
            const Cell cell{i % 44, i / 44 % 44, i / 1936};
            if (surface.contains(cell)) continue;
            const double winding = std::abs(winding_about(mesh, middle_of(set, cell)));
            if (std::abs(winding - threshold) < 0.02) continue;
            wrong += inside.contains(cell) != (winding > threshold) ? 1 : 0;
        }
        return wrong;
    };
    EXPECT_GT(inside.size(), 1000u);
    EXPECT_EQ(count_wrong(0.5), 0u);
    EXPECT_GT(count_wrong(0.7), 10u) << "another threshold is seen";
    request.inside = InsideRule::parity;
    EXPECT_LT(voxelize_mesh(mesh, request).interior, inside.size());
}

TEST(WindingTree, is_within_a_hundredth_of_the_plain_sum) {
    const Mesh mesh = open_torus();
    const MeshGrid grid = grid_of(mesh, {.resolution = 100, .up = UpAxis::z});
    const std::vector<glm::ivec3> lattice = lattice_positions(mesh, grid);
    const std::vector<std::uint32_t> triangles = finite_triangles(mesh);
    const WindingTree tree(mesh, triangles, lattice);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> at(-20.0, 120.0);
    double worst = 0.0, strongest = 0.0;
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 p(at(random), at(random), at(random));
        const double truth = winding_about(mesh, grid.low + p / grid.scale);
        worst = std::max(worst, std::abs(tree.at(p) - truth));
        strongest = std::max(strongest, truth);
    }
    EXPECT_LT(worst, 0.01);
    EXPECT_GT(strongest, 0.9);
}

TEST(VoxelizeMesh, grid_is_centred_and_says_where_magicavoxel_ends) {
    const Mesh mesh = cube({0, 0, 0}, {4, 4, 4});
    const auto warning = [&](int resolution, bool is_on_floor) {
        return range_warning(grid_of(mesh, {.resolution = resolution, .is_on_floor = is_on_floor}));
    };
    EXPECT_EQ(grid_of(mesh, {.resolution = 9}).origin, glm::ivec3(4));
    EXPECT_EQ(grid_of(mesh, {.resolution = 9, .is_on_floor = true}).origin, glm::ivec3(4, 4, 0));
    EXPECT_FALSE(warning(2000, false).has_value());
    EXPECT_EQ(warning(2001, false),
              "the voxels reach from -1000 to 1000 on x, beyond the -1000 to 999 that MagicaVoxel shows");
    EXPECT_FALSE(warning(1000, true).has_value());
    EXPECT_EQ(warning(1001, true),
              "the voxels reach from 0 to 1000 on z, beyond the -1000 to 999 that MagicaVoxel shows");
}

TEST(VoxelizeMesh, hard_triangles_change_nothing) {
    const Mesh plain = torus(1.0, 0.4, 13, 7);
    const std::set<Cell> cells = cells_of(voxelize_mesh(plain, request_at(40)));
    Mesh hard = plain;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    const auto first = static_cast<std::uint32_t>(hard.positions.size());
    hard.positions.insert(hard.positions.end(), {{nan, 0, 0}, {infinity, 0, 0}, {0, -infinity, 1}});
    hard.triangles.push_back({.vertices = {first, 0, 1}});
    hard.triangles.push_back({.vertices = {first + 1, first + 2, 1}});
    hard.triangles.push_back({.vertices = {3, 3, 3}});  // a point of the surface
    hard.triangles.push_back(hard.triangles.front());   // twice the same
    const MeshTriangle edge = hard.triangles[5];
    hard.triangles.push_back({.vertices = {edge.vertices.x, edge.vertices.y, edge.vertices.x}});
    const VoxelSet set = voxelize_mesh(hard, request_at(40));
    EXPECT_EQ(set.dropped, 2u);
    EXPECT_EQ(cells_of(set), cells);
}

TEST(VoxelizeMesh, scale_of_a_billion_and_a_billionth_change_nothing) {
    const Mesh plain = torus(1.0, 0.4, 13, 7);
    const std::set<Cell> cells = cells_of(voxelize_mesh(plain, request_at(40)));
    for (const double scale : {1073741824.0, 1.0 / 1073741824.0}) {
        Mesh scaled = plain;
        for (glm::dvec3& p : scaled.positions)
            p *= scale;
        EXPECT_EQ(cells_of(voxelize_mesh(scaled, request_at(40))), cells);
    }
}

TEST(VoxelizeMesh, mesh_of_one_point_is_one_voxel) {
    EXPECT_EQ(voxelize_mesh(mesh_of({{{{5, 5, 5}, {5, 5, 5}, {5, 5, 5}}}}), request_at(256)).surface, 1u);
}

TEST(VoxelizeMesh, refusals_say_why) {
    EXPECT_THROW((void)voxelize_mesh(Mesh{}, request_at(16)), Error);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW((void)voxelize_mesh(mesh_of({{{{nan, 0, 0}, {1, 0, 0}, {0, 1, 0}}}}), request_at(16)),
                 Error);
    EXPECT_THROW((void)voxelize_mesh(mesh_of({{{{-1e308, 0, 0}, {1e308, 0, 0}, {0, 1, 0}}}}), request_at(16)),
                 Error);
    VoxelizeRequest fine = request_at(16);
    fine.grid.metres_per_voxel = 1e-9;
    EXPECT_THROW((void)voxelize_mesh(cube({0, 0, 0}, {1, 1, 1}), fine), Error);
}

TEST(VoxelizeMesh, any_number_of_threads_gives_the_same_voxels) {
    const Mesh mesh = torus(1.0, 0.4, 37, 17);
    VoxelizeRequest request = request_at(200);
    request.is_solid = true;
    const VoxelSet one = voxelize_mesh(mesh, request);
    for (const unsigned threads : {2u, 5u}) {
        request.threads = threads;
        const VoxelSet many = voxelize_mesh(mesh, request);
        ASSERT_EQ(many.blocks.size(), one.blocks.size());
        for (std::size_t i = 0; i < one.blocks.size(); ++i)
            EXPECT_TRUE(many.blocks[i].surface == one.blocks[i].surface &&
                        many.blocks[i].interior == one.blocks[i].interior)
                << i;
    }
}

TEST(VoxelizeMesh, exception_of_progress_ends_the_work) {
    VoxelizeRequest request = request_at(200);
    request.threads = 2;
    request.progress = [](double) { throw Error(ExitCode::interrupted, "stop"); };
    EXPECT_THROW((void)voxelize_mesh(torus(1.0, 0.4, 37, 17), request), Error);
}

// Two coplanar triangles of different colours that meet inside a cell.
TEST(VoxelizeMesh, colour_is_the_mean_by_area_in_linear_light) {
    Mesh mesh = mesh_of({{{{0, 0, 0}, {0.25, 0, 0}, {0, 4, 0}}},
                         {{{0.25, 0, 0}, {0.25, 4, 0}, {0, 4, 0}}},
                         {{{0.25, 0, 0}, {4, 0, 0}, {4, 4, 0}}},
                         {{{0.25, 0, 0}, {4, 4, 0}, {0.25, 4, 0}}}});
    mesh.materials = {{.base_color = {1, 0, 0, 1}}, {.base_color = {0, 0, 1, 1}}};
    mesh.triangles[2].material = mesh.triangles[3].material = 1;
    const Colours colours = surface_of(voxelize_mesh(mesh, request_at(4)));
    for (int y = 0; y < 4; ++y) {
        const ColouredVoxel mixed = colours.at({0, y, 0});
        EXPECT_EQ(mixed.r, 137);  // sRGB of 1/4
        EXPECT_EQ(mixed.b, 225);  // of 3/4
        EXPECT_EQ(colours.at({2, y, 0}).b, 255);
        EXPECT_EQ(colours.at({2, y, 0}).r, 0);
    }
}

TEST(VoxelizeMesh, vertex_colours_vary_over_a_triangle) {
    Mesh mesh = mesh_of({{{{0, 0, 0}, {64, 0, 0}, {0, 64, 0}}}});
    mesh.colors = {{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}};
    const Colours colours = surface_of(voxelize_mesh(mesh, request_at(64)));
    EXPECT_EQ(colours.at({32, 0, 0}).r, 188);  // sRGB of 32.5/64
    EXPECT_EQ(colours.at({0, 32, 0}).g, 188);
    EXPECT_EQ(colours.at({32, 0, 0}).b, 0);
}

TEST(VoxelizeMesh, materials_become_looks) {
    Mesh mesh = mesh_of({{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}}});
    const auto look_with = [&](const MeshMaterial& material) {
        mesh.materials = {material};
        return unpacked(surface_of(voxelize_mesh(mesh, request_at(4))).at({0, 0, 0}).look);
    };
    EXPECT_EQ(look_with({.metallic = 0.0f}).kind, LookKind::diffuse);
    EXPECT_EQ(look_with({.metallic = 1.0f, .roughness = 0.43f}), (Look{.kind = LookKind::metal, .rough = 3}));
    EXPECT_EQ(look_with({.metallic = 0.0f, .transmission = 1.0f}).kind, LookKind::glass);
    MeshMaterial blend{.base_color = {1, 1, 1, 0.2f}, .alpha_mode = AlphaMode::blend, .metallic = 0.0f};
    EXPECT_EQ(look_with(blend), (Look{.kind = LookKind::glass, .rough = 7, .level = 12, .ior = 5}));
    const MeshMaterial emitter{.base_color = {0.5f, 0.5f, 0.5f, 1}, .metallic = 0.0f, .emissive = {2, 2, 2}};
    EXPECT_EQ(look_with(emitter), (Look{.kind = LookKind::emit, .level = 14}));
    EXPECT_EQ(surface_of(voxelize_mesh(mesh, request_at(4))).at({0, 0, 0}).r, 188);  // of the base colour
}

TEST(VoxelizeMesh, mask_empties_voxels) {
    Mesh mesh = mesh_of({{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}}, {{{0, 0, 4}, {4, 0, 4}, {0, 4, 4}}}});
    mesh.materials = {{}, {.base_color = {1, 1, 1, 0.3f}, .alpha_mode = AlphaMode::mask}};
    mesh.triangles[1].material = 1;
    const VoxelSet set = voxelize_mesh(mesh, request_at(4));
    EXPECT_EQ(set.masked, set.surface);
    for (const auto& [x, y, z] : cells_of(set))
        EXPECT_EQ(z, 0);
}

}  // namespace
}  // namespace voxilux

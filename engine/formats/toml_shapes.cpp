// [[shape]]: voxels without a file.

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "formats/toml_scene.h"
#include "scene/shapes.h"

namespace voxilux {
namespace {

// Limit for all shapes of a file together: gigabytes and half a minute where every cell is visible.
constexpr double kMaxShapeCells = 268435456.0;  // 2^28
constexpr double kMaxRadius = 1 << 20;
constexpr int kMaxFeature = 1 << 16;
constexpr int kMaxTreeHeight = 4096;
constexpr Range kAnywhere{-kMaxGridCoordinate, kMaxGridCoordinate};

Filling read_filling(const TomlScene& in, const TomlSection& section, std::string_view key) {
    const std::string name = section.require(section.get<std::string>(key), key);
    if (name == kAir) return std::nullopt;
    return static_cast<std::uint16_t>(find_material(in, section, key, name));
}

glm::ivec3 read_corner(const TomlSection& section, std::string_view key) {
    return section.require(section.get<glm::ivec3>(key, kAnywhere), key);
}

Box read_box(const TomlSection& section) {
    const Box box{read_corner(section, "from"), read_corner(section, "to")};
    if (box.empty())
        section.refuse("to", "must be above 'from' on every axis: the cell 'to' is the first outside");
    return box;
}

Shape read_box_shape(const TomlScene& in, const toml::table& table) {
    const TomlSection section(table, "[[shape]] \"box\"", {"shape", "from", "to", "material", "hollow"});
    const Box box = read_box(section);
    return BoxShape{box.lo, box.hi, section.get<bool>("hollow").value_or(false),
                    read_filling(in, section, "material")};
}

Shape read_ball_shape(const TomlScene& in, const toml::table& table) {
    const TomlSection section(table, "[[shape]] \"ball\"",
                              {"shape", "center", "radius", "material", "hollow"});
    const glm::dvec3 centre = section.require(section.get<glm::dvec3>("center", kAnywhere), "center");
    const double radius = section.require(section.get<double>("radius", above(0, kMaxRadius)), "radius");
    return BallShape{centre, radius, section.get<bool>("hollow").value_or(false),
                     read_filling(in, section, "material")};
}

Shape read_terrain_shape(const TomlScene& in, const toml::table& table) {
    const TomlSection section(table, "[[shape]] \"terrain\"",
                              {"shape", "from", "to", "seed", "feature", "island", "layers"});
    const Box box = read_box(section);
    GroundShape ground{.terrain = {.from = box.lo, .to = box.hi}};
    ground.terrain.seed = section.get<std::uint32_t>("seed", kWhole).value_or(0);
    ground.terrain.feature = section.get<int>("feature", {1, kMaxFeature}).value_or(ground.terrain.feature);
    ground.terrain.island = section.get<bool>("island").value_or(false);
    for (const std::string& name : section.require(section.texts("layers"), "layers"))
        ground.layers.push_back(name == kAir ? Filling()
                                             : Filling(find_material(in, section, "layers", name)));
    if (ground.layers.empty()) section.refuse("layers", "must name at least one material");
    return ground;
}

// A base of [x, y] stands on the highest voxel that the shapes before it have left in that column.
glm::ivec3 read_base(const TomlSection& section, const VoxelGrid& grid) {
    const toml::node* node = section.find("base");
    const bool on_ground = node != nullptr && node->is_array() && node->as_array()->size() == 2;
    if (!on_ground) return read_corner(section, "base");
    const glm::ivec2 column = *section.get<glm::ivec2>("base", {-kMaxGridCoordinate, kMaxGridCoordinate - 1});
    const auto top = grid.top_of_column(column.x, column.y);
    if (!top) section.refuse("base", "has no ground: no earlier shape fills this column; give [x, y, z]");
    return {column, *top + 1};
}

Shape read_tree_shape(const TomlScene& in, const toml::table& table, const VoxelGrid& grid) {
    const TomlSection section(table, "[[shape]] \"tree\"",
                              {"shape", "base", "height", "crown", "seed", "trunk", "leaves"});
    TreeShape tree{.base = read_base(section, grid)};
    tree.height = section.get<int>("height", {1, kMaxTreeHeight}).value_or(tree.height);
    tree.crown = section.get<double>("crown", above(0, kMaxTreeHeight)).value_or(tree.crown);
    tree.seed = section.get<std::uint32_t>("seed", kWhole).value_or(0);
    tree.trunk = read_filling(in, section, "trunk");
    tree.leaves = read_filling(in, section, "leaves");
    return tree;
}

// Reads the kind first, from a section that allows the keys of all kinds.
Shape read_shape(const TomlScene& in, const toml::table& table, const VoxelGrid& grid) {
    constexpr std::array<std::string_view, 4> kKinds{"box", "ball", "terrain", "tree"};
    const TomlSection any(table, "[[shape]]",
                          {"shape", "from", "to", "material", "hollow", "center", "radius", "seed", "feature",
                           "island", "layers", "base", "height", "crown", "trunk", "leaves"});
    switch (any.require(any.choice("shape", kKinds), "shape")) {
        case 0:
            return read_box_shape(in, table);
        case 1:
            return read_ball_shape(in, table);
        case 2:
            return read_terrain_shape(in, table);
        default:
            return read_tree_shape(in, table, grid);
    }
}

void check_reach(const toml::table& table, const Shape& shape, double work) {
    const Box bounds = shape_bounds(shape);
    const int reach =
        std::max({-bounds.lo.x, -bounds.lo.y, -bounds.lo.z, bounds.hi.x, bounds.hi.y, bounds.hi.z});
    if (reach > kMaxGridCoordinate)
        refuse_at(table.source(), fmt::format("[[shape]] reaches {} voxels from the origin; the limit is {}",
                                              reach, kMaxGridCoordinate));
    if (!(work <= kMaxShapeCells))
        refuse_at(table.source(),
                  fmt::format(
                      "[[shape]] brings the shapes of this scene to {:.0f} cells; the limit is 2^28 = {:.0f}",
                      work, kMaxShapeCells));
}

}  // namespace

void read_shapes(TomlScene& in) {
    VoxelGrid grid;
    double work = 0.0;
    for (const toml::table* table : find_sections(in, "shape")) {
        const Shape shape = read_shape(in, *table, grid);
        work += shape_work(shape);
        check_reach(*table, shape, work);
        draw_shape(grid, shape);
    }
    grid.append_to(in.scene, "shapes");
}

}  // namespace voxilux

// Shapes as rows: a box and a ball are convex, so each of their rows along x is one interval, and a shell is
// a row without the part that its own ends and its four neighbour rows enclose.

#include "scene/shapes.h"

#include <algorithm>
#include <cmath>

#include "shared/hash.h"

namespace voxilux {
namespace {

// The cells [x0, x1) of a row; empty when x0 >= x1.
struct Row {
    int x0 = 0;
    int x1 = 0;

    [[nodiscard]] bool empty() const { return x0 >= x1; }
};

bool ball_holds(const BallShape& ball, glm::ivec3 cell) {
    const glm::dvec3 d = glm::dvec3(cell) + 0.5 - ball.centre;
    return d.x * d.x + d.y * d.y + d.z * d.z <= ball.radius * ball.radius;
}

Row row_of(const BoxShape& box, glm::ivec2 yz) {
    const bool inside = yz.x >= box.from.y && yz.x < box.to.y && yz.y >= box.from.z && yz.y < box.to.z;
    return inside ? Row{box.from.x, box.to.x} : Row{};
}

// The square root gives the ends to within a cell; the predicate itself decides them.
Row row_of(const BallShape& ball, glm::ivec2 yz) {
    const glm::dvec2 d = glm::dvec2(yz) + 0.5 - glm::dvec2(ball.centre.y, ball.centre.z);
    const double half = std::sqrt(std::max(0.0, ball.radius * ball.radius - d.x * d.x - d.y * d.y));
    Row row{static_cast<int>(std::floor(ball.centre.x - half)) - 1,
            static_cast<int>(std::ceil(ball.centre.x + half)) + 1};
    while (row.x0 < row.x1 && !ball_holds(ball, {row.x0, yz}))
        ++row.x0;
    while (row.x0 < row.x1 && !ball_holds(ball, {row.x1 - 1, yz}))
        --row.x1;
    return row;
}

// The part of a row whose six face neighbours are all inside.
template <class S>
Row enclosed(const S& shape, Row row, glm::ivec2 yz) {
    Row inner{row.x0 + 1, row.x1 - 1};
    for (const glm::ivec2 step : {glm::ivec2(1, 0), glm::ivec2(-1, 0), glm::ivec2(0, 1), glm::ivec2(0, -1)}) {
        const Row beside = row_of(shape, yz + step);
        inner = beside.empty() ? Row{} : Row{std::max(inner.x0, beside.x0), std::min(inner.x1, beside.x1)};
        if (inner.empty()) return {};
    }
    return inner;
}

Box bounds_of(const BoxShape& box) {
    return {box.from, box.to};
}

Box bounds_of(const BallShape& ball) {
    return {glm::ivec3(glm::floor(ball.centre - ball.radius)),
            glm::ivec3(glm::ceil(ball.centre + ball.radius))};
}

Box bounds_of(const GroundShape& ground) {
    return {ground.terrain.from, ground.terrain.to};
}

BallShape crown_of(const TreeShape& tree) {
    return {.centre = glm::dvec3(tree.base) + glm::dvec3(0.5, 0.5, tree.height),
            .radius = tree.crown,
            .filling = tree.leaves};
}

Box bounds_of(const TreeShape& tree) {
    return united(bounds_of(crown_of(tree)), {tree.base, tree.base + glm::ivec3(1, 1, tree.height)});
}

// Every cell of a shell has a free face, and a convex shape shows at most its box's faces.
double work_of(const Box& box, bool hollow) {
    const glm::dvec3 e(box.extent());
    return hollow ? e.y * e.z + 2.0 * (e.x * e.y + e.y * e.z + e.z * e.x) : e.x * e.y * e.z;
}

template <class S>
void draw_convex(VoxelGrid& grid, const S& shape) {
    const Box box = bounds_of(shape);
    for (int z = box.lo.z; z < box.hi.z; ++z) {
        for (int y = box.lo.y; y < box.hi.y; ++y) {
            const Row row = row_of(shape, {y, z});
            if (row.empty()) continue;
            const Row inner = shape.hollow ? enclosed(shape, row, {y, z}) : Row{};
            if (inner.empty()) {
                grid.fill_row(row.x0, row.x1, {y, z}, shape.filling);
            } else {
                grid.fill_row(row.x0, inner.x0, {y, z}, shape.filling);
                grid.fill_row(inner.x1, row.x1, {y, z}, shape.filling);
            }
        }
    }
}

void draw(VoxelGrid& grid, const BoxShape& box) {
    draw_convex(grid, box);
}
void draw(VoxelGrid& grid, const BallShape& ball) {
    draw_convex(grid, ball);
}

void draw(VoxelGrid& grid, const GroundShape& ground) {
    const TerrainShape& terrain = ground.terrain;
    const std::int64_t height = std::int64_t{terrain.to.z} - terrain.from.z;
    const auto layer_count = static_cast<std::int64_t>(ground.layers.size());
    std::vector<int> filled(static_cast<std::size_t>(std::int64_t{terrain.to.x} - terrain.from.x));
    for (int y = terrain.from.y; y < terrain.to.y; ++y) {
        terrain_heights(terrain, terrain.from.x, y, filled);
        const int top = std::ranges::max(filled);
        for (int z = 0; z < top; ++z) {
            const Filling& layer = ground.layers[static_cast<std::size_t>(z * layer_count / height)];
            const auto is_above = [&](int column) { return column > z; };
            for (auto begin = std::ranges::find_if(filled, is_above); begin != filled.end();) {
                const auto end = std::find_if_not(begin, filled.end(), is_above);
                grid.fill_row(terrain.from.x + static_cast<int>(begin - filled.begin()),
                              terrain.from.x + static_cast<int>(end - filled.begin()),
                              {y, terrain.from.z + z}, layer);
                begin = std::find_if(end, filled.end(), is_above);
            }
        }
    }
}

// Leaves thin out over the outer third of the radius.
bool leaf_grows(const TreeShape& tree, const BallShape& crown, glm::ivec3 cell) {
    const std::uint32_t word =
        gpu::hash4(static_cast<std::uint32_t>(cell.x), static_cast<std::uint32_t>(cell.y),
                   static_cast<std::uint32_t>(cell.z), tree.seed);
    const double reach = 1.0 - (word >> 16) / (3.0 * 65536.0);
    return ball_holds({.centre = crown.centre, .radius = crown.radius * reach}, cell);
}

void draw(VoxelGrid& grid, const TreeShape& tree) {
    const BallShape crown = crown_of(tree);
    const Box box = bounds_of(crown);
    for (int z = box.lo.z; z < box.hi.z; ++z)
        for (int y = box.lo.y; y < box.hi.y; ++y)
            for (int x = box.lo.x; x < box.hi.x; ++x)
                if (leaf_grows(tree, crown, {x, y, z})) grid.set({x, y, z}, tree.leaves);
    for (int z = 0; z < tree.height; ++z)
        grid.set(tree.base + glm::ivec3(0, 0, z), tree.trunk);
}

bool is_hollow(const BoxShape& box) {
    return box.hollow;
}
bool is_hollow(const BallShape& ball) {
    return ball.hollow;
}
bool is_hollow(const GroundShape&) {
    return false;
}
bool is_hollow(const TreeShape&) {
    return false;
}

}  // namespace

Box shape_bounds(const Shape& shape) {
    return std::visit([](const auto& s) { return bounds_of(s); }, shape);
}

double shape_work(const Shape& shape) {
    return std::visit([](const auto& s) { return work_of(bounds_of(s), is_hollow(s)); }, shape);
}

void draw_shape(VoxelGrid& grid, const Shape& shape) {
    std::visit([&](const auto& s) { draw(grid, s); }, shape);
}

}  // namespace voxilux

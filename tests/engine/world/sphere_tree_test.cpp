// The walk of the hierarchy over spheres against a test of each sphere, to the bit.

#include "world/sphere_tree.h"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "shared/limits.h"
#include "shared/photon_area.h"
#include "world/sphere_view.h"

namespace voxilux {
namespace {

struct TreeCase {
    std::string name;
    std::vector<gpu::SphereRecord> spheres;
    double edge = 0.0;  // of the cube around the middle of space in which rays start
};

void PrintTo(const TreeCase& c, std::ostream* out) {
    *out << c.name;
}

class Numbers {
  public:
    double in(double low, double high) {
        return low + (high - low) * (static_cast<double>(twister_()) * 0x1p-32);
    }
    glm::vec3 point(double edge) {
        const double x = in(-edge / 2, edge / 2);
        const double y = in(-edge / 2, edge / 2);
        return {x, y, in(-edge / 2, edge / 2)};
    }
    glm::vec3 direction() {
        for (;;) {
            const glm::vec3 v = point(2.0);
            if (const float square = glm::dot(v, v); square > 0.01f && square < 1.0f)
                return v / std::sqrt(square);
        }
    }

  private:
    std::mt19937 twister_{1};
};

gpu::SphereRecord sphere_at(glm::dvec3 centre, double radius) {
    return {gpu::sphere_anchored_near(centre, radius, glm::dvec3(0.0)), 0};
}

TreeCase scattered() {
    TreeCase c{.name = "scattered", .edge = 100.0};
    Numbers numbers;
    for (int i = 0; i < 2000; ++i)
        c.spheres.push_back(sphere_at(glm::dvec3(numbers.point(c.edge)), numbers.in(0.2, 3.0)));
    return c;
}

TreeCase touching() {
    TreeCase c{.name = "touching", .edge = 24.0};
    for (int i = 0; i < 1000; ++i)
        c.spheres.push_back(sphere_at(glm::dvec3(i % 10, i / 10 % 10, i / 100) * 2.0 - 9.0, 1.0));
    return c;
}

TreeCase nested() {
    TreeCase c{.name = "nested", .edge = 80.0};
    for (int i = 0; i < 300; ++i)
        c.spheres.push_back(sphere_at({1, 2, 3}, 30.0 - 0.1 * i));
    return c;
}

TreeCase equal() {
    TreeCase c{.name = "equal", .edge = 10.0};
    for (int i = 0; i < 50; ++i)
        c.spheres.push_back(sphere_at({0.5, -1, 0.25}, 2.0));
    return c;
}

// Walls of radius 10^5 and balls of 10^-3.
TreeCase tiny_and_huge() {
    TreeCase c{.name = "tiny_and_huge", .edge = 20.0};
    Numbers numbers;
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            glm::dvec3 centre(0.0);
            centre[axis] = side * (1e5 + 12.0);
            c.spheres.push_back(sphere_at(centre, 1e5));
        }
    for (int i = 0; i < 500; ++i)
        c.spheres.push_back(sphere_at(glm::dvec3(numbers.point(c.edge)), i % 5 == 0 ? 1.0 : 1e-3));
    return c;
}

TreeCase single() {
    return {.name = "single", .spheres = {sphere_at({0, 0, 0}, 1.0)}, .edge = 4.0};
}

struct Found {
    gpu::uint i = gpu::kNoSphere;
    float t = 0.0f;
    bool operator==(const Found&) const = default;
};

struct Question {
    glm::vec3 origin;
    glm::vec3 direction;
    float t_max;
    gpu::uint own;
};

Found by_list(const TreeCase& c, const Question& q) {
    Found found{.t = q.t_max};
    for (gpu::uint i = 0; i < c.spheres.size(); ++i) {
        const float t = gpu::sphere_time(c.spheres[i].shape, q.origin, q.direction, found.t, i == q.own);
        if (t < found.t) found = {i, t};
    }
    return found;
}

Found by_tree(const SphereView& view, const Question& q) {
    const gpu::NearestSphere nearest =
        gpu::nearest_in_tree(view, q.origin, q.direction, q.t_max, q.own, false);
    return {nearest.i, nearest.t};
}

bool is_met(const SphereView& view, const Question& q) {
    return gpu::nearest_in_tree(view, q.origin, q.direction, q.t_max, q.own, true).i != gpu::kNoSphere;
}

gpu::uint glass_by_list(const TreeCase& c, glm::vec3 point, gpu::uint but) {
    gpu::uint around = gpu::kNoSphere;
    float curvature = 0.0f;
    for (gpu::uint i = 0; i < c.spheres.size(); ++i) {
        const gpu::Sphere& shape = c.spheres[i].shape;
        if (i == but || shape.curvature < curvature || !gpu::is_in_sphere(shape, point)) continue;
        around = i;
        curvature = shape.curvature;
    }
    return around;
}

// Every other ray starts on the sphere that the ray before it hit. Returns how many rays disagree.
int mismatches(const TreeCase& c, const SphereView& view) {
    Numbers numbers;
    int count = 0;
    Question q{.own = gpu::kNoSphere};
    for (int ray = 0; ray < 3000; ++ray) {
        if (q.own == gpu::kNoSphere) q.origin = numbers.point(c.edge);
        q.direction = ray % 7 == 0 ? glm::vec3(0, 0, 1) : numbers.direction();
        q.t_max = ray % 3 == 0 ? static_cast<float>(numbers.in(0.0, c.edge)) : 1e30f;
        const Found expected = by_list(c, q);
        count += by_tree(view, q) == expected ? 0 : 1;
        count += is_met(view, q) == (expected.i != gpu::kNoSphere) ? 0 : 1;
        const gpu::EnclosingSphere inmost =
            gpu::enclosing_in_tree(view, q.origin, static_cast<gpu::uint>(c.spheres.size()), q.own);
        count += inmost.i == glass_by_list(c, q.origin, q.own) ? 0 : 1;
        q.own = q.own == gpu::kNoSphere ? expected.i : gpu::kNoSphere;
        if (q.own != gpu::kNoSphere) q.origin += expected.t * q.direction;
    }
    return count;
}

class SphereTree : public testing::TestWithParam<TreeCase> {};

TEST_P(SphereTree, finds_what_the_list_finds) {
    const TreeCase& c = GetParam();
    const std::vector<gpu::SphereNode> nodes = build_sphere_tree(c.spheres);
    EXPECT_EQ(std::ranges::count_if(nodes, gpu::is_sphere_leaf), std::ssize(c.spheres));
    EXPECT_EQ(mismatches(c, {nodes}), 0);
}

// What is built where cuts by cost would need more than the stack of a walk.
TEST_P(SphereTree, finds_what_the_list_finds_when_cut_by_number) {
    const TreeCase& c = GetParam();
    const std::vector<gpu::SphereNode> nodes = build_sphere_tree(c.spheres, SphereCut::by_number);
    const double levels = std::log2(static_cast<double>(c.spheres.size())) / 3.0;
    EXPECT_LE(depth_of(nodes), static_cast<std::uint32_t>(std::ceil(levels)));
    EXPECT_EQ(mismatches(c, {nodes}), 0);
}

INSTANTIATE_TEST_SUITE_P(Cases, SphereTree,
                         testing::Values(scattered(), touching(), nested(), equal(), tiny_and_huge(),
                                         single()),
                         testing::PrintToStringParamName());

// Spheres that shrink from one to the next: cuts by cost part one after the other from the rest.
TEST(SphereTreeDepth, a_tree_that_cost_would_make_too_deep_is_cut_by_number) {
    TreeCase c{.name = "spiral", .edge = 8.0};
    for (int i = 0; i < 120; ++i)
        c.spheres.push_back(sphere_at({std::exp2(-0.4 * i) * 4.0, 0, 0}, std::exp2(-0.4 * i)));
    EXPECT_GT(depth_of(build_sphere_tree(c.spheres, SphereCut::by_cost)), gpu::kTreeStack + 1);
    EXPECT_EQ(mismatches(c, {build_sphere_tree(c.spheres)}), 0);
}

// Moves the high ends of boxes of nodes whose children are, or are not, all spheres.
void shrink_boxes(std::vector<gpu::SphereNode>& nodes, bool of_spheres, gpu::uint steps) {
    for (gpu::SphereNode& node : nodes) {
        if (gpu::is_sphere_leaf(node)) continue;
        const gpu::uint first = node.texels[0].w >> 11u;
        const gpu::uint count = (node.texels[0].w >> 8u & 7u) + 1u;
        const auto children = std::span(nodes).subspan(first, count);
        if (std::ranges::all_of(children, gpu::is_sphere_leaf) != of_spheres) continue;
        for (gpu::uint k = 0; k < count; ++k) {  // along x
            gpu::uint& word = node.texels[2][static_cast<int>(2u + k / 4u)];
            const gpu::uint high = word >> (8u * (k % 4u)) & 255u;
            word -= std::min(high, steps) << (8u * (k % 4u));
        }
    }
}

TEST(SphereTreeControl, boxes_that_are_too_small_are_noticed) {
    const TreeCase c = scattered();
    std::vector<gpu::SphereNode> nodes = build_sphere_tree(c.spheres);
    shrink_boxes(nodes, true, 8);
    EXPECT_GT(mismatches(c, {nodes}), 10);
}

// Spheres that cover a part of a disc but are not met by the walk of lib/photon_share.glsl.
int lost_to_discs(const TreeCase& c, const std::vector<gpu::SphereNode>& nodes) {
    Numbers numbers;
    int lost = 0;
    for (int disc = 0; disc < 1000; ++disc) {
        const glm::vec3 point = numbers.point(c.edge);
        const glm::vec3 normal = numbers.direction();
        const auto radius = static_cast<float>(std::exp2(numbers.in(-6.0, 4.0)));
        std::vector<bool> is_met(c.spheres.size());
        const gpu::BoxQuery query = gpu::point_query(point, radius);
        for (gpu::SphereWalk walk = gpu::begin_walk(query); walk.group != 0;) {
            const gpu::SphereNode& node = nodes[gpu::node_of(walk, query)];
            const bool is_leaf = gpu::is_sphere_leaf(node);
            if (is_leaf) is_met[gpu::leaf_number(node)] = true;
            walk = gpu::walk_on(walk, is_leaf ? 0 : gpu::children_met(node, query, 0.0f));
        }
        for (std::size_t i = 0; i < is_met.size(); ++i) {
            const bool takes = gpu::share_taken(c.spheres[i].shape, point, normal, radius) > 0.0f;
            lost += takes && !is_met[i] ? 1 : 0;
        }
    }
    return lost;
}

TEST_P(SphereTree, walk_meets_every_sphere_that_takes_of_a_disc) {
    EXPECT_EQ(lost_to_discs(GetParam(), build_sphere_tree(GetParam().spheres)), 0);
}

TEST(SphereTreeControl, inner_boxes_that_are_too_small_lose_spheres_of_discs) {
    const TreeCase c = scattered();
    std::vector<gpu::SphereNode> nodes = build_sphere_tree(c.spheres);
    shrink_boxes(nodes, false, 32);
    EXPECT_GT(lost_to_discs(c, nodes), 10);
}

// The work of a ray grows logarithmically: ten times as many spheres in ten times the space take fewer than
// twice the visits (linear growth would be ten times).
TEST(SphereTreeCost, visits_grow_slowly) {
    const auto visits = [](int count) {
        const double edge = 8.0 * std::cbrt(static_cast<double>(count));
        Numbers numbers;
        TreeCase c{.name = "", .edge = edge};
        for (int i = 0; i < count; ++i)
            c.spheres.push_back(sphere_at(glm::dvec3(numbers.point(edge)), 1.0));
        const std::vector<gpu::SphereNode> nodes = build_sphere_tree(c.spheres);
        const SphereView view{nodes};
        double sum = 0.0;
        for (int ray = 0; ray < 2000; ++ray) {
            const glm::vec3 origin = numbers.point(edge);
            sum +=
                gpu::nearest_in_tree(view, origin, numbers.direction(), 30.0f, gpu::kNoSphere, false).steps;
        }
        return sum / 2000;
    };
    EXPECT_LT(visits(20000), 2.0 * visits(2000));
}

TEST(SphereTreeCost, mean_visits_follow_from_the_boxes) {
    // All boxes are the same but for the grids they are on, so a ray that meets one visits nearly all nodes.
    const std::vector<gpu::SphereNode> nodes = build_sphere_tree(equal().spheres);
    const auto count = static_cast<double>(nodes.size());
    EXPECT_NEAR(mean_visits(nodes), count, 0.05 * count);
    // Boxes of 2 x 2 x 2 in one of 12 x 2 x 2: a ray that meets it visits either with a chance of 24 / 104. A
    // grid of steps of 1/16 makes them no more than 2.125 wide.
    const std::vector<gpu::SphereRecord> two{sphere_at({-5, 0, 0}, 1.0), sphere_at({5, 0, 0}, 1.0)};
    EXPECT_NEAR(mean_visits(build_sphere_tree(two)), 1.0 + 2.0 * 24.0 / 104.0, 0.03);
    EXPECT_EQ(mean_visits(build_sphere_tree(single().spheres)), 1.0);
    EXPECT_EQ(mean_visits({}), 0.0);
}

}  // namespace
}  // namespace voxilux

// The walk of the hierarchy over spheres against a test of each sphere, to the bit.

#include "world/sphere_tree.h"

#include <cmath>
#include <ostream>
#include <random>
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
    const gpu::NearestSphere nearest = gpu::nearest_in_tree(view, static_cast<gpu::uint>(view.nodes.size()),
                                                            q.origin, q.direction, q.t_max, q.own);
    return {nearest.i, nearest.t};
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
        const gpu::EnclosingSphere inmost =
            gpu::enclosing_in_tree(view, static_cast<gpu::uint>(view.nodes.size()), q.origin,
                                   static_cast<gpu::uint>(c.spheres.size()), q.own);
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
    ASSERT_EQ(nodes.size(), 2 * c.spheres.size() - 1);
    EXPECT_EQ(mismatches(c, {nodes, c.spheres}), 0);
}

INSTANTIATE_TEST_SUITE_P(Cases, SphereTree,
                         testing::Values(scattered(), touching(), nested(), equal(), tiny_and_huge(),
                                         single()),
                         testing::PrintToStringParamName());

TEST(SphereTreeControl, boxes_that_are_too_small_are_noticed) {
    const TreeCase c = scattered();
    std::vector<gpu::SphereNode> nodes = build_sphere_tree(c.spheres);
    for (gpu::SphereNode& node : nodes)
        if (node.sphere != gpu::kNoSphere) node.high -= 0.05f * (node.high - node.low);
    EXPECT_GT(mismatches(c, {nodes, c.spheres}), 10);
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
        for (std::size_t place = 0; place < nodes.size();) {
            const gpu::SphereNode& node = nodes[place];
            const bool is_near = gpu::is_node_near(node, point, radius);
            if (is_near && node.sphere != gpu::kNoSphere) is_met[node.sphere] = true;
            place = is_near ? place + 1 : node.next;
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
    for (gpu::SphereNode& node : nodes)
        if (node.sphere == gpu::kNoSphere) node.high -= 0.3f * (node.high - node.low);
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
        const SphereView view{nodes, c.spheres};
        double sum = 0.0;
        for (int ray = 0; ray < 2000; ++ray) {
            const glm::vec3 origin = numbers.point(edge);
            sum += gpu::nearest_in_tree(view, static_cast<gpu::uint>(nodes.size()), origin,
                                        numbers.direction(), 30.0f, gpu::kNoSphere)
                       .steps;
        }
        return sum / 2000;
    };
    EXPECT_LT(visits(20000), 2.0 * visits(2000));
}

TEST(SphereTreeCost, mean_visits_follow_from_the_boxes) {
    // All boxes are the same, so a ray that meets one visits every node.
    const std::vector<gpu::SphereNode> nodes = build_sphere_tree(equal().spheres);
    const auto count = static_cast<double>(nodes.size());
    EXPECT_NEAR(mean_visits(nodes), count,
                count * count * 0x1p-53);  // one rounding for each box that is added
    // A ray that meets the root visits it and its two leaves, wherever these are.
    const std::vector<gpu::SphereRecord> two{sphere_at({-5, 0, 0}, 1.0), sphere_at({5, 0, 0}, 1.0)};
    EXPECT_DOUBLE_EQ(mean_visits(build_sphere_tree(two)), 3.0);
    EXPECT_EQ(mean_visits({}), 0.0);
}

}  // namespace
}  // namespace voxilux

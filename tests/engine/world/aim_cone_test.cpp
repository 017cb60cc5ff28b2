// Clusters of boxes, and the cones of directions in which they are seen.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "support/draws.h"
#include "world/photon_aims.h"

namespace voxilux {
namespace {

using test::Draws;

RoundedBox random_box(Draws& draw, double spread) {
    const glm::dvec3 low = draw.in(glm::dvec3(-spread), glm::dvec3(spread));
    return {low, low + draw.in(glm::dvec3(0.0), glm::dvec3(3.0)), draw.between(0.0, 1.0)};
}

double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

TEST(BoxClusters, are_few_and_hold_everything_in_any_order) {
    Draws draw;
    std::vector<std::pair<glm::ivec3, RoundedBox>> things;
    for (int i = 0; i < 2000; ++i) {
        const RoundedBox box = random_box(draw, 100.0);
        things.push_back({glm::ivec3(glm::floor(box.low)), box});
    }
    BoxClusters forth(64), back(64);
    for (const auto& [place, box] : things)
        forth.add(2, place, box);
    std::ranges::reverse(things);
    for (const auto& [place, box] : things)
        back.add(2, place, box);
    const std::vector<BoxClusters::Cluster> clusters = forth.clusters();
    EXPECT_LE(clusters.size(), 64u);
    EXPECT_GT(clusters.size(), 8u);
    ASSERT_EQ(back.clusters().size(), clusters.size());
    for (std::size_t i = 0; i < clusters.size(); ++i)
        EXPECT_EQ(back.clusters()[i].box, clusters[i].box);
    for (const auto& [place, box] : things) {
        const RoundedBox& around = clusters.at(forth.number_of(2, place)).box;
        EXPECT_TRUE(glm::all(glm::lessThanEqual(around.low, box.low)));
        EXPECT_TRUE(glm::all(glm::greaterThanEqual(around.high, box.high)));
        EXPECT_GE(around.radius, box.radius);
    }
}

// Directions from points of one box to points of another that leave a cone narrowed to this share of its
// angle.
int directions_outside(double share) {
    Draws draw;
    int outside = 0;
    for (int i = 0; i < 2000; ++i) {
        const RoundedBox seen = random_box(draw, 8.0), from = random_box(draw, 8.0);
        const AimCone cone = cone_towards(seen, from);
        for (int j = 0; j < 50; ++j) {
            const glm::dvec3 way = draw.in(seen)-draw.in(from);
            outside += angle_between(cone.axis, way) > share * cone.half_angle ? 1 : 0;
        }
    }
    return outside;
}

TEST(AimCone, holds_all_directions_from_box_to_box) {
    EXPECT_EQ(directions_outside(1.0), 0);
    EXPECT_GT(directions_outside(0.8), 0) << "the negative control: a narrower cone";
}

TEST(AimCone, is_that_of_a_ball_seen_from_a_point) {
    const AimCone cone = cone_towards({glm::dvec3(3.0, 0.0, 4.0), glm::dvec3(3.0, 0.0, 4.0), 2.5}, {});
    EXPECT_NEAR(cone.half_angle, std::numbers::pi / 6.0, 2e-5);
    EXPECT_NEAR(glm::distance(cone.axis, glm::dvec3(0.6, 0.0, 0.8)), 0.0, 1e-12);
}

TEST(AimCone, is_everything_where_a_box_touches_the_other) {
    const RoundedBox glass{glm::dvec3(0.0), glm::dvec3(4.0, 4.0, 1.0)};
    const RoundedBox face{glm::dvec3(1.0, 1.0, 1.0), glm::dvec3(2.0, 2.0, 1.0)};
    EXPECT_EQ(cone_towards(glass, face).half_angle, std::numbers::pi);
    EXPECT_EQ(cone_towards(face, face).half_angle, std::numbers::pi);
}

// The turn that a cone covers in a band of heights, by brute force over the cone.
double measured_half_turn(const AimCone& cone, double low, double high, Draws& draw) {
    double widest = 0.0;
    const double middle = std::atan2(cone.axis.y, cone.axis.x);
    for (int i = 0; i < 20000; ++i) {
        const double z = draw.between(low, high), turn = draw.between(-std::numbers::pi, std::numbers::pi);
        const double across = std::sqrt(1.0 - z * z);
        const glm::dvec3 direction(across * std::cos(middle + turn), across * std::sin(middle + turn), z);
        if (angle_between(cone.axis, direction) <= cone.half_angle) widest = std::max(widest, std::abs(turn));
    }
    return widest;
}

TEST(AimCone, half_turn_of_a_band_is_that_of_brute_force) {
    Draws draw;
    double farthest = 0.0;
    for (int i = 0; i < 60; ++i) {
        const AimCone cone{draw.direction(), draw.between(0.02, 1.55)};
        const double low = draw.between(-1.0, 0.9), high = low + 0.1;
        const double expected = measured_half_turn(cone, low, high, draw), found = half_turn(cone, low, high);
        EXPECT_GE(found, expected) << i;
        // Samples come close to the extremes, not to them: at the tip of a cone only a few of them do.
        if (expected > 0.0) farthest = std::max(farthest, found - expected);
    }
    EXPECT_LT(farthest, 0.35);
    EXPECT_GT(half_turn({{1.0, 0.0, 0.0}, 0.5}, -0.1, 0.1), 0.4999);
}

}  // namespace
}  // namespace voxilux

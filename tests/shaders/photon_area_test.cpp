// The fraction of a disc that spheres leave, against counting random points of the disc.

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "shared/photon_area.h"
#include "support/statistics.h"

namespace voxilux {
namespace {

using gpu::Sphere;
using gpu::vec3;

// A sphere in double precision; points of a disc are free when they are on the same side of it as the centre.
struct Ball {
    glm::dvec3 centre;
    double radius;
};

Sphere shape_of(const Ball& ball, glm::dvec3 near) {
    return gpu::sphere_anchored_near(ball.centre, ball.radius, near);
}

bool is_outside(const Ball& ball, glm::dvec3 point) {
    return glm::length(point - ball.centre) > ball.radius;
}

// Share of random points of the disc around `point` across z that no ball separates from it. Its error has a
// deviation of at most 1 / (2 sqrt(samples)) = 0.0016.
double counted_share(const std::vector<Ball>& balls, glm::dvec3 point, double radius) {
    constexpr int kSamples = 100000;
    test::TestRandom random(11);
    int free = 0;
    for (int i = 0; i < kSamples; ++i) {
        const double distance = radius * std::sqrt(random.uniform(0.0, 1.0));
        const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
        const glm::dvec3 place = point + distance * glm::dvec3(std::cos(angle), std::sin(angle), 0.0);
        bool is_free = true;
        for (const Ball& ball : balls)
            is_free = is_free && is_outside(ball, place) == is_outside(ball, point);
        free += is_free ? 1 : 0;
    }
    return free / double{kSamples};
}

double computed_share(const std::vector<Ball>& balls, glm::dvec3 point, double radius) {
    double share = 1.0;
    for (const Ball& ball : balls)
        share *= 1.0 - static_cast<double>(gpu::share_taken(shape_of(ball, {0, 0, 0}), vec3(point), {0, 0, 1},
                                                            static_cast<float>(radius)));
    return share;
}

// Walls of the scenes: seen from inside, at x = 0.
const Ball kWallX{{1e4, 0, 0}, 1e4};
const Ball kWallY{{0, 1e4, 0}, 1e4};

TEST(PhotonArea, share_beyond_a_line_has_its_closed_form) {
    EXPECT_FLOAT_EQ(gpu::disc_beyond(0.0f), 0.5f);
    EXPECT_FLOAT_EQ(gpu::disc_beyond(1.0f), 0.0f);
    // Half the radius: a third of the disc less the triangle.
    EXPECT_NEAR(gpu::disc_beyond(0.5f), 1.0 / 3.0 - std::sqrt(3.0) / (4.0 * std::numbers::pi), 1e-7);
}

TEST(PhotonArea, a_perpendicular_wall_takes_what_counting_says) {
    for (const double x : {1e-4, 0.1, 0.5, 1.0, 1.7, 1.99, 2.5}) {
        const glm::dvec3 point(x, 3.0, 0.0);
        EXPECT_NEAR(computed_share({kWallX}, point, 2.0), counted_share({kWallX}, point, 2.0), 0.006) << x;
    }
}

TEST(PhotonArea, a_wall_seen_from_outside_takes_the_same) {
    const Ball wall{{-1e4, 0, 0}, 1e4};
    const glm::dvec3 point(0.6, 0.0, 0.0);
    EXPECT_NEAR(computed_share({wall}, point, 2.0), counted_share({wall}, point, 2.0), 0.006);
}

TEST(PhotonArea, a_slanted_wall_takes_what_counting_says) {
    for (const double slant : {-0.9, -0.5, 0.5, 0.9}) {
        const glm::dvec3 normal(std::sqrt(1.0 - slant * slant), 0.0, slant);
        const Ball wall{normal * 1e4, 1e4};
        const glm::dvec3 point(0.7, 0.0, 0.0);
        EXPECT_NEAR(computed_share({wall}, point, 2.0), counted_share({wall}, point, 2.0), 0.006) << slant;
    }
}

// Where both walls cut, the cuts overlap. Assuming independence is then wrong by up to 0.04 of the disc, but
// right in the corner itself and far from it.
TEST(PhotonArea, a_corner_of_three_walls_leaves_about_what_counting_says) {
    double worst = 0.0;
    for (double x = 0.01; x < 2.2; x += 0.3) {
        for (double y = 0.01; y < 2.2; y += 0.3) {
            const glm::dvec3 point(x, y, 0.0);
            const double counted = counted_share({kWallX, kWallY}, point, 2.0);
            worst = std::max(worst, std::abs(computed_share({kWallX, kWallY}, point, 2.0) - counted));
        }
    }
    EXPECT_LT(worst, 0.04);
    const glm::dvec3 corner(1e-4, 1e-4, 0.0);
    EXPECT_NEAR(computed_share({kWallX, kWallY}, corner, 2.0), 0.25, 0.002);
    EXPECT_GE(computed_share({kWallX, kWallY}, corner, 2.0), 0.999 * static_cast<double>(gpu::kMinShare));
}

// A ball that stands on the plane touches it in a point and takes nothing.
TEST(PhotonArea, a_ball_that_touches_the_plane_takes_nothing) {
    const Ball ball{{0.0, 0.0, 16.5}, 16.5};
    for (const double x : {0.0, 0.01, 0.5, 1.0, 3.0})
        EXPECT_GT(computed_share({ball}, {x, 0.0, 0.0}, 2.0), 0.999) << x;
}

TEST(PhotonArea, a_small_ball_takes_no_more_than_its_circle) {
    const Ball ball{{1.0, 0.0, 0.0}, 0.25};
    const double share = computed_share({ball}, {0.0, 0.0, 0.0}, 2.0);
    EXPECT_NEAR(share, counted_share({ball}, {0.0, 0.0, 0.0}, 2.0), 0.006);
    EXPECT_NEAR(share, 1.0 - 1.0 / 64.0, 1e-4);
}

TEST(PhotonArea, a_sphere_that_lies_on_the_surface_takes_nothing) {
    const Ball same{{0.0, 0.0, -1e4}, 1e4};
    for (const double x : {0.0, 0.3, 1.0})
        EXPECT_EQ(computed_share({same}, {x, 0.0, -x * x / 2e4}, 2.0), 1.0);
}

TEST(PhotonArea, a_wall_moved_by_a_tenth_of_the_radius_is_found) {
    const Ball moved{{1e4 + 0.2, 0, 0}, 1e4};
    const glm::dvec3 point(0.7, 0.0, 0.0);
    EXPECT_GT(std::abs(computed_share({moved}, point, 2.0) - counted_share({kWallX}, point, 2.0)), 0.03);
}

}  // namespace
}  // namespace voxilux

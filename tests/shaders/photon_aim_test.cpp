#include "shared/photon_aim.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace voxilux::gpu {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr int kSteps = 4096;

float step_of(int i) {
    return static_cast<float>(i) / static_cast<float>(kSteps);
}

TEST(PhotonAim, cell_is_packed_and_unpacked) {
    for (const AimCell& cell : {AimCell{255u, 255u, 256u, 65535u}, AimCell{3u, 200u, 1u, 0u}}) {
        const AimCell again = unpack_aim_cell(pack_aim_cell(cell));
        EXPECT_EQ(again.row, cell.row);
        EXPECT_EQ(again.column, cell.column);
        EXPECT_EQ(again.row_count, cell.row_count);
        EXPECT_EQ(again.row_first, cell.row_first);
    }
}

TEST(PhotonAim, number_stays_below_the_count) {
    EXPECT_EQ(aim_number(0.0f, 7u), 0u);
    EXPECT_EQ(aim_number(1.0f - kUnitStep, 65535u), 65534u);
    EXPECT_EQ(aim_number(0.5f, 4u), 2u);
}

TEST(PhotonAim, turn_is_cosine_and_sine_all_the_way_round) {
    double worst = 0.0;
    for (int i = 0; i <= kSteps; ++i) {
        const vec2 point = turned(step_of(i));
        const double angle = kTurn * static_cast<double>(step_of(i));
        worst = std::max({worst, std::abs(static_cast<double>(point.x) - std::cos(angle)),
                          std::abs(static_cast<double>(point.y) - std::sin(angle))});
    }
    EXPECT_LT(worst, 2e-7);  // three roundings of numbers up to 1
}

// Mean and mean square of the height, and the worst length, over a lattice.
struct Heights {
    double mean = 0.0;
    double square = 0.0;
    double worst_length = 0.0;
    float lowest = 1.0f;
};

Heights heights_of(vec3 (*direction)(vec2)) {
    Heights heights;
    for (int i = 0; i <= kSteps; ++i) {
        const vec3 d = direction({step_of(i * 37 % kSteps), step_of(i)});
        const double z = static_cast<double>(d.z), weight = i % kSteps == 0 ? 0.5 / kSteps : 1.0 / kSteps;
        heights.mean += weight * z;
        heights.square += weight * z * z;
        heights.worst_length = std::max(heights.worst_length, std::abs(glm::length(glm::dvec3(d)) - 1.0));
        heights.lowest = std::min(heights.lowest, d.z);
    }
    return heights;
}

TEST(PhotonAim, directions_around_a_normal_are_cosine_weighted) {
    const Heights heights = heights_of(aimed_cosine);
    EXPECT_NEAR(heights.mean, 2.0 / 3.0, 1e-4);
    EXPECT_NEAR(heights.square, 0.5, 1e-4);
    EXPECT_LT(heights.worst_length, static_cast<double>(kUnitLengthError));
    EXPECT_GE(heights.lowest, 0.000244140625f);  // 2^-12
}

TEST(PhotonAim, directions_of_a_ball_are_uniform) {
    const Heights heights = heights_of(aimed_anywhere);
    EXPECT_NEAR(heights.mean, 0.0, 1e-4);
    EXPECT_NEAR(heights.square, 1.0 / 3.0, 1e-4);
    EXPECT_LT(heights.worst_length, static_cast<double>(kUnitLengthError));
    EXPECT_EQ(heights.lowest, -1.0f);
}

TEST(PhotonAim, plane_of_the_sun_faces_it_and_is_turned_no_more_than_it_is) {
    const vec3 sun = glm::normalize(vec3(0.3f, -0.5f, 0.6f));
    const Basis disc = basis_around(sun);
    const float height = cone_height(0.4f);
    for (int i = 0; i < 200; ++i) {
        const vec2 u(step_of(i * 997 % kSteps), step_of(i * 20));
        const AimedSun middle = aimed_sun(sun, height, u, vec2(0.0f), 5.0f);
        const AimedSun beside = aimed_sun(sun, height, u, {1.0f, 0.0f}, 5.0f);
        EXPECT_TRUE(is_in_cone(middle.towards, sun, height * 1.0001f));
        EXPECT_LT(glm::distance(middle.place, 5.0f * middle.towards), 4e-6f);
        const vec3 across = beside.place - middle.place;
        EXPECT_NEAR(glm::dot(across, middle.towards), 0.0f, 1e-6f);
        EXPECT_NEAR(glm::length(across), 1.0f, 1e-6f);
        EXPECT_LE(glm::distance(across, disc.tangent), glm::distance(middle.towards, sun) + 1e-6f);
    }
}

}  // namespace
}  // namespace voxilux::gpu

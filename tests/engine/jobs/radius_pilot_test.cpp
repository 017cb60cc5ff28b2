#include "renderer/radius_pilot.h"

#include <gtest/gtest.h>

namespace voxilux {
namespace {

TEST(RadiusPilot, middle_of_the_discs_that_photons_reach_is_taken) {
    EXPECT_EQ(median_of_met({0.0f, 7.0f, 0.0f, 1.0f, 90.0f}), 7.0);
    EXPECT_EQ(median_of_met({3.0f}), 3.0);
    EXPECT_EQ(median_of_met({0.0f, 0.0f}), 0.0);
    EXPECT_EQ(median_of_met({}), 0.0);
}

}  // namespace
}  // namespace voxilux

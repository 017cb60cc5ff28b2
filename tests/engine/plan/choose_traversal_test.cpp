#include "plan/choose_traversal.h"

#include <gtest/gtest.h>

namespace voxilux {
namespace {

constexpr DeviceLimits kDevice{};

WorldCensus census_of(glm::ivec3 chunks, std::uint64_t mixed_bricks) {
    return {.chunks = chunks, .mixed_bricks = mixed_bricks, .mixed_chunks = mixed_bricks / 8};
}

TEST(ChooseTraversal, users_choice_wins_whatever_it_takes) {
    const TraversalChoice choice =
        choose_traversal(census_of(glm::ivec3(256), 1), Traversal::wide, 1, kDevice);
    EXPECT_EQ(choice.traversal, Traversal::wide);
    EXPECT_EQ(choice.reason, "by your choice");
}

TEST(ChooseTraversal, dense_bricks_serve_worlds_whose_grid_stays_in_the_cache) {
    EXPECT_EQ(choose_traversal(census_of(glm::ivec3(16), 1000), {}, 0, kDevice).traversal, Traversal::wide);
    EXPECT_EQ(choose_traversal(census_of(glm::ivec3(32), 1000), {}, 0, kDevice).traversal, Traversal::wide);
    EXPECT_EQ(choose_traversal(census_of(glm::ivec3(33), 1000), {}, 0, kDevice).traversal, Traversal::deep);
}

TEST(ChooseTraversal, budget_makes_the_structure_smaller_and_says_so) {
    const WorldCensus census = census_of(glm::ivec3(25), 1000);
    const std::uint64_t wide = predict_bytes(census, Traversal::wide).total();
    EXPECT_EQ(choose_traversal(census, {}, 2 * wide, kDevice).traversal, Traversal::wide);
    const TraversalChoice choice = choose_traversal(census, {}, 2 * wide - 2, kDevice);
    EXPECT_EQ(choice.traversal, Traversal::deep);
    EXPECT_NE(choice.reason.find("'wide' may take 4 MB"), std::string::npos) << choice.reason;
}

TEST(ChooseTraversal, world_over_every_budget_gets_the_smallest_structure) {
    const TraversalChoice choice = choose_traversal(census_of(glm::ivec3(64), 10'000'000), {}, 0, kDevice);
    EXPECT_EQ(choice.traversal, Traversal::naadf);
    EXPECT_NE(choice.reason.find("100 MB"), std::string::npos) << choice.reason;
}

TEST(ChooseTraversal, level_over_the_largest_allocation_is_passed_over) {
    DeviceLimits small;
    small.max_allocation_bytes = 1 << 20;
    EXPECT_EQ(choose_traversal(census_of(glm::ivec3(25), 1000), {}, 0, small).traversal, Traversal::deep);
}

TEST(ChooseTraversal, texels_are_loaded_by_software_devices_that_have_room_for_them) {
    DeviceLimits limits{.max_texels = 1000};
    EXPECT_TRUE(loads_texels(limits, 4000));
    EXPECT_FALSE(loads_texels(limits, 4004));
    limits.is_cpu = false;
    EXPECT_FALSE(loads_texels(limits, 4000));
}

}  // namespace
}  // namespace voxilux

#include "world/structure_bytes.h"

#include <gtest/gtest.h>

#include "support/ray_families.h"

namespace voxilux {
namespace {

// Whether the prediction holds: exactly, except that there may be fewer leaves when bricks repeat.
bool is_right(const StructureBytes& predicted, const StructureBytes& built) {
    return predicted.roots == built.roots && predicted.nodes == built.nodes &&
           predicted.leaves >= built.leaves;
}

TEST(StructureBytes, prediction_holds_for_every_structure_of_every_small_world) {
    for (const test::NamedWorld& named : test::small_worlds(5)) {
        const WorldCensus census = take_census(named.world);
        for (const Traversal traversal : all_traversals()) {
            const StructureBytes built = bytes_of(build_march_world(named.world, traversal));
            EXPECT_TRUE(is_right(predict_bytes(census, traversal), built))
                << named.name << " " << name_of(traversal);
        }
    }
}

// 200 bricks of one voxel each at its own corner pattern of materials: no two are equal.
TEST(StructureBytes, prediction_is_exact_where_no_brick_repeats) {
    VoxelWorld world(glm::ivec3(0), glm::ivec3(2));
    for (int i = 0; i < 200; ++i)
        world.set(glm::ivec3(i % 8, i / 8 % 8, i / 64) * 4 + 1, static_cast<std::uint16_t>(i));
    const WorldCensus census = take_census(world);
    EXPECT_EQ(census.mixed_bricks, 200u);
    for (const Traversal traversal : all_traversals())
        EXPECT_EQ(predict_bytes(census, traversal), bytes_of(build_march_world(world, traversal)))
            << name_of(traversal);
}

TEST(StructureBytes, one_brick_too_few_or_too_many_is_caught) {
    const StructureBytes built{.roots = 256, .nodes = 512, .leaves = 1024};
    ASSERT_TRUE(is_right(built, built));
    for (const StructureBytes& wrong :
         {StructureBytes{252, 512, 1024}, StructureBytes{256, 516, 1024}, StructureBytes{256, 512, 1020}})
        EXPECT_FALSE(is_right(wrong, built));
}

}  // namespace
}  // namespace voxilux

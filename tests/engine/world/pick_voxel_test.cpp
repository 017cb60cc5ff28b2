#include "world/pick_voxel.h"

#include <gtest/gtest.h>

#include <random>

namespace voxilux {
namespace {

constexpr glm::ivec3 kOrigin{-7, 5, 100};

// Voxels at random, many and few, so that rays cross empty chunks and full ones.
VoxelWorld random_world(std::mt19937& random) {
    VoxelWorld world(kOrigin, {3, 2, 3});
    std::uniform_int_distribution<int> any(0, 1 << 20);
    for (int i = 0; i < 60; ++i) {
        const glm::ivec3 cell{any(random) % world.size().x, any(random) % world.size().y,
                              any(random) % world.size().z};
        world.set(cell, static_cast<std::uint16_t>(i));
    }
    return world;
}

// The nearest of all voxels by slabs: another algorithm, without a grid.
std::optional<PickedVoxel> nearest_by_slabs(const VoxelWorld& world, glm::dvec3 start, glm::dvec3 direction) {
    std::optional<PickedVoxel> nearest;
    world.for_each_voxel([&](glm::ivec3 local, std::uint16_t voxel) {
        const glm::ivec3 cell = local + world.origin();
        double in = 0.0, out = 1e300;
        glm::ivec3 normal(0);
        for (int axis = 0; axis < 3; ++axis) {
            double a = (cell[axis] - start[axis]) / direction[axis];
            double b = (cell[axis] + 1 - start[axis]) / direction[axis];
            if (a > b) std::swap(a, b);
            if (a > in) {
                in = a;
                normal = glm::ivec3(0);
                normal[axis] = direction[axis] > 0.0 ? -1 : 1;
            }
            out = std::min(out, b);
        }
        if (in >= out || (nearest && nearest->distance <= in)) return;
        nearest = PickedVoxel{cell, normal, voxel & 0x7FFFu, in};
    });
    return nearest;
}

TEST(PickVoxel, is_the_nearest_voxel_on_the_ray) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-60.0, 110.0), part(-1.0, 1.0);
    int hits = 0;
    for (int i = 0; i < 20; ++i) {
        const VoxelWorld world = random_world(random);
        for (int ray = 0; ray < 400; ++ray) {
            const glm::dvec3 start =
                glm::dvec3(kOrigin) + glm::dvec3(place(random), place(random), place(random));
            const glm::dvec3 target =
                glm::dvec3(kOrigin) + 24.0 + 24.0 * glm::dvec3(part(random), part(random), part(random));
            const glm::dvec3 direction = glm::normalize(target - start);
            const auto picked = pick_voxel(world, start, direction);
            const auto expected = nearest_by_slabs(world, start, direction);
            ASSERT_EQ(picked.has_value(), expected.has_value()) << i << " " << ray;
            if (!picked) continue;
            ++hits;
            EXPECT_EQ(picked->cell, expected->cell) << i << " " << ray;
            EXPECT_EQ(picked->material, expected->material);
            EXPECT_EQ(picked->normal, expected->normal);
            EXPECT_NEAR(picked->distance, expected->distance, 1e-9);  // of some 200 voxels in doubles
        }
    }
    EXPECT_GT(hits, 100);
}

TEST(PickVoxel, sees_along_axes_and_from_inside) {
    VoxelWorld world(glm::ivec3(0), {1, 1, 1});
    world.set({3, 4, 5}, 9);
    const auto down = pick_voxel(world, {3.5, 4.5, 50.0}, {0, 0, -1});
    ASSERT_TRUE(down);
    EXPECT_EQ(down->normal, glm::ivec3(0, 0, 1));
    EXPECT_DOUBLE_EQ(down->distance, 44.0);
    const auto inside = pick_voxel(world, {3.5, 4.5, 5.5}, {0, 0, -1});
    ASSERT_TRUE(inside);
    EXPECT_EQ(inside->normal, glm::ivec3(0));
    EXPECT_FALSE(pick_voxel(world, {3.5, 4.5, 50.0}, {0, 0, 1}));
    EXPECT_FALSE(pick_voxel(world, {2.5, 4.5, 50.0}, {0, 0, -1}));
}

}  // namespace
}  // namespace voxilux

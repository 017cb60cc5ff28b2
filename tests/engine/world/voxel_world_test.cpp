#include "world/voxel_world.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <tuple>

#include "support/test_scenes.h"

namespace voxilux {
namespace {

constexpr glm::ivec3 kChunks(2, 2, 1);

// What a plain map of cells says.
class PlainCells {
  public:
    void fill(const Box& box, std::uint16_t voxel) {
        for (int z = box.lo.z; z < box.hi.z; ++z)
            for (int y = box.lo.y; y < box.hi.y; ++y)
                for (int x = box.lo.x; x < box.hi.x; ++x)
                    if (voxel == VoxelWorld::kEmpty) {
                        cells_.erase({x, y, z});
                    } else {
                        cells_[{x, y, z}] = voxel;
                    }
    }

    void expect_equal(const VoxelWorld& world) const {
        EXPECT_EQ(world.voxel_count(), cells_.size());
        for (int z = 0; z < 16; ++z)
            for (int y = 0; y < 32; ++y)
                for (int x = 0; x < 32; ++x) {
                    const auto found = cells_.find({x, y, z});
                    ASSERT_EQ(world.get({x, y, z}),
                              found == cells_.end() ? VoxelWorld::kEmpty : found->second)
                        << x << ' ' << y << ' ' << z;
                }
    }

  private:
    std::map<std::tuple<int, int, int>, std::uint16_t> cells_;
};

Box random_box(std::mt19937& random) {
    const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    const glm::ivec3 lo(below(32), below(32), below(16));
    const glm::ivec3 extent(1 + below(9), 1 + below(9), 1 + below(9));
    return {lo, glm::min(lo + extent, glm::ivec3(32, 32, 16))};
}

// Boxes, and cells that are set and cleared: a change must not reach other cells that share the box's brick.
TEST(VoxelWorld, boxes_and_cells_equal_a_plain_map) {
    std::mt19937 random(11);
    for (int trial = 0; trial < 20; ++trial) {
        VoxelWorld world(glm::ivec3(0), kChunks);
        PlainCells plain;
        for (int i = 0; i < 40; ++i) {
            Box box = random_box(random);
            const auto material = static_cast<std::uint16_t>(random() % 3);
            const auto voxel = static_cast<std::uint16_t>(0x8000 | material);
            if (i % 2 == 0) {
                world.fill(box, material);
                plain.fill(box, voxel);
                continue;
            }
            box.hi = box.lo + 1;
            const bool clears = i % 4 == 1;
            world.put(box.lo, clears ? VoxelWorld::kEmpty : voxel);
            plain.fill(box, clears ? VoxelWorld::kEmpty : voxel);
        }
        plain.expect_equal(world);
    }
}

TEST(VoxelWorld, equal_parts_of_boxes_are_stored_once) {
    VoxelWorld world(glm::ivec3(0), glm::ivec3(40));
    world.fill({glm::ivec3(1), glm::ivec3(639)}, 7);
    EXPECT_EQ(world.voxel_count(), 638ull * 638ull * 638ull);
    EXPECT_LE(world.brick_count(), 27u);  // first, middle and last parts along each axis
    const std::size_t before = world.brick_count();
    world.put(glm::ivec3(300), VoxelWorld::kEmpty);
    EXPECT_EQ(world.brick_count(), before + 1) << "one cell differs, so its brick is its own";
    EXPECT_EQ(world.get(glm::ivec3(304)), 0x8007);
}

// Every symmetry: a model of boxes is the model of its voxels.
TEST(VoxelWorld, models_of_boxes_equal_those_of_voxels) {
    for (int symmetry = 0; symmetry < 48; ++symmetry) {
        Scene of_voxels = test::white_scene();
        test::add_box(of_voxels, {-3, 2, 5}, {4, 4, 8});
        Instance& instance = of_voxels.instances[0];
        const auto first = static_cast<std::uint8_t>(symmetry % 3);
        const auto second = static_cast<std::uint8_t>((first + 1 + symmetry / 3 % 2) % 3);
        instance.rotation.axis = {first, second, static_cast<std::uint8_t>(3 - first - second)};
        for (std::size_t axis = 0; axis < 3; ++axis)
            instance.rotation.sign[axis] = (symmetry / 6 >> axis & 1) != 0 ? std::int8_t{-1} : std::int8_t{1};
        Scene of_boxes = of_voxels;
        VoxelModel& model = of_boxes.models[0];
        model.voxels.clear();
        model.boxes = {{{{0, 0, 0}, {3, 2, 3}}, 0}, {{{3, 0, 0}, model.size}, 0}};
        EXPECT_EQ(voxel_bounds(of_boxes), voxel_bounds(of_voxels)) << symmetry;
        const VoxelWorld want = build_world(of_voxels), got = build_world(of_boxes);
        EXPECT_EQ(got.voxel_count(), want.voxel_count()) << symmetry;
        want.for_each_voxel([&](glm::ivec3 cell, std::uint16_t voxel) { EXPECT_EQ(got.get(cell), voxel); });
    }
}

}  // namespace
}  // namespace voxilux

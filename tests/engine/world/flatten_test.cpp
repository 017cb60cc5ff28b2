// Instances that overlap, flattened by several threads, against an array that takes one voxel after the
// other.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "world/voxel_world.h"

namespace voxilux {
namespace {

constexpr int kEdge = 320, kBefore = 160;  // of the array around the origin

class PlainArray {
  public:
    explicit PlainArray(const Scene& scene) : cells_(std::size_t{kEdge} * kEdge * kEdge) {
        for (const Instance& instance : scene.instances) {
            const VoxelModel& model = scene.models[instance.model];
            for (const Voxel& voxel : model.voxels)
                set(instance, model.size, {voxel.x, voxel.y, voxel.z}, voxel.material);
            for (const VoxelBox& box : model.boxes)
                for (int z = box.cells.lo.z; z < box.cells.hi.z; ++z)
                    for (int y = box.cells.lo.y; y < box.cells.hi.y; ++y)
                        for (int x = box.cells.lo.x; x < box.cells.hi.x; ++x)
                            set(instance, model.size, {x, y, z}, box.material);
        }
    }

    // How many cells of the world are not what they are here, and how many voxels too many or too few.
    [[nodiscard]] std::uint64_t differences(const VoxelWorld& world) const {
        std::uint64_t wrong = 0, filled = 0;
        for (const std::uint16_t cell : cells_)
            filled += cell != 0 ? 1 : 0;
        world.for_each_voxel([&](glm::ivec3 local, std::uint16_t voxel) {
            wrong += cells_.at(index(local + world.origin())) != voxel ? 1 : 0;
        });
        const std::uint64_t count = world.voxel_count();
        return wrong + (count > filled ? count - filled : filled - count);
    }

  private:
    static std::size_t index(glm::ivec3 cell) {
        const glm::ivec3 c = cell + kBefore;
        return static_cast<std::size_t>(c.x + kEdge * (c.y + kEdge * c.z));
    }
    // floor(R (v + 1/2 - pivot)) + translation, in halves.
    void set(const Instance& instance, glm::ivec3 size, glm::ivec3 v, std::uint16_t material) {
        glm::ivec3 cell;
        for (std::size_t row = 0; row < 3; ++row) {
            const int from = instance.rotation.axis[row];
            const int halves = instance.rotation.sign[row] * (2 * v[from] + 1 - 2 * (size[from] / 2));
            cell[static_cast<int>(row)] = (halves >> 1) + instance.translation[static_cast<int>(row)];
        }
        cells_.at(index(cell)) = static_cast<std::uint16_t>(0x8000 | material);
    }

    std::vector<std::uint16_t> cells_;
};

// Each cell with a chance of one in `one_in`.
VoxelModel random_model(glm::ivec3 size, unsigned one_in, std::uint16_t material, std::mt19937& dice) {
    VoxelModel model{.size = size};
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                if (dice() % one_in == 0)
                    model.voxels.push_back({static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y),
                                            static_cast<std::uint16_t>(z), material});
    std::shuffle(model.voxels.begin(), model.voxels.end(), dice);
    return model;
}

Rotation random_rotation(std::mt19937& dice) {
    Rotation rotation;
    std::shuffle(rotation.axis.begin(), rotation.axis.end(), dice);
    for (std::int8_t& sign : rotation.sign)
        sign = dice() % 2 == 0 ? std::int8_t{1} : std::int8_t{-1};
    return rotation;
}

// Models of far more voxels than a thread takes at once, small ones, one of boxes, and an empty one; their
// instances overlap, or lie apart and are written at the same time.
Scene crowded_scene(std::uint32_t seed) {
    std::mt19937 dice(seed);
    Scene scene;
    scene.materials.resize(6);
    scene.models = {
        random_model({70, 61, 50}, 2, 0, dice),
        random_model({50, 64, 40}, 1, 1, dice),
        random_model({9, 7, 5}, 2, 2, dice),
        random_model({64, 64, 64}, 40, 3, dice),
        {.size = {40, 30, 20}, .boxes = {{{{0, 0, 0}, {40, 30, 9}}, 4}, {{{3, 4, 9}, {20, 9, 20}}, 5}}},
        {.size = {4, 4, 4}}};
    for (int i = 0; i < 120; ++i) {
        const auto model = static_cast<std::uint32_t>(i % 11 < 6 ? i % 11 : 2);
        const auto place = [&] { return static_cast<int>(dice() % 160) - 80; };
        scene.instances.push_back({model, random_rotation(dice), {place(), place(), place()}});
    }
    return scene;
}

TEST(Flatten, crowded_scenes_equal_an_array_that_takes_voxel_after_voxel) {
    for (const std::uint32_t seed : {1u, 2u, 3u}) {
        const Scene scene = crowded_scene(seed);
        EXPECT_EQ(PlainArray(scene).differences(build_world(scene)), 0u) << seed;
    }
}

// Negative control: of two instances that overlap, the later one wins.
TEST(Flatten, comparison_sees_two_instances_in_the_wrong_order) {
    Scene scene = crowded_scene(4);
    scene.instances[0].model = 0;
    scene.instances[1] = {1, {}, scene.instances[0].translation};
    scene.instances.resize(2);
    const VoxelWorld world = build_world(scene);
    EXPECT_EQ(PlainArray(scene).differences(world), 0u);
    std::swap(scene.instances[0], scene.instances[1]);
    EXPECT_GT(PlainArray(scene).differences(world), 1000u);
}

TEST(Flatten, bricks_are_as_many_as_hold_a_voxel) {
    Scene scene;
    scene.materials.resize(1);
    scene.models = {{.size = {256, 1, 1}, .voxels = {{0, 0, 0, 0}, {2, 0, 0, 0}, {255, 0, 0, 0}}}};
    scene.instances = {{.model = 0}};
    const VoxelWorld world = build_world(scene);
    EXPECT_EQ(world.voxel_count(), 3u);
    EXPECT_EQ(world.brick_count(), 2u);
}

}  // namespace
}  // namespace voxilux

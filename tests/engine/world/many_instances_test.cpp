// Ten thousand instances of a model: the memory of the file, the world and its structures, and whether every
// voxel lies where direct flattening puts it.

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "formats/vox_read.h"
#include "scene/vox_scene.h"
#include "support/allocation_counter.h"
#include "support/vox_builder.h"
#include "world/march_world.h"

namespace voxilux {
namespace {

using namespace vox_builder;

constexpr int kInstances = 10000;
constexpr int kPerRow = 22;  // 22^3 places
constexpr glm::ivec3 kModelSize(13, 10, 11);
constexpr std::size_t kMib = std::size_t{1} << 20;

// Turns and mirrors as the format packs them: two bits each for the axes of the first rows, one sign per row.
constexpr std::array kTurns = {"4", "40", "17", "84", "2", "118"};

// A lopsided shell of some 500 voxels in four colours.
std::string model_chunks() {
    std::vector<Cell> cells;
    for (int i = 0; i < kModelSize.x * kModelSize.y * kModelSize.z; ++i) {
        const glm::ivec3 c(i % kModelSize.x, i / kModelSize.x % kModelSize.y,
                           i / kModelSize.x / kModelSize.y);
        const bool is_wall = c.x == 0 || c.y == 0 || c.z == 0 || c.x == kModelSize.x - 1;
        if (is_wall && (c.x + 2 * c.y) % 7 != 0) cells.push_back({c.x, c.y, c.z, 1 + (c.x + c.y + c.z) % 4});
    }
    return size_chunk(kModelSize.x, kModelSize.y, kModelSize.z) + voxels_chunk(cells);
}

// Places are closer than the model is long, so neighbours overlap and the later one wins.
std::vector<std::byte> file_of(int instances) {
    std::string chunks = model_chunks();
    std::vector<int> children;
    for (int i = 0; i < instances; ++i)
        children.push_back(3 + i);
    chunks += transform(0, 1, -1, {{}}) + group(1, children) + shape(2, {{0, {}}});
    for (int i = 0; i < instances; ++i) {
        const std::string place = std::to_string(i % kPerRow * 11) + " " +
                                  std::to_string(i / kPerRow % kPerRow * 11) + " " +
                                  std::to_string(i / kPerRow / kPerRow * 11);
        chunks += transform(3 + i, 2, -1,
                            {{{"_t", place}, {"_r", kTurns[static_cast<std::size_t>(i) % kTurns.size()]}}});
    }
    return file(chunks);
}

Scene scene_of(const std::vector<std::byte>& bytes) {
    const auto read = read_vox(bytes);
    EXPECT_TRUE(read) << (read ? "" : read.reason());
    return scene_from_vox(read.value());
}

// Component `row` of floor(R (v + 1/2 - pivot)) + translation, in halves.
int flattened(const Instance& instance, glm::ivec3 size, glm::ivec3 v, std::size_t row) {
    const int from = instance.rotation.axis[row];
    const int halves = instance.rotation.sign[row] * (2 * v[from] + 1 - 2 * (size[from] / 2));
    return (halves >> 1) + instance.translation[static_cast<int>(row)];
}

// Every cell of a box around the origin, by direct flattening.
class Flattened {
  public:
    explicit Flattened(const Scene& scene) : cells_(std::size_t{kEdge} * kEdge * kEdge) {
        for (const Instance& instance : scene.instances) {
            const VoxelModel& model = scene.models[instance.model];
            for (const Voxel& voxel : model.voxels) {
                const glm::ivec3 v(voxel.x, voxel.y, voxel.z);
                const glm::ivec3 cell(flattened(instance, model.size, v, 0),
                                      flattened(instance, model.size, v, 1),
                                      flattened(instance, model.size, v, 2));
                std::uint16_t& place = at(cell);
                count_ += place == 0 ? 1 : 0;
                place = static_cast<std::uint16_t>(voxel.material + 1);
            }
        }
    }

    // Material + 1, or 0 where nothing is.
    std::uint16_t& at(glm::ivec3 cell) {
        const glm::ivec3 c = cell + kBefore;
        return cells_.at(static_cast<std::size_t>(c.x + kEdge * (c.y + kEdge * c.z)));
    }
    [[nodiscard]] std::uint64_t count() const { return count_; }

  private:
    static constexpr int kEdge = 280;
    static constexpr int kBefore = 16;
    std::vector<std::uint16_t> cells_;
    std::uint64_t count_ = 0;
};

TEST(ManyInstances, every_voxel_lies_where_direct_flattening_puts_it) {
    const Scene scene = scene_of(file_of(kInstances));
    ASSERT_EQ(scene.instances.size(), static_cast<std::size_t>(kInstances));
    ASSERT_EQ(scene.models.size(), 1u);
    const VoxelWorld world = build_world(scene);
    Flattened direct(scene);
    EXPECT_EQ(world.voxel_count(), direct.count());
    std::uint64_t wrong = 0;
    world.for_each_voxel([&](glm::ivec3 local, std::uint16_t voxel) {
        wrong += direct.at(world.origin() + local) != (voxel & 0x7FFFu) + 1u ? 1 : 0;
    });
    EXPECT_EQ(wrong, 0u);
}

// Negative control: one instance moved by a voxel.
TEST(ManyInstances, comparison_notices_one_instance_moved_by_one_voxel) {
    Scene scene = scene_of(file_of(100));
    const VoxelWorld world = build_world(scene);
    scene.instances[57].translation.y += 1;
    Flattened direct(scene);
    std::uint64_t wrong = 0;
    world.for_each_voxel([&](glm::ivec3 local, std::uint16_t voxel) {
        wrong += direct.at(world.origin() + local) != (voxel & 0x7FFFu) + 1u ? 1 : 0;
    });
    EXPECT_GT(wrong, 10u);
}

std::uint64_t brick_count(const VoxelWorld& world) {
    std::uint64_t bricks = 0;
    world.for_each_chunk([&](glm::ivec3, const VoxelWorld::ChunkBricks& numbers) {
        for (const std::uint32_t number : numbers)
            bricks += number != VoxelWorld::kNoBrick ? 1 : 0;
    });
    return bricks;
}

TEST(ManyInstances, load_in_memory_that_their_count_and_the_bricks_bound) {
    const std::vector<std::byte> bytes = file_of(kInstances);
    const PeakAllocation loading;
    const Scene scene = scene_of(bytes);
    const std::size_t loading_bytes = loading.bytes();
    // The graph as text attributes, some hundred bytes a node; the model's voxels are there once.
    EXPECT_LT(loading_bytes, kInstances * std::size_t{1024} + kMib);

    const PeakAllocation flattening;
    const VoxelWorld world = build_world(scene);
    const std::size_t flattening_bytes = flattening.bytes();
    const std::uint64_t bricks = brick_count(world);
    std::uint64_t chunks = 0;
    world.for_each_chunk([&](glm::ivec3, const VoxelWorld::ChunkBricks&) { ++chunks; });
    // A vector that grows holds up to three times its contents: twice when full, and the old half.
    EXPECT_LT(flattening_bytes,
              3 * (bricks * sizeof(VoxelWorld::Brick) + chunks * sizeof(VoxelWorld::ChunkBricks)) + kMib);
    RecordProperty("loading_bytes", std::to_string(loading_bytes));
    RecordProperty("flattening_bytes", std::to_string(flattening_bytes));
    RecordProperty("bricks", std::to_string(bricks));
}

TEST(ManyInstances, structures_are_built_in_memory_that_their_size_bounds) {
    const VoxelWorld world = build_world(scene_of(file_of(500)));
    const std::uint64_t bricks = brick_count(world);
    for (const Traversal traversal : all_traversals()) {
        const PeakAllocation building;
        const MarchWorld built = build_march_world(world, traversal);
        // Arrays that grow, a second copy of the level that grows boxes, and an index of distinct bricks.
        EXPECT_LT(building.bytes(), 4 * built.size_bytes() + 512 * bricks) << name_of(traversal);
    }
}

}  // namespace
}  // namespace voxilux

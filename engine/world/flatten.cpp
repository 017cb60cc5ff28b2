// The voxels of a scene's instances, put into their world by several threads. First every brick that they
// touch gets its room, then they are written. Instances whose boxes do not meet may be written in any order,
// at once.

#include <algorithm>
#include <array>
#include <atomic>
#include <span>

#include "base/parallel_blocks.h"
#include "shared/world_cell.h"
#include "world/voxel_world.h"

namespace voxilux {
namespace {

constexpr std::size_t kVoxelsAtOnce = std::size_t{1} << 15;
constexpr std::size_t kMostAtOnce = 64;  // instances, each of which is compared with those before
constexpr int kBrickBits = 6, kChunkShift = 2 * kBrickBits;

std::size_t chunk_of(std::uint64_t place) {
    return static_cast<std::size_t>(place >> kChunkShift);
}

std::uint32_t brick_of(std::uint64_t place) {
    return static_cast<std::uint32_t>(place >> kBrickBits & 63);
}

std::uint32_t cell_of(std::uint64_t place) {
    return static_cast<std::uint32_t>(place & 63);
}

bool overlap(const Box& a, const Box& b) {
    return glm::all(glm::lessThan(a.lo, b.hi)) && glm::all(glm::lessThan(b.lo, a.hi));
}

void store(std::uint32_t& word, std::uint32_t value) {
    std::atomic_ref(word).store(value, std::memory_order_relaxed);
}

}  // namespace

class Flattening {
  public:
    Flattening(const Scene& scene, VoxelWorld& world)
        : scene_(scene), world_(world), filled_(voxel_boxes(scene.models)) {}

    void run() {
        for_each_batch(
            [&](const Batch& batch) { for_each_piece(batch, [&](const Piece& p) { mark_chunks(p); }); });
        number_chunks();
        for_each_batch(
            [&](const Batch& batch) { for_each_piece(batch, [&](const Piece& p) { mark_bricks(p); }); });
        number_bricks();
        for_each_batch([&](const Batch& batch) {
            std::atomic<std::uint64_t> added{0};
            for_each_piece(batch, [&](const Piece& p) { added += write(p); });
            world_.voxel_count_ += added;
            for (const Instance& instance : batch)
                fill_boxes(instance);
        });
    }

  private:
    // Where the voxels of an instance lie: chunk, brick and cell in one number, the sum of what each
    // coordinate of a voxel adds to it.
    class VoxelPlaces {
      public:
        VoxelPlaces(const Instance& instance, const VoxelModel& model, const Box& filled,
                    const VoxelWorld& world) {
            if (filled.empty()) return;
            const glm::ivec3 zero = world_cell(instance, model.size, glm::ivec3(0)) - world.origin();
            const std::array<std::uint64_t, 3> strides = {
                1, static_cast<std::uint64_t>(world.chunks().x),
                static_cast<std::uint64_t>(world.chunks().x) * static_cast<std::uint64_t>(world.chunks().y)};
            for (int axis = 0; axis < 3; ++axis) {
                const auto to = static_cast<std::size_t>(axis);
                const std::uint8_t from = instance.rotation.axis[to];
                std::vector<std::uint64_t>& parts = parts_[from];
                parts.resize(static_cast<std::size_t>(filled.hi[from]));
                for (int i = filled.lo[from]; i < filled.hi[from]; ++i) {
                    const auto cell = static_cast<std::uint64_t>(zero[axis] + instance.rotation.sign[to] * i);
                    parts[static_cast<std::size_t>(i)] =
                        (cell >> gpu::kChunkLog2) * strides[to] << kChunkShift |
                        (cell >> gpu::kBrickLog2 & 3) << (kBrickBits + 2 * axis) | (cell & 3) << (2 * axis);
                }
            }
        }

        [[nodiscard]] std::uint64_t of(const Voxel& voxel) const {
            return parts_[0][voxel.x] + parts_[1][voxel.y] + parts_[2][voxel.z];
        }

      private:
        std::array<std::vector<std::uint64_t>, 3> parts_;  // by coordinate
    };

    // Some voxels of an instance.
    struct Piece {
        const VoxelPlaces& places;
        std::span<const Voxel> voxels;
    };

    using Batch = std::span<const Instance>;

    const VoxelModel& model_of(const Instance& instance) const { return scene_.models[instance.model]; }

    // Of the voxels, in the scene.
    Box box_of(const Instance& instance) const {
        const Box& filled = filled_[instance.model];
        return filled.empty() ? filled : world_cells(instance, model_of(instance).size, filled);
    }

    // Instances that follow each other and have no cell in common. One with boxes comes alone.
    Batch next_batch(std::size_t first) const {
        const Batch rest = Batch(scene_.instances).subspan(first);
        std::vector<Box> boxes;
        for (const Instance& instance : rest.first(std::min(rest.size(), kMostAtOnce))) {
            const Box box = box_of(instance);
            const bool is_alone = !model_of(instance).boxes.empty() || !model_of(rest.front()).boxes.empty();
            const bool meets =
                std::ranges::any_of(boxes, [&](const Box& other) { return overlap(box, other); });
            if (!boxes.empty() && (is_alone || meets)) break;
            boxes.push_back(box);
        }
        return rest.first(boxes.size());
    }

    template <class Visit>
    void for_each_batch(const Visit& visit) const {
        for (std::size_t first = 0; first < scene_.instances.size();) {
            const Batch batch = next_batch(first);
            visit(batch);
            first += batch.size();
        }
    }

    template <class Visit>
    void for_each_piece(const Batch& batch, const Visit& visit) const {
        std::vector<VoxelPlaces> places;
        places.reserve(batch.size());
        std::vector<Piece> pieces;
        std::size_t count = 0;
        for (const Instance& instance : batch) {
            const std::span<const Voxel> voxels = model_of(instance).voxels;
            places.emplace_back(instance, model_of(instance), filled_[instance.model], world_);
            for (std::size_t i = 0; i < voxels.size(); i += kVoxelsAtOnce)
                pieces.push_back(
                    {places.back(), voxels.subspan(i, std::min(kVoxelsAtOnce, voxels.size() - i))});
            count += voxels.size();
        }
        for_each_block(pieces.size(), threads_for(count, kVoxelsAtOnce),
                       [&] { return [&](std::size_t i) { visit(pieces[i]); }; });
    }

    void mark_chunks(const Piece& piece) const {
        std::size_t last = ~std::size_t{0};
        for (const Voxel& voxel : piece.voxels) {
            const std::size_t chunk = chunk_of(piece.places.of(voxel));
            if (chunk != last) store(world_.chunk_slots_[chunk], 0);
            last = chunk;
        }
    }

    void number_chunks() {
        std::uint32_t count = 0;
        for (std::uint32_t& slot : world_.chunk_slots_) {
            if (slot != VoxelWorld::kNoBrick) slot = count++;
        }
        VoxelWorld::ChunkBricks none;
        none.fill(VoxelWorld::kNoBrick);
        world_.chunk_bricks_.assign(count, none);
    }

    void mark_bricks(const Piece& piece) const {
        std::uint64_t last = ~std::uint64_t{0};
        for (const Voxel& voxel : piece.voxels) {
            const std::uint64_t place = piece.places.of(voxel);
            if (place >> kBrickBits != last) store(brick_number(place), 0);
            last = place >> kBrickBits;
        }
    }

    void number_bricks() {
        std::uint32_t count = 0;
        for (VoxelWorld::ChunkBricks& bricks : world_.chunk_bricks_)
            for (std::uint32_t& number : bricks)
                if (number != VoxelWorld::kNoBrick) number = count++;
        world_.bricks_.reserve(count + count / 8);  // else the first edit would copy all of them
        world_.bricks_.resize(count);
        world_.is_shared_.resize(count);
    }

    // How many cells were empty.
    std::uint64_t write(const Piece& piece) const {
        std::uint64_t added = 0;
        std::uint64_t last = ~std::uint64_t{0};
        VoxelWorld::Brick* brick = nullptr;
        for (const Voxel& voxel : piece.voxels) {
            const std::uint64_t place = piece.places.of(voxel);
            if (place >> kBrickBits != last) brick = &world_.bricks_[brick_number(place)];
            last = place >> kBrickBits;
            std::uint16_t& cell = (*brick)[cell_of(place)];
            added += cell == VoxelWorld::kEmpty ? 1 : 0;
            cell = static_cast<std::uint16_t>(gpu::kVoxelSolidBit | voxel.material);
        }
        return added;
    }

    void fill_boxes(const Instance& instance) {
        for (const VoxelBox& box : model_of(instance).boxes) {
            const Box cells = world_cells(instance, model_of(instance).size, box.cells);
            world_.fill({cells.lo - world_.origin(), cells.hi - world_.origin()}, box.material);
        }
    }

    std::uint32_t& brick_number(std::uint64_t place) const {
        return world_.chunk_bricks_[world_.chunk_slots_[chunk_of(place)]][brick_of(place)];
    }

    const Scene& scene_;
    VoxelWorld& world_;
    std::vector<Box> filled_;  // by model: of its voxels
};

VoxelWorld build_world(const Scene& scene, std::uint64_t limit_chunks) {
    const WorldGrid grid = grid_around(voxel_bounds(scene), limit_chunks);
    VoxelWorld world(grid.origin, grid.chunks);
    Flattening(scene, world).run();
    return world;
}

}  // namespace voxilux

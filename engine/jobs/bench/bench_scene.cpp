#include "jobs/bench/bench_scene.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "formats/scene_toml.h"
#include "scene/scene_camera.h"
#include "scene/terrain.h"
#include "shared/rng.h"

namespace voxilux {
namespace {

constexpr int kBoxes = 24;
constexpr int kSpheres = 30;
constexpr int kSkin = 2;        // voxels, of boxes and spheres
constexpr int kGroundSkin = 4;  // voxels, at least
constexpr int kMaterialsEach = 8;

enum Stream : std::uint32_t { kBoxStream = 1, kSphereStream = 2 };

// Random numbers of one object.
struct Dice {
    std::uint32_t seed;
    Stream stream;
    std::uint32_t object;
    std::uint32_t next = 0;

    // Between `low` and `high`, which are fractions of `extent`, in voxels.
    double between(double low, double high, int extent) {
        const double u = static_cast<double>(gpu::rng_float(seed, stream, object, next++));
        return (low + (high - low) * u) * extent;
    }
};

// The heights of the ground, and the voxels that are placed.
class ProceduralWorld {
  public:
    ProceduralWorld(int extent, std::uint32_t seed)
        : world(glm::ivec3(0), glm::ivec3(extent / 16)), extent_(extent), seed_(seed) {
        const TerrainShape shape{.from = {0, 0, 0},
                                 .to = {extent, extent, extent / 4},
                                 .seed = seed,
                                 .feature = std::max(4, extent / 4)};
        const auto columns = static_cast<std::size_t>(extent);
        heights_.resize(columns * columns);
        for (int y = 0; y < extent; ++y)
            terrain_heights(shape, 0, y,
                            std::span(heights_).subspan(static_cast<std::size_t>(y) * columns, columns));
        for (int& height : heights_)
            height = std::max(1, height);
    }

    void draw() {
        draw_ground();
        for (std::uint32_t i = 0; i < kBoxes; ++i)
            draw_box(Dice{seed_, kBoxStream, i});
        for (std::uint32_t i = 0; i < kSpheres; ++i)
            draw_sphere(Dice{seed_, kSphereStream, i});
    }

    VoxelWorld world;

  private:
    [[nodiscard]] int height(int x, int y) const {
        const auto column = glm::clamp(glm::ivec2(x, y), 0, extent_ - 1);
        return heights_[static_cast<std::size_t>(column.x) +
                        static_cast<std::size_t>(extent_) * static_cast<std::size_t>(column.y)];
    }

    // The border of the grid stays empty, as VoxelWorld requires.
    void put(glm::ivec3 cell, int material) {
        if (glm::any(glm::lessThan(cell, glm::ivec3(1))) ||
            glm::any(glm::greaterThanEqual(cell, glm::ivec3(extent_ - 1))))
            return;
        world.set(cell, static_cast<std::uint16_t>(material));
    }

    // A column reaches down to its lowest neighbour, so that steep ground has no holes.
    void draw_ground() {
        const int film_tile = std::max(1, extent_ / 4 / kMaterialsEach);
        for (int y = 0; y < extent_; ++y) {
            for (int x = 0; x < extent_; ++x) {
                const int top = height(x, y);
                const int lowest =
                    std::min({height(x - 1, y), height(x + 1, y), height(x, y - 1), height(x, y + 1), top});
                for (int z = std::min(lowest, top - kGroundSkin + 1); z <= top; ++z)
                    put({x, y, z}, std::clamp(z / film_tile, 0, kMaterialsEach - 1));
            }
        }
    }

    void draw_box(Dice dice) {
        const auto pick = [&](double low, double high) {
            return static_cast<int>(dice.between(low, high, extent_));
        };
        const glm::ivec2 edge(pick(0.06, 0.16), pick(0.06, 0.16));
        const glm::ivec2 from(pick(0.05, 0.8), pick(0.05, 0.8));
        const glm::ivec2 to = from + edge;
        const int floor = std::min(
            {height(from.x, from.y), height(to.x, from.y), height(from.x, to.y), height(to.x, to.y)});
        const int roof = std::max({height(from.x, from.y), height(to.x, to.y)}) + pick(0.1, 0.3);
        const int material = kMaterialsEach + static_cast<int>(dice.object) % kMaterialsEach;
        for (int y = from.y; y < to.y; ++y) {
            for (int x = from.x; x < to.x; ++x) {
                const glm::ivec2 in = glm::min(glm::ivec2(x, y) - from, to - 1 - glm::ivec2(x, y));
                const bool is_wall = in.x < kSkin || in.y < kSkin;
                const int along = in.x < kSkin ? y - from.y : x - from.x;
                for (int z = is_wall ? floor : roof - kSkin + 1; z <= roof; ++z) {
                    const bool is_window =
                        is_wall && z < roof - kSkin && is_open(along) && is_open(z - floor);
                    if (!is_window) put({x, y, z}, material);
                }
            }
        }
    }

    // Whether a position along one direction of a wall is inside a window.
    [[nodiscard]] bool is_open(int along) const {
        const int period = std::max(4, extent_ / 16);
        const int at = along % period;
        return at >= period / 4 && at < period - period / 4;
    }

    // Fills the cells between two spheres, column by column.
    void draw_sphere(Dice dice) {
        const double radius = std::max(3.0, dice.between(0.02, 0.055, extent_));
        const glm::dvec3 centre(dice.between(0.1, 0.9, extent_), dice.between(0.1, 0.9, extent_),
                                dice.between(0.2, 0.5, extent_));
        const int material = 2 * kMaterialsEach + static_cast<int>(dice.object) % kMaterialsEach;
        const int reach = static_cast<int>(radius) + 1;
        const double inside = radius - kSkin;
        for (int dy = -reach; dy <= reach; ++dy) {
            for (int dx = -reach; dx <= reach; ++dx) {
                const double square = static_cast<double>(dx) * dx + static_cast<double>(dy) * dy;
                if (square > radius * radius) continue;
                const int far = static_cast<int>(std::sqrt(radius * radius - square));
                const int near =
                    square > inside * inside ? 0 : static_cast<int>(std::sqrt(inside * inside - square)) + 1;
                for (int dz = near; dz <= far; ++dz) {
                    put(glm::ivec3(centre) + glm::ivec3(dx, dy, dz), material);
                    put(glm::ivec3(centre) + glm::ivec3(dx, dy, -dz), material);
                }
            }
        }
    }

    int extent_;
    std::uint32_t seed_;
    std::vector<int> heights_;  // of the ground, x fastest
};

}  // namespace

BenchScene procedural_scene(int extent, std::uint32_t seed) {
    VX_ASSERT(extent >= kMinExtent && extent <= kMaxExtent && extent % 16 == 0);
    ProceduralWorld procedural(extent, seed);
    procedural.draw();
    const Camera camera{.position = glm::dvec3(0.04, 0.06, 0.68) * static_cast<double>(extent),
                        .yaw_deg = 42.0,
                        .pitch_deg = -31.0,
                        .fov_y_deg = 42.0};
    return {"procedural", extent, std::move(procedural.world), camera};
}

BenchScene file_scene(const std::filesystem::path& file, glm::ivec2 size) {
    Scene scene = load_scene(file);
    scene.settings.size = size;
    VoxelWorld world = build_world(scene);
    if (world.voxel_count() == 0)
        throw Error(ExitCode::input_refused, fmt::format("{}: there is no voxel to march to", file.string()));
    const glm::ivec3 extent = world.size();
    return {file.filename().string(), std::max({extent.x, extent.y, extent.z}), std::move(world),
            camera_of(scene)};
}

}  // namespace voxilux

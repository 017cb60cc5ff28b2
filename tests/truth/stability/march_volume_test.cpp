// Rays by the million. Each traversal gets its part of 10^6 rays of every family (10^8 in the nightly run),
// each checked by the plain walk of voxels, some also by the walk in real numbers; and as many from inside
// closed shells, none of which may leave.

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <map>

#include "shared/hash.h"
#include "support/interval_walk.h"
#include "support/traversal_name.h"
#include "truth/stability/march_checkers.h"

namespace voxilux {
namespace {

constexpr int kRaysOfAFamily = 1000000;  // over all traversals
constexpr int kNightlyRounds = 100;
constexpr std::size_t kIntervalStride = 16;  // one ray in so many is also walked in real numbers

std::uint32_t seed_of(int round) {
    return test::kMarchSeed + 100u * static_cast<std::uint32_t>(round);
}

// Rays that start outside the world, 1 to 10^6 voxels back along their way.
test::RayFamily moved_outside(test::RayFamily family, glm::ivec3 size) {
    family.name += "_from_outside";
    const int edge = size.x + size.y + size.z;
    for (std::size_t i = 0; i < family.rays.size(); ++i) {
        gpu::Ray& ray = family.rays[i];
        const float far = i % 3 == 0 ? 1e6f : (i % 3 == 1 ? 1e3f : static_cast<float>(edge));
        ray.cell -= glm::ivec3(glm::floor(ray.direction * far));
    }
    return family;
}

std::vector<test::RayFamily> families(glm::ivec3 size, int count, std::uint32_t seed) {
    std::vector<test::RayFamily> all = test::ray_families(size, count, seed);
    all.push_back(moved_outside(all.front(), size));
    return all;
}

// What is wrong with a march through the world, according to the plain walk and, for one ray in
// kIntervalStride, to the walk in real numbers. Both start where the ray enters the world.
std::string first_fault(const VoxelWorld& world, const test::DenseVoxels& dense,
                        const std::vector<gpu::Ray>& rays, const std::vector<gpu::MarchProbe>& got) {
    const auto most = static_cast<gpu::uint>(dense.size().x + dense.size().y + dense.size().z + 3);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const gpu::MarchHit& hit = got[i].hit;
        std::string fault = test::difference(hit, test::walk_cells(dense, got[i].entry));
        if (world.contains(rays[i].cell) && std::memcmp(&got[i].entry, &rays[i], sizeof rays[i]) != 0)
            fault += " starts elsewhere";
        if (hit.steps > most || hit.fault != gpu::kMarchFine) fault += " takes too many steps or has a fault";
        if (i % kIntervalStride == 0 && world.contains(got[i].entry.cell))
            fault += test::disagreement(test::interval_walk(world, got[i].entry), hit);
        if (!fault.empty()) return test::print(rays[i]) + ": " + fault;
    }
    return "";
}

class MarchVolume : public ::testing::TestWithParam<Traversal> {};
using MarchVolumeNightly = MarchVolume;

int share(std::size_t parts) {
    const auto all = static_cast<int>(parts * all_traversals().size());
    return (kRaysOfAFamily + all - 1) / all;
}

void expect_plain_walks(Traversal traversal, int rounds) {
    const std::vector<test::NamedWorld> worlds = test::small_worlds(test::kMarchSeed);
    std::map<std::string, int> counts;
    for (const test::NamedWorld& named : worlds) {
        const MarchWorld built = build_march_world(named.world, traversal);
        const test::DenseVoxels dense(named.world);
        for (int round = 0; round < rounds; ++round) {
            const auto seed = seed_of(round) + 7u * static_cast<std::uint32_t>(traversal);
            for (const test::RayFamily& family : families(built.size(), share(worlds.size()), seed)) {
                const auto got = test::march_on_device(built, family.rays);
                ASSERT_EQ(first_fault(named.world, dense, family.rays, got), "")
                    << named.name << ", " << family.name << ", round " << round;
                counts[family.name] += static_cast<int>(family.rays.size());
            }
        }
    }
    EXPECT_GE(counts.size(), 10u);
    for (const auto& [name, count] : counts)
        EXPECT_GE(count, rounds * share(1)) << name;
}

TEST_P(MarchVolume, of_every_family_visits_the_cells_of_the_plain_walk) {
    expect_plain_walks(GetParam(), 1);
}

TEST_P(MarchVolumeNightly, of_every_family_visits_the_cells_of_the_plain_walk) {
    expect_plain_walks(GetParam(), kNightlyRounds);
}

using Inside = std::function<bool(glm::ivec3)>;

// The thinnest wall around some cells: their neighbours across a face.
VoxelWorld walled(glm::ivec3 chunks, const Inside& is_inside) {
    VoxelWorld world(glm::ivec3(0), chunks);
    const glm::ivec3 size = world.size();
    for (int i = 0; i < size.x * size.y * size.z; ++i) {
        const glm::ivec3 c(i % size.x, i / size.x % size.y, i / size.x / size.y);
        if (!is_inside(c)) continue;
        for (int direction = 0; direction < 6; ++direction) {
            glm::ivec3 next = c;
            next[direction / 2] += direction % 2 == 0 ? -1 : 1;
            if (!is_inside(next)) world.set(next, 1);
        }
    }
    return world;
}

struct Shell {
    std::string name;
    glm::ivec3 chunks;
    Inside is_inside;
};

// Walls of faces, of edges, of corners and of all three; all inside one border cell.
const std::vector<Shell>& shells() {
    static const std::vector<Shell> all = {
        {"box",
         {2, 1, 3},
         [](glm::ivec3 c) { return c.x > 1 && c.y > 2 && c.z > 3 && c.x < 29 && c.y < 14 && c.z < 46; }},
        {"octahedron", glm::ivec3(2),
         [](glm::ivec3 c) { return std::abs(c.x - 15) + std::abs(c.y - 16) + std::abs(c.z - 15) < 14; }},
        {"ball", glm::ivec3(3),
         [](glm::ivec3 c) {
             const glm::ivec3 d = c - 23;
             return d.x * d.x + d.y * d.y + d.z * d.z < 20 * 20;
         }},
        {"prism",
         {2, 2, 1},
         [](glm::ivec3 c) { return std::abs(c.x - 15) + std::abs(c.y - 16) < 14 && c.z > 0 && c.z < 15; }},
    };
    return all;
}

// A shell, and rays that start inside it.
struct Cage {
    VoxelWorld world;
    std::vector<glm::ivec3> inside;

    explicit Cage(const Shell& shell) : world(walled(shell.chunks, shell.is_inside)) {
        const glm::ivec3 size = world.size();
        for (int i = 0; i < size.x * size.y * size.z; ++i) {
            const glm::ivec3 c(i % size.x, i / size.x % size.y, i / size.x / size.y);
            if (shell.is_inside(c)) inside.push_back(c);
        }
    }

    [[nodiscard]] std::vector<gpu::Ray> moved_inside(std::vector<gpu::Ray> rays, std::uint32_t seed) const {
        for (std::size_t i = 0; i < rays.size(); ++i) {
            rays[i].cell = inside[gpu::pcg_hash(static_cast<std::uint32_t>(i) ^ seed) % inside.size()];
            rays[i].t_max = gpu::kUnbounded;
        }
        return rays;
    }
};

int leaks(const std::vector<gpu::MarchProbe>& got) {
    int count = 0;
    for (const gpu::MarchProbe& probe : got)
        count += probe.hit.face < gpu::kFaceInside ? 0 : 1;
    return count;
}

void expect_no_leaks(Traversal traversal, int rounds) {
    for (const Shell& shell : shells()) {
        const Cage cage(shell);
        const MarchWorld built = build_march_world(cage.world, traversal);
        for (int round = 0; round < rounds; ++round) {
            const auto seed = seed_of(round) + 31u * static_cast<std::uint32_t>(traversal);
            for (const test::RayFamily& family :
                 test::ray_families(built.size(), share(shells().size()), seed))
                ASSERT_EQ(leaks(test::march_on_device(built, cage.moved_inside(family.rays, seed))), 0)
                    << shell.name << ", " << family.name << ", round " << round;
        }
    }
}

TEST_P(MarchVolume, of_every_family_never_leaves_a_closed_shell) {
    expect_no_leaks(GetParam(), 1);
}

TEST_P(MarchVolumeNightly, of_every_family_never_leaves_a_closed_shell) {
    expect_no_leaks(GetParam(), kNightlyRounds);
}

INSTANTIATE_TEST_SUITE_P(Rays, MarchVolume, ::testing::ValuesIn(all_traversals()), test::traversal_name);
INSTANTIATE_TEST_SUITE_P(Rays, MarchVolumeNightly, ::testing::ValuesIn(all_traversals()),
                         test::traversal_name);

// Negative controls: a world with one voxel too many, and shells with one voxel missing.
TEST(MarchVolumeChecker, notices_one_voxel_that_the_structure_has_not) {
    VoxelWorld world = test::world_named("random_0.001");
    const MarchWorld built = build_march_world(world);
    world.set({24, 16, 8}, 3);
    const std::vector<gpu::Ray> rays = test::family_named("random", world.size(), 10000);
    const auto got = test::march_on_device(built, rays);
    EXPECT_NE(first_fault(world, test::DenseVoxels(world), rays, got), "");
}

TEST(MarchVolumeChecker, notices_a_hole_of_one_voxel_in_every_shell) {
    for (const Shell& shell : shells()) {
        const Cage cage(shell);
        std::vector<glm::ivec3> wall;
        cage.world.for_each_voxel([&](glm::ivec3 c, std::uint16_t) { wall.push_back(c); });
        VoxelWorld open(glm::ivec3(0), shell.chunks);
        for (const glm::ivec3& c : wall)
            if (c != wall[wall.size() / 2]) open.set(c, 1);
        const std::vector<gpu::Ray> rays = test::family_named("random", open.size(), 30000);
        EXPECT_GT(leaks(test::march_on_device(build_march_world(open), cage.moved_inside(rays, 1))), 0)
            << shell.name;
    }
}

}  // namespace
}  // namespace voxilux

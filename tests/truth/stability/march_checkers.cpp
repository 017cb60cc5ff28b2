#include "truth/stability/march_checkers.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "support/exact_walk.h"
#include "support/interval_walk.h"
#include "support/march_oracle.h"
#include "support/same_bits.h"

namespace voxilux::test {

const VoxelWorld& world_named(const std::string& name) {
    static const std::vector<NamedWorld> worlds = small_worlds(kMarchSeed);
    return std::ranges::find(worlds, name, &NamedWorld::name)->world;
}

std::vector<gpu::Ray> family_named(const std::string& name, glm::ivec3 size, int count) {
    const std::vector<RayFamily> families = ray_families(size, count, kMarchSeed);
    return std::ranges::find(families, name, &RayFamily::name)->rays;
}

std::vector<gpu::Ray> all_families(glm::ivec3 size, int count) {
    std::vector<gpu::Ray> rays;
    for (const RayFamily& family : ray_families(size, count, kMarchSeed))
        rays.insert(rays.end(), family.rays.begin(), family.rays.end());
    return rays;
}

std::vector<MarchWorld> all_structures(const VoxelWorld& world) {
    std::vector<MarchWorld> structures;
    for (const Traversal traversal : all_traversals())
        structures.push_back(build_march_world(world, traversal));
    return structures;
}

namespace {

// Only the steps, and the place where a ray was seen to miss, may depend on the structure. Steps are checked
// here; then all of them are cleared.
std::string clear_the_way(std::vector<gpu::MarchProbe>& probes, glm::ivec3 size,
                          const std::vector<gpu::Ray>& rays) {
    const auto most = static_cast<gpu::uint>(size.x + size.y + size.z + 3);
    for (std::size_t i = 0; i < probes.size(); ++i) {
        gpu::MarchHit& hit = probes[i].hit;
        if (hit.steps > most || hit.fault == gpu::kMarchExhausted)
            return fmt::format("{} steps of at most {}: {}", hit.steps, most, print(rays[i]));
        hit.steps = 0;
        if (hit.face != gpu::kFaceMiss) continue;
        hit.cell = glm::ivec3(0);
        hit.crossed = glm::ivec3(0);
        hit.t = 0.0f;
    }
    return "";
}

}  // namespace

std::string march_differences(const std::vector<MarchWorld>& structures, const std::vector<gpu::Ray>& rays,
                              std::vector<gpu::MarchProbe>& agreed) {
    agreed.clear();
    for (const MarchWorld& structure : structures) {
        std::vector<gpu::MarchProbe> got = march_on_device(structure, rays);
        const std::string too_many = clear_the_way(got, structure.size(), rays);
        if (!too_many.empty()) return fmt::format("'{}' takes {}", name_of(structure.traversal), too_many);
        if (&structure == &structures.front()) {
            agreed = std::move(got);
            continue;
        }
        const BitDifference found = differing_bits<gpu::MarchProbe>(got, agreed);
        if (found.count > 0)
            return fmt::format("'{}' and '{}' differ in {} rays, first {}: {}", name_of(structure.traversal),
                               name_of(structures.front().traversal), found.count, print(rays[found.first]),
                               found.detail);
    }
    return "";
}

std::vector<gpu::MarchProbe> march_everywhere(const std::vector<MarchWorld>& structures,
                                              const std::vector<gpu::Ray>& rays) {
    std::vector<gpu::MarchProbe> agreed;
    EXPECT_EQ(march_differences(structures, rays, agreed), "");
    return agreed;
}

std::vector<gpu::MarchProbe> march_everywhere(const VoxelWorld& world, const std::vector<gpu::Ray>& rays) {
    return march_everywhere(all_structures(world), rays);
}

namespace {

// The path of an axial ray does not depend on where in its cell it starts.
gpu::Ray centred_if_axial(gpu::Ray ray) {
    const glm::vec3 d = ray.direction;
    if ((d.x != 0.0f) + (d.y != 0.0f) + (d.z != 0.0f) == 1) ray.fraction = glm::vec3(0.5f);
    return ray;
}

}  // namespace

void expect_exact_walk(const VoxelWorld& world, const std::vector<gpu::Ray>& rays) {
    const auto got = march_everywhere(world, rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const ExactHit want = exact_walk(world, centred_if_axial(rays[i]));
        ASSERT_EQ(got[i].hit.face, want.face) << print(rays[i]);
        if (want.face == gpu::kFaceMiss) continue;
        ASSERT_EQ(got[i].hit.cell, want.cell) << print(rays[i]);
    }
}

std::string difference(const gpu::MarchHit& got, const gpu::MarchHit& want) {
    const auto text = [](const gpu::MarchHit& hit) {
        return fmt::format("face {} of ({}, {}, {}), material {}, at {} after ({}, {}, {}) planes", hit.face,
                           hit.cell.x, hit.cell.y, hit.cell.z, hit.material, hit.t, hit.crossed.x,
                           hit.crossed.y, hit.crossed.z);
    };
    const bool is_same_miss = got.face == gpu::kFaceMiss && want.face == gpu::kFaceMiss;
    const bool is_same_hit = got.face == want.face && got.cell == want.cell && got.t == want.t &&
                             got.material == want.material && got.crossed == want.crossed;
    if (is_same_miss || is_same_hit) return "";
    return fmt::format("got {}, want {}", text(got), text(want));
}

void expect_plain_walk(const VoxelWorld& world, const std::vector<gpu::Ray>& rays) {
    const auto got = march_everywhere(world, rays);
    for (std::size_t i = 0; i < rays.size(); ++i)
        ASSERT_EQ(difference(got[i].hit, walk_cells(world, rays[i])), "") << print(rays[i]);
}

void expect_interval_walk(const VoxelWorld& world, const std::vector<gpu::Ray>& rays) {
    const auto got = march_everywhere(world, rays);
    for (std::size_t i = 0; i < rays.size(); ++i)
        ASSERT_EQ(disagreement(interval_walk(world, rays[i]), got[i].hit), "") << print(rays[i]);
}

void expect_boxes(const VoxelWorld& world, const std::vector<gpu::Ray>& rays) {
    const std::vector<glm::ivec3> solids = solid_cells(world);
    const auto got = march_everywhere(world, rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const OracleBounds bounds = oracle_bounds(solids, rays[i], kMarchMargin);
        ASSERT_EQ(disagreement(bounds, rays[i], got[i].hit, kMarchMargin), "") << print(rays[i]);
    }
}

}  // namespace voxilux::test

// The worlds, the rays and the checker of the benchmarks.

#include <gtest/gtest.h>

#include <set>

#include "jobs/bench/bench_rays.h"
#include "jobs/bench/bench_row.h"
#include "jobs/bench/ray_checker.h"
#include "shared/limits.h"
#include "support/march_oracle.h"
#include "support/ray_families.h"

namespace voxilux {
namespace {

constexpr glm::ivec2 kSize{64, 40};

struct Fixture {
    BenchScene scene = procedural_scene(64, 3);
    MarchWorld guide = build_march_world(scene.world);

    std::vector<gpu::Ray> rays(RayKind kind) const { return bench_rays(scene, guide, kind, kSize, 3); }
};

// All hits as the march finds them; rays start inside the world.
std::vector<gpu::BenchHit> march_all(const MarchWorld& guide, const std::vector<gpu::Ray>& rays) {
    std::vector<gpu::BenchHit> hits;
    for (const gpu::Ray& ray : rays) {
        const gpu::MarchHit hit = gpu::march(guide, ray, guide.chunks_size);
        hits.push_back({.cell = hit.cell, .face = hit.face, .t = hit.t, .steps = hit.steps});
    }
    return hits;
}

std::set<int> voxels_of(const VoxelWorld& world) {
    std::set<int> cells;
    world.for_each_voxel([&](glm::ivec3 c, std::uint16_t voxel) {
        cells.insert((((c.x * 64 + c.y) * 64 + c.z) << 8) + (voxel & 0xFF));
    });
    return cells;
}

TEST(BenchScene, same_seed_gives_the_same_world_and_another_another) {
    const std::set<int> voxels = voxels_of(procedural_scene(64, 3).world);
    EXPECT_EQ(voxels, voxels_of(procedural_scene(64, 3).world));
    EXPECT_NE(voxels, voxels_of(procedural_scene(64, 4).world));
}

TEST(BenchScene, world_has_many_materials_an_empty_border_and_mostly_air) {
    for (const int extent : {kMinExtent, 64, 256}) {
        const BenchScene scene = procedural_scene(extent, 0);
        EXPECT_EQ(scene.world.size(), glm::ivec3(extent));
        std::set<int> materials;
        scene.world.for_each_voxel([&](glm::ivec3 c, std::uint16_t voxel) {
            materials.insert(voxel);
            for (int a = 0; a < 3; ++a)
                ASSERT_TRUE(c[a] >= 1 && c[a] < extent - 1);
        });
        EXPECT_GE(materials.size(), 16u) << extent;
        const double share = static_cast<double>(scene.world.voxel_count()) / std::pow(extent, 3);
        EXPECT_LT(share, 0.5) << extent;
    }
}

// Surfaces grow with the square of the extent, not with its cube.
TEST(BenchScene, voxels_grow_as_a_surface) {
    const auto voxels = [](int extent) {
        return static_cast<double>(procedural_scene(extent, 0).world.voxel_count());
    };
    EXPECT_NEAR(voxels(512) / voxels(256), 4.0, 0.5);
}

TEST(BenchScene, picture_has_surfaces_and_sky) {
    const Fixture fixture;
    const double share = static_cast<double>(fixture.rays(RayKind::ao).size()) / (kSize.x * kSize.y);
    EXPECT_GT(share, 0.5);
    EXPECT_LT(share, 0.95);
}

TEST(BenchRays, primary_rays_come_in_tiles_whose_rows_alternate) {
    const Fixture fixture;
    const std::vector<gpu::Ray> rays = fixture.rays(RayKind::primary);
    ASSERT_EQ(rays.size(), 64u * 40u);
    // Rows of tiles 0 2 4 1 3 of the picture, whose directions go down.
    const auto height = [&](std::size_t ray) { return rays[ray].direction.z; };
    const std::size_t tile_row = 64 * 8;
    EXPECT_GT(height(0), height(tile_row));
    EXPECT_GT(height(3 * tile_row), height(tile_row));
    EXPECT_LT(height(3 * tile_row), height(0));
}

TEST(BenchRays, other_rays_leave_what_the_primary_rays_meet) {
    const Fixture fixture;
    const std::vector<gpu::Ray> bounded = fixture.rays(RayKind::ao);
    const std::vector<gpu::Ray> unbounded = fixture.rays(RayKind::unbounded);
    std::size_t hits = 0;
    for (const gpu::BenchHit& hit : march_all(fixture.guide, fixture.rays(RayKind::primary)))
        hits += hit.face != gpu::kFaceMiss ? 1 : 0;
    EXPECT_EQ(bounded.size(), hits);
    ASSERT_EQ(unbounded.size(), hits);
    for (std::size_t i = 0; i < hits; ++i) {
        EXPECT_EQ(fixture.scene.world.get(bounded[i].cell), VoxelWorld::kEmpty);
        EXPECT_EQ(bounded[i].t_max, 32.0f);
        EXPECT_EQ(unbounded[i].t_max, gpu::kUnbounded);
        EXPECT_EQ(bounded[i].direction, unbounded[i].direction);
    }
}

TEST(RayChecker, walk_stops_where_boxes_in_double_precision_stop_the_ray) {
    constexpr double kMargin = 1e-4;  // voxels; rays of fewer than 64 cells in floats
    int judged = 0;
    for (const test::NamedWorld& named : test::small_worlds(7)) {
        const std::vector<glm::ivec3> solids = test::solid_cells(named.world);
        if (solids.size() > 1000) continue;
        for (const test::RayFamily& family : test::ray_families(named.world.size(), 40, 7)) {
            for (const gpu::Ray& ray : family.rays) {
                const WalkedHit walked = walk_ray(named.world, ray);
                const gpu::MarchHit hit{.cell = walked.cell, .face = walked.face, .t = walked.t};
                const test::OracleBounds bounds = test::oracle_bounds(solids, ray, kMargin);
                EXPECT_EQ(test::disagreement(bounds, ray, hit, kMargin), "") << named.name << family.name;
                ++judged;
            }
        }
    }
    EXPECT_GT(judged, 1000);
}

TEST(RayChecker, march_has_no_mismatch_and_each_perturbed_hit_is_one) {
    const Fixture fixture;
    for (const RayKind kind : kRayKinds) {
        const std::vector<gpu::Ray> rays = fixture.rays(kind);
        const Verdicts verdicts = check_rays(fixture.scene.world, rays, ~std::uint64_t{0});
        EXPECT_EQ(verdicts.rays.size(), rays.size());
        const std::vector<gpu::BenchHit> hits = march_all(fixture.guide, rays);
        EXPECT_EQ(count_mismatches(verdicts, hits), 0u) << name_of(kind);
        for (std::size_t i = 0; i < hits.size(); i += 97) {
            const bool is_miss = hits[i].face == gpu::kFaceMiss;
            gpu::BenchHit other_cell = hits[i], other_face = hits[i], other_outcome = hits[i];
            other_cell.cell.y += 1;
            other_face.face ^= 1u;
            other_outcome.face = is_miss ? 0u : gpu::kFaceMiss;
            for (const gpu::BenchHit& wrong : {other_cell, other_face, other_outcome}) {
                std::vector<gpu::BenchHit> perturbed = hits;
                perturbed[i] = wrong;
                const bool is_same = is_miss && wrong.face == gpu::kFaceMiss;  // misses have no cell
                EXPECT_EQ(count_mismatches(verdicts, perturbed), is_same ? 0u : 1u);
            }
        }
    }
}

TEST(RayChecker, few_cells_judge_a_spread_share_of_the_rays) {
    const Fixture fixture;
    const std::vector<gpu::Ray> rays = fixture.rays(RayKind::primary);
    const Verdicts verdicts = check_rays(fixture.scene.world, rays, 2000);
    const std::set<std::size_t> judged(verdicts.rays.begin(), verdicts.rays.end());
    EXPECT_EQ(judged.size(), verdicts.rays.size());
    ASSERT_GE(judged.size(), 10u);
    ASSERT_LT(judged.size(), rays.size() / 2);
    std::size_t widest = 0, last = 0;
    for (const std::size_t ray : judged) {
        widest = std::max(widest, ray - last);
        last = ray;
    }
    EXPECT_LT(widest, 4 * rays.size() / judged.size());
}

BenchRow row(const std::string& traversal, const std::string& rays, double rate) {
    return {.scene = "made up",
            .extent = 64,
            .traversal = traversal,
            .rays = rays,
            .count = 1000,
            .mrays_per_cpu_s = rate,
            .mrays_per_s = rate};
}

TEST(BenchRows, table_ends_with_the_geometric_mean_over_the_baseline) {
    const std::vector<BenchRow> rows = {row(kBaseline, "primary", 3.0), row(kBaseline, "ao", 5.0),
                                        row("other", "primary", 6.0), row("other", "ao", 40.0)};
    const std::string table = describe(rows);
    EXPECT_NE(table.find("    1.00\n"), std::string::npos) << table;
    EXPECT_NE(table.find("    4.00\n"), std::string::npos) << table;
}

TEST(BenchRows, mismatches_and_what_does_not_fit_have_lines_of_their_own) {
    BenchRow wrong = row("wrong", "ao", 1.0);
    wrong.checked = 500;
    wrong.mismatches = 2;
    BenchRow large = row("large", "ao", 0.0);
    large.reason = "its roots take 4096 MiB, the device allocates 2048 MiB at once";
    const std::string table = describe(std::vector<BenchRow>{wrong, large});
    EXPECT_NE(table.find("wrong ao: 2 of 500 rays meet another voxel"), std::string::npos) << table;
    EXPECT_NE(table.find("does not fit: its roots take 4096 MiB"), std::string::npos) << table;
    EXPECT_EQ(to_json(large)["fits"], false);
    EXPECT_EQ(to_json(large)["reason"], large.reason);
    EXPECT_FALSE(to_json(large).contains("mrays_per_cpu_s"));
    EXPECT_EQ(to_json(wrong)["fits"], true);
}

}  // namespace
}  // namespace voxilux

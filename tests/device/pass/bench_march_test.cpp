#include <gtest/gtest.h>

#include "jobs/bench/march_bench.h"
#include "support/device_fixture.h"

namespace voxilux {
namespace {

MarchBenchOptions small_bench(std::vector<Traversal> traversals) {
    return {.traversals = std::move(traversals),
            .builder = Builder::both,
            .size = {32, 18},
            .rounds = 1,
            .seed = 1};
}

TEST(BenchMarch, every_structure_meets_what_the_plain_walk_meets) {
    const BenchScene scene = procedural_scene(kMinExtent, 1);
    const MarchBenchOptions options = small_bench({all_traversals().begin(), all_traversals().end()});
    const std::vector<BenchRow> rows = bench_march(scene, options, test_device());
    ASSERT_EQ(rows.size(), all_traversals().size() * kRayKinds.size());
    for (const BenchRow& row : rows) {
        EXPECT_EQ(row.reason, "");
        EXPECT_EQ(row.mismatches, 0u) << row.traversal << " " << row.rays;
        EXPECT_EQ(row.checked, row.count);
        EXPECT_GT(row.mrays_per_cpu_s, 0.0);
        EXPECT_GT(row.mrays_per_s, 0.0);
        EXPECT_GE(row.steps, 1.0);
        EXPECT_EQ(row.memory_bytes,
                  bytes_of(build_march_world(scene.world, traversal_named(row.traversal))).total());
        EXPECT_TRUE(row.build_s && row.device_build_s);
    }
}

// Five by three tiles, whose rows come in the order 0, 2, 1: a start taken for another tile's rays would be
// seen.
TEST(BenchMarch, camera_rays_that_start_where_beams_end_meet_the_same_in_fewer_steps) {
    const BenchScene scene = procedural_scene(64, 1);
    MarchBenchOptions options = small_bench({Traversal::naadf, Traversal::deep, Traversal::wide});
    options.size = {40, 24};
    options.kinds = {RayKind::primary};
    options.has_beams = true;
    const std::vector<BenchRow> rows = bench_march(scene, options, test_device());
    ASSERT_EQ(rows.size(), 5u);
    for (const std::size_t plain : {1u, 3u}) {
        EXPECT_EQ(rows[plain + 1].traversal, rows[plain].traversal + ".beams");
        EXPECT_EQ(rows[plain + 1].mismatches, 0u);
        EXPECT_LT(rows[plain + 1].steps, 0.95 * rows[plain].steps);
    }
    options.size = {36, 24};  // tiles that are cut off have no beams
    EXPECT_EQ(bench_march(scene, options, test_device()).size(), 3u);
}

TEST(BenchMarch, camera_that_sees_no_voxel_leaves_rows_without_rays) {
    BenchScene scene = procedural_scene(kMinExtent, 1);
    scene.camera.pitch_deg = 90.0;
    scene.camera.position.z = 1000.0;
    const std::vector<BenchRow> rows = bench_march(scene, small_bench({Traversal::naadf}), test_device());
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_EQ(rows[0].count, 32u * 18u);
    EXPECT_EQ(rows[0].mismatches, 0u);
    EXPECT_EQ(rows[1].count, 0u);
    EXPECT_EQ(rows[2].count, 0u);
}

}  // namespace
}  // namespace voxilux

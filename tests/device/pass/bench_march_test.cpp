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

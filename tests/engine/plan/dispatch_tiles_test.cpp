#include <gtest/gtest.h>

#include <vector>

#include "renderer/dispatch_tiles.h"

namespace voxilux {
namespace {

struct Rows {
    std::uint32_t height = 0;
    std::uint32_t film_tile_rows = 0;
};

RenderPlan plan_for(std::uint32_t width, Rows rows, std::uint32_t ao_rays = 1) {
    RenderPlan plan;
    plan.settings.size = {static_cast<int>(width), static_cast<int>(rows.height)};
    plan.settings.ao_rays = ao_rays;
    plan.effects[static_cast<std::size_t>(Effect::ao)].on = true;
    plan.film_tile_rows = rows.film_tile_rows;
    plan.tile_rows = rows.film_tile_rows;
    plan.film_tile_count = (rows.height + rows.film_tile_rows - 1) / rows.film_tile_rows;
    return plan;
}

// A device whose dispatches last `ms_of(row)` for each row.
template <class Cost>
std::vector<DispatchTile> run_pass(TileGovernor& governor, const RenderPlan& plan, const Cost& ms_of,
                                   double* longest = nullptr) {
    const auto height = static_cast<std::uint32_t>(plan.settings.size.y);
    std::vector<DispatchTile> tiles;
    for (std::uint32_t next = 0; next < height; next += tiles.back().row_count) {
        tiles.push_back(governor.tile_at(next));
        double max_ms = 0.0;
        for (std::uint32_t row = 0; row < tiles.back().row_count; ++row)
            max_ms += ms_of(next + row);
        governor.adapt(tiles.back().row_count, max_ms);
        if (longest != nullptr) *longest = std::max(*longest, max_ms);
    }
    return tiles;
}

void expect_cover(const std::vector<DispatchTile>& tiles, const RenderPlan& plan) {
    std::uint32_t next = 0;
    for (const DispatchTile& tile : tiles) {
        EXPECT_EQ(tile.first_row, next) << "rows are rendered in order, each once";
        EXPECT_GE(tile.row_count, 1u);
        EXPECT_LE(tile.row_count, plan.tile_rows);
        EXPECT_EQ(tile.film_tile_first_row, tile.film_tile * plan.film_tile_rows);
        EXPECT_GE(tile.first_row, tile.film_tile_first_row);
        EXPECT_LE(tile.first_row + tile.row_count, tile.film_tile_first_row + plan.film_tile_rows)
            << "crosses a film tile";
        next = tile.first_row + tile.row_count;
    }
    EXPECT_EQ(next, static_cast<std::uint32_t>(plan.settings.size.y));
}

TEST(TileGovernor, every_row_is_covered_once_whatever_it_costs) {
    const std::vector<double> costs = {0.0, 1e-6, 0.01, 1.0, 30.0, 1e4};
    for (const Rows rows : {Rows{1, 1}, {7, 8}, {360, 360}, {1000, 816}, {8192, 64}, {100, 1}}) {
        const RenderPlan plan = plan_for(1280, rows);
        for (const double cost : costs) {
            TileGovernor governor(plan, false);
            for (int pass = 0; pass < 3; ++pass)
                expect_cover(run_pass(governor, plan, [&](std::uint32_t) { return cost; }), plan);
        }
    }
}

TEST(TileGovernor, uniform_rows_never_exceed_the_target_after_the_first_slice) {
    const RenderPlan plan = plan_for(1280, {2000, 816});
    for (const bool is_cpu : {false, true}) {
        for (const double cost : {0.001, 0.1, 0.7, 3.0, 50.0}) {
            TileGovernor governor(plan, is_cpu);
            run_pass(governor, plan, [&](std::uint32_t) { return cost; });
            double longest = 0.0;
            run_pass(
                governor, plan, [&](std::uint32_t) { return cost; }, &longest);
            EXPECT_LE(longest, std::max(governor.target_ms(), cost)) << cost << " ms a row";
        }
    }
}

// Rows that cost up to twice as much as those before stay below the 250 ms that a GPU is given.
TEST(TileGovernor, rows_that_double_their_cost_stay_below_250_ms) {
    const RenderPlan plan = plan_for(1280, {800, 816});
    TileGovernor governor(plan, false);
    const auto cost = [](std::uint32_t row) { return row < 400 ? 1.0 : 2.0; };
    run_pass(governor, plan, [](std::uint32_t) { return 1.0; });
    double longest = 0.0;
    run_pass(governor, plan, cost, &longest);
    EXPECT_LE(longest, 250.0);
    EXPECT_GT(longest, governor.target_ms()) << "the jump must be visible, or this tests nothing";
}

TEST(TileGovernor, tiles_grow_on_a_fast_device_and_shrink_on_a_slow_one) {
    const RenderPlan plan = plan_for(1280, {816, 816}, 64);
    TileGovernor fast(plan, false);
    TileGovernor slow(plan, false);
    const std::uint32_t first = fast.rows();
    run_pass(fast, plan, [](std::uint32_t) { return 0.01; });
    run_pass(slow, plan, [](std::uint32_t) { return 60.0; });
    EXPECT_GT(fast.rows(), first);
    EXPECT_EQ(fast.rows(), plan.tile_rows) << "8 ms for the whole picture: one dispatch tile";
    EXPECT_LT(slow.rows(), first);
    EXPECT_EQ(slow.rows(), 2u) << "two rows of 60 ms are the most that 125 ms hold";
}

TEST(TileGovernor, tiles_grow_fourfold_at_most) {
    const RenderPlan plan = plan_for(1280, {816, 816}, 256);
    TileGovernor governor(plan, false);
    const std::uint32_t first = governor.rows();
    const std::vector<DispatchTile> tiles = run_pass(governor, plan, [](std::uint32_t) { return 1e-6; });
    ASSERT_GE(tiles.size(), 2u);
    EXPECT_LE(tiles[1].row_count, 4 * first);
    EXPECT_GT(tiles[1].row_count, first);
}

TEST(TileGovernor, device_without_timers_keeps_the_first_size) {
    const RenderPlan plan = plan_for(1280, {816, 816}, 64);
    TileGovernor governor(plan, false);
    const std::uint32_t first = governor.rows();
    run_pass(governor, plan, [](std::uint32_t) { return 0.0; });
    EXPECT_EQ(governor.rows(), first);
}

TEST(TileGovernor, more_rays_give_smaller_first_slices) {
    EXPECT_GT(TileGovernor(plan_for(1280, {816, 816}, 1), true).rows(),
              TileGovernor(plan_for(1280, {816, 816}, 256), true).rows());
    EXPECT_EQ(TileGovernor(plan_for(100000, {8, 8}, 4096), true).rows(), 1u);
}

TEST(TileGovernor, fewer_rows_may_be_asked_for) {
    const TileGovernor governor(plan_for(1280, {800, 80}), true);
    EXPECT_EQ(governor.tile_at(70).row_count, 10u) << "to the end of the film tile";
    EXPECT_EQ(governor.tile_at(0, 3).row_count, 3u);
    EXPECT_EQ(governor.tile_at(0, 0).row_count, 1u);
    EXPECT_EQ(governor.tile_at(0, 1000).row_count, std::min(governor.rows(), 80u));
    RenderPlan photons = plan_for(1280, {800, 800});
    photons.effects[static_cast<std::size_t>(Effect::caustics)] = {Effect::caustics, true};
    photons.techniques = choose_techniques(photons.effects, photons.ao, photons.settings, false);
    EXPECT_EQ(TileGovernor(photons, true).tile_at(0, 3).row_count, 800u);
}

}  // namespace
}  // namespace voxilux

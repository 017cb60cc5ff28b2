// The table of occlusion cells on the device: all samples are accounted for, each pixel has the slot of its
// cell, and the sums of a cell are those of its samples.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "support/ao_fixture.h"

namespace voxilux {
namespace {

using test::AoFixture;
using test::AoFrame;
using test::CellSums;

// Sums over the frames of a run.
struct Ledger {
    std::uint64_t traced = 0;
    std::uint64_t dropped = 0;
    std::uint64_t own = 0;
    std::uint64_t claimed = 0;
    std::uint64_t evicted = 0;
    std::uint64_t full = 0;

    void add(const AoFrame& frame) {
        traced += frame.counters[gpu::kWorkAoRays];
        dropped += frame.counters[gpu::kWorkAoDropped];
        own += frame.counters[gpu::kWorkAoOwnRays];
        claimed += frame.counters[gpu::kWorkAoClaimed];
        evicted += frame.counters[gpu::kWorkAoEvicted];
        full += frame.counters[gpu::kFaultAoTableFull];
    }
};

std::uint64_t samples_in(const CellSums& sums) {
    std::uint64_t total = 0;
    for (const auto& [key, sum] : sums)
        total += sum.first;
    return total;
}

// What is wrong with the sums after a frame, or an empty text.
std::string imbalance(const Ledger& ledger, const AoFrame& frame) {
    const CellSums sums = test::sums_of(frame);
    if (samples_in(sums) + ledger.dropped + ledger.own != ledger.traced) return "samples";
    if (sums.size() != ledger.claimed - ledger.evicted) return "cells";
    for (std::size_t slot = 0; slot < frame.keys.size(); ++slot) {
        if (frame.keys[slot] == 0 && (frame.samples[slot] != 0 || frame.opens[slot] != 0))
            return "a slot without a cell";
        if (frame.opens[slot] > frame.samples[slot]) return "more open samples than samples";
        if (frame.keys[slot] != 0 && frame.samples[slot] == 0) return "a cell without samples";
    }
    return "";
}

// Counts pixels on faces whose slot is not that of their cell, and pixels without a slot.
struct Slots {
    std::string wrong;
    std::uint64_t none = 0;
    std::uint64_t hits = 0;
};

Slots slots_of(const AoFixture& fixture, const AoFrame& frame) {
    Slots slots;
    for (std::size_t i = 0; i < frame.hits.size(); ++i) {
        if (frame.hits[i].face >= gpu::kFaceInside) continue;
        ++slots.hits;
        const auto slot = frame.slot_of(i);
        if (!slot) {
            ++slots.none;
        } else {
            const std::string wrong =
                test::key_disagreement(fixture, frame, frame.hits[i], frame.keys[*slot]);
            if (!wrong.empty()) slots.wrong = wrong;
        }
    }
    return slots;
}

struct Run {
    std::uint32_t slots;
    int frames;
    int stride;  // steps of the camera's path in a frame
    float cell_px = 1.5f;
};

Ledger fly(const Run& run) {
    Scene scene = test::pillared_scene();
    scene.settings.ao.slots = run.slots;
    scene.settings.ao.cell_px = run.cell_px;
    AoFixture fixture(scene);
    Ledger ledger;
    for (int i = 0; i < run.frames; ++i) {
        const AoFrame frame = fixture.render(test::flying_camera(run.stride * i));
        ledger.add(frame);
        EXPECT_EQ(imbalance(ledger, frame), "") << "frame " << i;
        const Slots slots = slots_of(fixture, frame);
        EXPECT_EQ(slots.wrong, "") << "frame " << i;
        EXPECT_EQ(slots.none, frame.counters[gpu::kFaultAoTableFull]) << "frame " << i;
        EXPECT_EQ(frame.counters[gpu::kWorkAoOwnRays], slots.none * scene.settings.ao_rays);
        EXPECT_EQ(frame.counters[gpu::kWorkAoRays], slots.hits * scene.settings.ao_rays);
        EXPECT_EQ(frame.counters[gpu::kWorkAoReused] + frame.counters[gpu::kWorkAoSearches], slots.hits);
        if (testing::Test::HasFailure()) break;
    }
    return ledger;
}

TEST(AoCells, books_balance_over_300_frames_of_a_flight) {
    const Ledger ledger = fly({.slots = 0, .frames = 300, .stride = 1, .cell_px = 3.0f});
    EXPECT_EQ(ledger.own, 0u);
    EXPECT_GT(ledger.evicted, 1000u);
}

TEST(HardCase, hole03_books_balance_in_a_table_of_256_cells) {
    const Ledger ledger = fly({.slots = 256, .frames = 300, .stride = 3});
    EXPECT_GT(ledger.own, 10000u);
    EXPECT_GT(ledger.evicted, 500u);
}

TEST(HardCase, hole03_books_balance_in_a_table_of_16_cells) {
    const Ledger ledger = fly({.slots = 16, .frames = 300, .stride = 3});
    EXPECT_GT(ledger.own, 100000u);
    EXPECT_GT(ledger.evicted, 50u);
}

TEST(AoCells, comparison_rejects_a_lost_a_stray_and_a_doubled_sample) {
    AoFixture fixture(test::pillared_scene());
    const AoFrame frame = fixture.render();
    Ledger ledger;
    ledger.add(frame);
    EXPECT_EQ(imbalance(ledger, frame), "");
    const auto live = static_cast<std::size_t>(
        std::ranges::find_if(frame.keys, [](std::uint64_t key) { return key != 0; }) - frame.keys.begin());
    const auto empty = static_cast<std::size_t>(std::ranges::find(frame.keys, 0u) - frame.keys.begin());
    AoFrame lost = frame;
    --lost.samples[live];
    EXPECT_EQ(imbalance(ledger, lost), "samples");
    AoFrame stray = frame;
    ++stray.samples[empty];
    EXPECT_EQ(imbalance(ledger, stray), "a slot without a cell");
    ++ledger.claimed;
    EXPECT_EQ(imbalance(ledger, frame), "cells");
    AoFrame other = frame;
    std::ranges::rotate(other.slots, other.slots.begin() + 32);
    EXPECT_NE(slots_of(fixture, other).wrong, "");
}

// The cells' sums and the pictures of a flight of few frames, so that no cell is given up.
struct Flight {
    CellSums sums;
    std::vector<std::vector<float>> pictures;

    bool operator==(const Flight&) const = default;
};

std::size_t levels_of(const CellSums& sums) {
    std::set<std::uint32_t> levels;
    for (const auto& [key, sum] : sums)
        levels.insert(test::cell_of_key(key).value().level);
    return levels.size();
}

Flight short_flight(const Scene& scene, Executor& executor = test_executor()) {
    AoFixture fixture(scene, executor);
    Flight flight;
    for (int i = 0; i < 20; ++i) {
        const AoFrame frame = fixture.render(test::flying_camera(i), static_cast<std::uint32_t>(i % 3));
        flight.pictures.push_back(frame.visibility);
        flight.sums = test::sums_of(frame);
    }
    return flight;
}

TEST(AoCells, reprojection_and_merging_change_no_sum_and_no_pixel) {
    const Flight plain = short_flight(test::pillared_scene());
    ASSERT_GT(plain.sums.size(), 1000u);
    EXPECT_GE(levels_of(plain.sums), 2u);
    for (const bool reproject : {false, true}) {
        for (const bool merged : {false, true}) {
            Scene scene = test::pillared_scene();
            scene.settings.ao.reproject = reproject;
            scene.settings.ao.merged = merged;
            EXPECT_TRUE(short_flight(scene) == plain) << "reproject " << reproject << ", merged " << merged;
        }
    }
}

TEST(AoCells, size_of_the_table_and_of_workgroups_changes_no_sum_and_no_pixel) {
    const Flight plain = short_flight(test::pillared_scene());
    Scene scene = test::pillared_scene();
    scene.settings.ao.slots = 1u << 16;
    EXPECT_TRUE(short_flight(scene) == plain);
    for (const std::array<std::uint32_t, 2> group : {std::array{1u, 1u}, std::array{16u, 4u}}) {
        ExecutorOptions options;
        options.group_size = group;
        options.poison_transients = true;
        Executor executor(test_device(), all_shaders(), options);
        EXPECT_TRUE(short_flight(test::pillared_scene(), executor) == plain) << group[0] << "x" << group[1];
    }
}

TEST(AoCells, comparison_rejects_another_seed_and_another_cell_size) {
    const Flight plain = short_flight(test::pillared_scene());
    Scene scene = test::pillared_scene();
    scene.settings.seed = 2;
    EXPECT_FALSE(short_flight(scene) == plain);
    scene = test::pillared_scene();
    scene.settings.ao.cell_px = 10.0f;
    EXPECT_FALSE(short_flight(scene).sums == plain.sums);
}

// Cells whose unoccluded samples are not those that a march in C++ finds for the same sample numbers.
int differing_cells(const AoFixture& fixture, const AoFrame& frame, std::uint64_t first_number) {
    int differing = 0;
    for (const auto& [key, sum] : test::sums_of(frame))
        differing +=
            test::open_samples(fixture, key, first_number, first_number + sum.first) != sum.second ? 1 : 0;
    return differing;
}

TEST(AoCells, sums_are_those_of_the_cell_s_own_samples_marched_in_cpp) {
    for (const Sequence sequence : {Sequence::sobol, Sequence::halton, Sequence::white}) {
        Scene scene = test::pillared_scene();
        scene.settings.sequence = sequence;
        AoFixture fixture(scene);
        AoFrame frame;
        for (int i = 0; i < 6; ++i)
            frame = fixture.render(test::flying_camera(i));
        EXPECT_EQ(differing_cells(fixture, frame, 0), 0);
        EXPECT_GT(differing_cells(fixture, frame, 1), 20) << "samples of other numbers give other sums";
    }
}

TEST(AoCells, visibility_of_a_pixel_is_the_open_share_of_its_cell) {
    AoFixture fixture(test::pillared_scene());
    for (int i = 0; i < 4; ++i) {
        const AoFrame frame = fixture.render(test::flying_camera(5 * i));
        for (std::size_t pixel = 0; pixel < frame.hits.size(); ++pixel) {
            const auto slot = frame.slot_of(pixel);
            const float expected =
                slot ? static_cast<float>(frame.opens[*slot]) / static_cast<float>(frame.samples[*slot])
                     : 1.0f;
            ASSERT_FLOAT_EQ(frame.visibility[pixel], expected);
        }
    }
}

TEST(AoCells, sphere_keeps_its_own_rays) {
    Scene scene = test::pillared_scene();
    scene.spheres.push_back({glm::dvec3(0.0, 0.0, 2.5), 3.0, 0});
    AoFixture fixture(scene);
    Ledger ledger;
    for (int i = 0; i < 5; ++i) {
        const AoFrame frame = fixture.render(test::flying_camera(i));
        ledger.add(frame);
        EXPECT_EQ(imbalance(ledger, frame), "");
        const auto on_sphere = static_cast<std::size_t>(
            std::ranges::count(frame.hits, gpu::kFaceSphere, [](const gpu::Hit& hit) { return hit.face; }));
        EXPECT_GT(on_sphere, 30u);
        EXPECT_EQ(frame.counters[gpu::kWorkAoOwnRays], on_sphere * scene.settings.ao_rays);
        EXPECT_EQ(frame.counters[gpu::kFaultAoTableFull], 0u);
    }
}

}  // namespace
}  // namespace voxilux

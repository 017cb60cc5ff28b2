// Cells over many frames: all samples are accounted for, and cells are given up in time.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "support/cell_table_model.h"

namespace voxilux {
namespace {

using gpu::FoundSlot;
using gpu::kNoSlot;
using test::CellTable;
using test::TestRandom;
using IsDue = bool (*)(gpu::uvec2 key, std::uint32_t touched, std::uint32_t frame);

// The cells of a run of frames as the passes keep them.
class Ledger {
  public:
    Ledger(std::size_t slots, std::uint32_t first_frame, IsDue is_due = gpu::needs_touch,
           std::uint32_t max_age = gpu::kCellMaxAge)
        : frame(first_frame),
          table_(slots),
          samples_(slots, 0),
          touched_(slots, 0),
          is_due_(is_due),
          max_age_(max_age) {}

    // One frame in which every key is seen and takes some samples.
    void run_frame(const std::vector<std::uint64_t>& keys, std::uint32_t each) {
        sweep();
        table_.begin_pass();
        for (const std::uint64_t key : keys)
            take(key, each);
        ++frame;
    }

    // Samples that the counts of the slots lack or have in excess, slot by slot.
    [[nodiscard]] std::uint64_t misplaced() const {
        std::uint64_t sum = 0;
        for (std::size_t slot = 0; slot < samples_.size(); ++slot) {
            const auto found = expected_.find(table_.keys[slot]);
            const std::uint64_t expected = found == expected_.end() ? 0 : found->second;
            sum += std::max(expected, samples_[slot]) - std::min(expected, samples_[slot]);
        }
        return sum;
    }
    [[nodiscard]] std::uint64_t in_cells() const {
        return std::accumulate(samples_.begin(), samples_.end(), std::uint64_t{0});
    }

    // Moves a sample from one cell to another.
    void misplace_a_sample() {
        const auto taken_from = std::ranges::find_if(samples_, [](std::uint64_t count) { return count > 0; });
        --*taken_from;
        ++*std::find_if(taken_from + 1, samples_.end(), [](std::uint64_t count) { return count > 0; });
    }

    std::uint32_t frame;
    std::uint64_t taken = 0;
    std::uint64_t dropped = 0;
    std::uint64_t own = 0;
    int evicted = 0;

  private:
    // Sweeps the whole table: in every eighth frame, or in each when cells are given up sooner.
    void sweep() {
        if (frame % 8 != 0 && max_age_ == gpu::kCellMaxAge) return;
        for (std::size_t slot = 0; slot < samples_.size(); ++slot) {
            if (table_.keys[slot] == 0 || !gpu::is_stale(touched_[slot], frame, max_age_)) continue;
            dropped += samples_[slot];
            ++evicted;
            expected_.erase(table_.keys[slot]);
            table_.keys[slot] = 0;
            samples_[slot] = 0;
        }
    }

    void take(std::uint64_t bits, std::uint32_t count) {
        const gpu::uvec2 key = test::key_words(bits);
        const FoundSlot found = gpu::find_or_claim(table_, key, table_.mask(), gpu::kNoSlot);
        taken += count;
        if (found.slot == kNoSlot) {
            own += count;
            return;
        }
        if (found.claimed || is_due_(key, touched_[found.slot], frame)) touched_[found.slot] = frame;
        samples_[found.slot] += count;
        expected_[bits] += count;
    }

    CellTable table_;
    std::vector<std::uint64_t> samples_;
    std::vector<std::uint32_t> touched_;
    std::map<std::uint64_t, std::uint64_t> expected_;  // of each key since it was entered
    IsDue is_due_;
    std::uint32_t max_age_;
};

std::uint64_t key_number(std::uint64_t i) {
    return TestRandom(i).bits64() | 0x8000000080000000u;
}

// The keys in the view of a passing camera: in each frame 3 new ones come and 3 old ones go.
std::vector<std::uint64_t> keys_in_view(std::uint64_t frame) {
    std::vector<std::uint64_t> keys;
    for (std::uint64_t i = 0; i < 60; ++i)
        keys.push_back(key_number((3 * frame + i) % 700));
    return keys;
}

TEST(CellLedger, samples_in_cells_and_given_up_and_own_are_all_that_were_taken) {
    for (const std::size_t slots : {1u, 2u, 16u, 64u, 256u, 4096u}) {
        for (const std::uint32_t first : {0u, 0xFFFFFF80u}) {
            Ledger ledger(slots, first);
            for (std::uint64_t i = 0; i < 300; ++i) {
                ledger.run_frame(keys_in_view(i), 1 + static_cast<std::uint32_t>(i % 5));
                ASSERT_EQ(ledger.in_cells() + ledger.dropped + ledger.own, ledger.taken) << slots << " " << i;
                ASSERT_EQ(ledger.misplaced(), 0u) << slots << " " << i;
            }
            EXPECT_GT(ledger.evicted, slots == 1 ? 3 : 10) << slots;
            EXPECT_EQ(ledger.own > 0, slots < 200) << slots;
        }
    }
}

TEST(CellLedger, comparison_rejects_a_sample_in_another_cell) {
    Ledger ledger(64, 0);
    ledger.run_frame({key_number(1), key_number(2)}, 3);
    EXPECT_EQ(ledger.misplaced(), 0u);
    ledger.misplace_a_sample();
    EXPECT_EQ(ledger.in_cells(), ledger.taken) << "the sum alone does not tell";
    EXPECT_EQ(ledger.misplaced(), 2u);
}

// How many of the keys were given up although they were seen in every frame.
int evicted_in_sight(std::uint32_t first_frame, IsDue is_due, std::uint32_t max_age = gpu::kCellMaxAge) {
    Ledger ledger(4096, first_frame, is_due, max_age);
    std::vector<std::uint64_t> keys;
    for (std::uint64_t i = 0; i < 500; ++i)
        keys.push_back(key_number(i));
    for (int i = 0; i < 200; ++i)
        ledger.run_frame(keys, 1);
    return ledger.evicted;
}

TEST(HardCase, hole16_cell_in_sight_is_never_given_up) {
    EXPECT_EQ(evicted_in_sight(0, gpu::needs_touch), 0);
    EXPECT_EQ(evicted_in_sight(0xFFFFFFF0u, gpu::needs_touch), 0) << "frame numbers wrap";
    EXPECT_EQ(evicted_in_sight(0, gpu::needs_touch, gpu::kCellMinAge), 0) << "the table fills up";
}

TEST(HardCase, hole16_comparison_rejects_touches_rarer_than_the_greatest_age) {
    const IsDue rare = [](gpu::uvec2 key, std::uint32_t, std::uint32_t frame) {
        return ((gpu::hash4(key.x, key.y, 1u, 0u) ^ frame) & 63u) == 0u;
    };
    EXPECT_GT(evicted_in_sight(0, rare), 100);
}

// How many cells were given up in sight after all of them had been out of sight for some frames.
int evicted_after_return(IsDue is_due, std::uint32_t max_age = gpu::kCellMaxAge) {
    std::vector<std::uint64_t> keys;
    for (std::uint64_t i = 0; i < 300; ++i)
        keys.push_back(key_number(i));
    int evicted = 0;
    for (int away = 4; away < 48; ++away) {
        Ledger ledger(4096, 0xFFFFFFF0u, is_due, max_age);
        ledger.run_frame(keys, 1);
        for (int i = 0; i < away; ++i)
            ledger.run_frame({}, 1);
        ledger.run_frame(keys, 1);
        const int before = ledger.evicted;
        for (int i = 0; i < 16; ++i)
            ledger.run_frame(keys, 1);
        evicted += ledger.evicted - before;
    }
    return evicted;
}

TEST(HardCase, hole16_cell_that_comes_back_into_sight_is_not_given_up_in_it) {
    EXPECT_EQ(evicted_after_return(gpu::needs_touch), 0);
    EXPECT_EQ(evicted_after_return(gpu::needs_touch, gpu::kCellMinAge), 0) << "the table fills up";
}

TEST(HardCase, hole16_comparison_rejects_touches_in_turn_alone) {
    EXPECT_GT(evicted_after_return([](gpu::uvec2 key, std::uint32_t, std::uint32_t frame) {
                  return gpu::is_touch_due(key, frame);
              }),
              100);
}

TEST(CellAge, touch_of_every_key_is_due_once_in_its_period) {
    TestRandom random(8);
    std::map<std::uint32_t, int> turns;
    for (int i = 0; i < 8000; ++i) {
        const gpu::uvec2 key = test::key_words(key_number(random.bits64()));
        const std::uint32_t first = i % 2 == 0 ? random.bits32() : 0xFFFFFFFCu;  // wraps inside
        std::uint32_t due = 0;
        for (std::uint32_t n = 0; n < gpu::kCellTouchPeriod; ++n) {
            if (!gpu::is_touch_due(key, first + n)) continue;
            ++due;
            if (i % 2 == 1) ++turns[n];
        }
        ASSERT_EQ(due, 1u);
    }
    for (const auto& [turn, count] : turns)
        EXPECT_NEAR(count, 500, 110) << "5 standard deviations: keys take turns evenly, turn " << turn;
}

TEST(CellAge, age_counts_across_the_wrap_of_frame_numbers) {
    for (const std::uint32_t touched : {0u, 1000u, 0xFFFFFFFFu, 0xFFFFFFE0u, 0x7FFFFFFFu, 0x80000000u}) {
        EXPECT_FALSE(gpu::is_stale(touched, touched, gpu::kCellMaxAge));
        EXPECT_FALSE(gpu::is_stale(touched, touched + gpu::kCellMaxAge, gpu::kCellMaxAge));
        EXPECT_TRUE(gpu::is_stale(touched, touched + gpu::kCellMaxAge + 1, gpu::kCellMaxAge));
        EXPECT_TRUE(gpu::is_stale(touched, touched + 0x80000000u, gpu::kCellMaxAge));
    }
}

}  // namespace
}  // namespace voxilux

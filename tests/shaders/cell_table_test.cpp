// The hash table of cells: which search finds which slot when many search and claim at once.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <thread>

#include "support/cell_table_model.h"

namespace voxilux {
namespace {

using gpu::FoundSlot;
using gpu::kNoSlot;
using test::CellTable;
using test::TestRandom;
using Keys = std::vector<std::uint64_t>;
using Search = FoundSlot (*)(CellTable&, gpu::uvec2 key, std::uint32_t mask);

// As ao_cell_key() makes them: both words have their top bit.
std::uint64_t random_key(TestRandom& random) {
    return random.bits64() | 0x8000000080000000u;
}

Keys random_keys(TestRandom& random, std::size_t count) {
    Keys keys(count);
    for (std::uint64_t& key : keys)
        key = random_key(random);
    return keys;
}

// Keys whose search starts at one slot.
Keys colliding_keys(TestRandom& random, std::size_t count, std::uint32_t mask) {
    Keys keys;
    while (keys.size() < count) {
        const std::uint64_t key = random_key(random);
        if (gpu::home_slot(test::key_words(key), mask) == (0x5A5A5A5Au & mask)) keys.push_back(key);
    }
    return keys;
}

// The search without a guess.
FoundSlot find_or_claim(CellTable& table, glm::uvec2 key, gpu::uint mask) {
    return gpu::find_or_claim(table, key, mask, gpu::kNoSlot);
}

struct Searched {
    std::uint64_t key = 0;
    FoundSlot found{};
};
using Searches = std::vector<Searched>;

struct Faults {
    int duplicates = 0;  // live slots of one key beyond the first
    int wrong = 0;       // searches that ended in a slot of another key
    int refused = 0;     // searches that fail although a slot is free or has the key
    int probes = 0;      // searches that probed too many slots
    int claims = 0;      // difference between entries and filled slots

    [[nodiscard]] int all() const { return duplicates + wrong + refused + probes + claims; }
};

std::ostream& operator<<(std::ostream& os, const Faults& f) {
    return os << f.duplicates << " duplicates, " << f.wrong << " wrong, " << f.refused << " refused, "
              << f.probes << " probes, " << f.claims << " claims";
}

bool has_room(const CellTable& table, std::uint64_t key) {
    const std::uint32_t mask = table.mask();
    const std::uint32_t home = gpu::home_slot(test::key_words(key), mask);
    for (std::uint32_t i = 0; i <= std::min(mask, gpu::kCellProbes - 1); ++i) {
        const std::uint64_t there = table.keys[(home + i) & mask];
        if (there == 0 || there == key) return true;
    }
    return false;
}

int live_count(const CellTable& table) {
    return static_cast<int>(table.keys.size()) - static_cast<int>(std::ranges::count(table.keys, 0u));
}

// Checks a table after a pass that began with `live_before` slots taken.
Faults faults_of(const CellTable& table, const Searches& searches, int live_before) {
    Faults faults;
    std::map<std::uint64_t, int> live;
    for (const std::uint64_t key : table.keys) {
        if (key != 0 && ++live[key] > 1) ++faults.duplicates;
    }
    int claimed = 0;
    for (const auto& [key, found] : searches) {
        claimed += found.claimed ? 1 : 0;
        if (found.slot == kNoSlot) {
            faults.refused += has_room(table, key) ? 1 : 0;
        } else {
            faults.wrong += found.slot > table.mask() || table.keys[found.slot] != key ? 1 : 0;
        }
        faults.probes += found.probes < 1 || found.probes > 2 * gpu::kCellProbes ? 1 : 0;
    }
    faults.claims = std::abs(live_count(table) - live_before - claimed);
    return faults;
}

Searches search_all(CellTable& table, const Keys& keys, Search search) {
    Searches searches;
    for (const std::uint64_t key : keys)
        searches.push_back({key, search(table, test::key_words(key), table.mask())});
    return searches;
}

Keys shuffled(Keys keys, TestRandom& random) {
    for (std::size_t i = keys.size(); i > 1; --i)
        std::swap(keys[i - 1], keys[random.bits64() % i]);
    return keys;
}

// Every thread searches all keys, each in an order of its own.
Searches search_in_threads(CellTable& table, const Keys& keys, std::size_t thread_count, TestRandom& random) {
    std::vector<Keys> orders;
    for (std::size_t i = 0; i < thread_count; ++i)
        orders.push_back(shuffled(keys, random));
    std::vector<Searches> found(thread_count);
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < thread_count; ++i)
        threads.emplace_back([&, i] { found[i] = search_all(table, orders[i], find_or_claim); });
    Searches all;
    for (std::size_t i = 0; i < thread_count; ++i) {
        threads[i].join();
        all.insert(all.end(), found[i].begin(), found[i].end());
    }
    return all;
}

// Empties about every third slot, also in the middle of runs.
void empty_some(CellTable& table, TestRandom& random) {
    for (std::uint64_t& key : table.keys) {
        if (random.bits64() % 3 == 0) key = 0;
    }
}

struct Kind {
    std::size_t slots;
    std::size_t threads;
    bool collide;
    double late_reads;
};

Faults faults_of_passes(const Kind& kind, int passes) {
    TestRandom random(kind.slots * 64 + kind.threads);
    CellTable table(kind.slots);
    table.late_reads = kind.late_reads;
    const std::size_t count = std::max<std::size_t>(3, std::min<std::size_t>(kind.slots * 3 / 4, 600));
    const Keys keys = kind.collide ? colliding_keys(random, std::min<std::size_t>(count, 48), table.mask())
                                   : random_keys(random, count);
    Faults sum;
    for (int pass = 0; pass < passes && sum.all() == 0; ++pass) {
        table.begin_pass();
        const int live_before = live_count(table);
        const Searches searches = search_in_threads(table, keys, kind.threads, random);
        sum = faults_of(table, searches, live_before);
        empty_some(table, random);
    }
    return sum;
}

TEST(CellTable, threads_that_search_and_claim_together_never_double_or_mistake_a_key) {
    for (const std::size_t slots : {1u, 2u, 16u, 64u, 4096u}) {
        for (const std::size_t threads : {1u, 2u, 3u, 8u}) {
            for (const bool collide : {false, true}) {
                for (const double late : {0.0, 0.3}) {
                    const Faults faults = faults_of_passes({slots, threads, collide, late}, 6);
                    EXPECT_EQ(faults.all(), 0)
                        << faults << ": " << slots << " slots, " << threads << " threads, "
                        << (collide ? "one home, " : "") << late << " late";
                }
            }
        }
    }
}

// Searches that start in the middle of another one, at any of its accesses, up to three deep.
struct Interruptions {
    CellTable& table;
    const Keys& keys;
    Search search;
    TestRandom random{31};
    Searches done{};
    int depth = 0;

    void operator()() {
        if (depth >= 3 || random.bits64() % 4 != 0) return;
        ++depth;
        const std::uint64_t key = keys[random.bits64() % keys.size()];
        const FoundSlot found = search(table, test::key_words(key), table.mask());
        done.push_back({key, found});
        --depth;
    }
};

Faults interrupted_faults(Search search, std::size_t slots, double late_reads) {
    TestRandom random(slots);
    CellTable table(slots);
    table.late_reads = late_reads;
    const Keys keys = colliding_keys(random, std::min<std::size_t>(slots, 40), table.mask());
    Faults sum;
    for (int pass = 0; pass < 60 && sum.all() == 0; ++pass) {
        table.begin_pass();
        const int live_before = live_count(table);
        Interruptions interruptions{.table = table, .keys = keys, .search = search};
        interruptions.random = TestRandom(static_cast<std::uint64_t>(pass));
        table.interrupt = std::ref(interruptions);
        Searches searches = search_all(table, shuffled(keys, random), search);
        table.interrupt = nullptr;
        searches.insert(searches.end(), interruptions.done.begin(), interruptions.done.end());
        sum = faults_of(table, searches, live_before);
        empty_some(table, random);
    }
    return sum;
}

TEST(CellTable, search_interrupted_at_any_access_never_doubles_or_mistakes_a_key) {
    for (const std::size_t slots : {1u, 2u, 16u, 64u, 4096u}) {
        for (const double late : {0.0, 0.3}) {
            const Faults faults = interrupted_faults(find_or_claim, slots, late);
            EXPECT_EQ(faults.all(), 0) << faults << ": " << slots << " slots, " << late << " late";
        }
    }
}

// Negative control: looks and writes in two steps.
FoundSlot claim_in_two_steps(CellTable& table, gpu::uvec2 key, std::uint32_t mask) {
    const std::uint32_t home = gpu::home_slot(key, mask);
    FoundSlot found{.slot = kNoSlot, .probes = 1, .claimed = false};
    for (std::uint32_t i = 0; i <= std::min(mask, gpu::kCellProbes - 1); ++i) {
        const std::uint32_t slot = (home + i) & mask;
        const std::uint64_t there = test::key_bits(gpu::table_key(table, slot));
        if (there != 0 && there != test::key_bits(key)) continue;
        if (there == 0) {
            if (table.interrupt) table.interrupt();
            table.keys[slot] = test::key_bits(key);
        }
        return {.slot = slot, .probes = 1, .claimed = there == 0};
    }
    return found;
}

// Negative control: takes the first free slot, although the key may be behind it.
FoundSlot claim_before_the_search_ends(CellTable& table, gpu::uvec2 key, std::uint32_t mask) {
    const std::uint32_t home = gpu::home_slot(key, mask);
    for (std::uint32_t i = 0; i <= std::min(mask, gpu::kCellProbes - 1); ++i) {
        const std::uint32_t slot = (home + i) & mask;
        const std::uint64_t there = test::key_bits(gpu::table_claim(table, slot, key));
        if (there == 0 || there == test::key_bits(key))
            return {.slot = slot, .probes = i + 1, .claimed = there == 0};
    }
    return {.slot = kNoSlot, .probes = 1, .claimed = false};
}

// Negative control: searches to the end, but takes a half-written key for another one.
FoundSlot trust_half_keys(CellTable& table, gpu::uvec2 key, std::uint32_t mask) {
    const std::uint32_t home = gpu::home_slot(key, mask);
    const std::uint32_t most = std::min(mask, gpu::kCellProbes - 1) + 1;
    for (std::uint32_t i = 0; i < 2 * most; ++i) {
        const std::uint32_t slot = (home + i % most) & mask;
        const gpu::uvec2 seen = gpu::table_key(table, slot);
        if (seen == key) return {.slot = slot, .probes = i + 1, .claimed = false};
        if (i < most || seen.x != 0u || seen.y != 0u) continue;
        const std::uint64_t there = test::key_bits(gpu::table_claim(table, slot, key));
        if (there == 0 || there == test::key_bits(key))
            return {.slot = slot, .probes = i + 1, .claimed = there == 0};
    }
    return {.slot = kNoSlot, .probes = 1, .claimed = false};
}

TEST(CellTable, comparison_rejects_a_claim_in_two_steps) {
    const Faults faults = interrupted_faults(claim_in_two_steps, 64, 0.0);
    EXPECT_GT(faults.wrong + faults.claims, 0);
}

TEST(CellTable, comparison_rejects_a_claim_before_the_search_ends) {
    EXPECT_GT(interrupted_faults(claim_before_the_search_ends, 64, 0.0).duplicates, 0);
}

TEST(CellTable, comparison_rejects_trust_in_half_written_keys) {
    EXPECT_GT(interrupted_faults(trust_half_keys, 64, 0.3).duplicates, 0);
}

TEST(HardCase, hole04_key_behind_an_emptied_slot_is_found_and_not_doubled) {
    TestRandom random(4);
    for (std::uint32_t emptied = 0; emptied < 31; ++emptied) {
        CellTable table(64);
        const Keys keys = colliding_keys(random, 32, table.mask());
        const Searches first = search_all(table, keys, find_or_claim);
        table.keys[first[emptied].found.slot] = 0;
        for (std::uint32_t i = emptied + 1; i < 32; ++i) {
            const FoundSlot found = find_or_claim(table, test::key_words(keys[i]), table.mask());
            EXPECT_EQ(found.slot, first[i].found.slot);
            EXPECT_FALSE(found.claimed);
        }
        const FoundSlot back = find_or_claim(table, test::key_words(keys[emptied]), table.mask());
        EXPECT_EQ(back.slot, first[emptied].found.slot);
        EXPECT_TRUE(back.claimed);
    }
}

TEST(HardCase, row19_full_table_refuses_after_a_bounded_search) {
    TestRandom random(19);
    for (const std::size_t slots : {1u, 2u, 16u, 64u}) {
        CellTable table(slots);
        const std::size_t most = std::min<std::size_t>(slots, gpu::kCellProbes);
        const Searches searches =
            search_all(table, colliding_keys(random, most + 5, table.mask()), find_or_claim);
        for (std::size_t i = 0; i < searches.size(); ++i) {
            EXPECT_EQ(searches[i].found.slot == kNoSlot, i >= most) << slots;
            EXPECT_LE(searches[i].found.probes, 2 * most);
        }
    }
}

// The fraction of home slots from which kCellProbes slots in a row are taken, in tables filled by random
// keys.
double share_of_full_runs(double load, int tables) {
    constexpr std::size_t kSlots = std::size_t{1} << 20;
    std::size_t full = 0;
    for (int i = 0; i < tables; ++i) {
        TestRandom random(static_cast<std::uint64_t>(i));
        CellTable table(kSlots);
        for (int n = static_cast<int>(load * double{kSlots}); n > 0; --n)
            (void)find_or_claim(table, test::key_words(random_key(random)), table.mask());
        std::size_t run = 0;
        for (const std::uint64_t key : table.keys) {
            run = key != 0 ? run + 1 : 0;
            full += run >= gpu::kCellProbes ? 1 : 0;
        }
    }
    return static_cast<double>(full) / (tables * double{kSlots});
}

TEST(CellTable, cell_is_refused_about_once_in_a_million_at_a_load_of_two_fifths) {
    EXPECT_LT(share_of_full_runs(1.0 / 3.0, 1), 1e-6);
    const double share = share_of_full_runs(0.4, 2);
    RecordProperty("in_a_million", std::to_string(share * 1e6));
    EXPECT_LT(share, 1e-5);
    EXPECT_GT(share_of_full_runs(0.5, 1), 1e-5) << "a load of a half is worse by far";
}

TEST(CellTable, right_guess_needs_no_probe_and_a_wrong_one_changes_nothing) {
    TestRandom random(23);
    CellTable table(64);
    const std::uint64_t key = random_key(random);
    const std::uint64_t other = random_key(random);
    const gpu::uint slot = find_or_claim(table, test::key_words(key), table.mask()).slot;
    const gpu::uint elsewhere = find_or_claim(table, test::key_words(other), table.mask()).slot;
    for (const gpu::uint guess : {slot, elsewhere, (slot + 1) % 64}) {
        const FoundSlot found = gpu::find_or_claim(table, test::key_words(key), table.mask(), guess);
        EXPECT_EQ(found.slot, slot);
        EXPECT_FALSE(found.claimed);
        EXPECT_EQ(found.probes == 0, guess == slot);
    }
}

}  // namespace
}  // namespace voxilux

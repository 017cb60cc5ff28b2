#pragma once

// A table of cells in C++ for shaders/shared/cell_table.h. Its reads may be as stale as a device's, and other
// work may run between any two accesses.

#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

#include "shared/portable.h"
#include "support/ao_keys.h"
#include "support/statistics.h"

namespace voxilux::test {

struct CellTable {
    explicit CellTable(std::size_t slots) : keys(slots, 0), is_settled(slots, 0) {}

    // Begins a new pass: everybody sees what was written before.
    void begin_pass() {
        for (std::size_t slot = 0; slot < keys.size(); ++slot)
            is_settled[slot] = keys[slot] != 0 ? 1 : 0;
    }
    [[nodiscard]] std::uint32_t mask() const { return static_cast<std::uint32_t>(keys.size()) - 1; }

    std::vector<std::uint64_t> keys;  // 0: empty
    std::vector<char> is_settled;     // written in an earlier pass
    double late_reads = 0.0;          // fraction of reads that miss a half or all of a key of this pass
    std::function<void()> interrupt;  // called before every access
};

// A read that may be stale: it returns halves of the key, or the value before it.
inline std::uint64_t read_late(const CellTable& table, std::uint32_t slot, std::uint64_t key) {
    thread_local TestRandom random(77);
    if (table.late_reads <= 0.0 || table.is_settled[slot] != 0) return key;
    if (random.uniform(0.0, 1.0) >= table.late_reads) return key;
    constexpr std::uint64_t kParts[] = {0, 0xFFFFFFFFu, 0xFFFFFFFF00000000u};
    return key & kParts[random.bits64() % 3];
}

}  // namespace voxilux::test

namespace voxilux::gpu {

inline uvec2 table_key(test::CellTable& table, uint slot) {
    if (table.interrupt) table.interrupt();
    const std::uint64_t key = std::atomic_ref(table.keys[slot]).load(std::memory_order_relaxed);
    return test::key_words(test::read_late(table, slot, key));
}

inline uvec2 table_claim(test::CellTable& table, uint slot, uvec2 key) {
    if (table.interrupt) table.interrupt();
    std::uint64_t there = 0;
    std::atomic_ref(table.keys[slot])
        .compare_exchange_strong(there, test::key_bits(key), std::memory_order_relaxed);
    return test::key_words(there);
}

}  // namespace voxilux::gpu

#define VX_TABLE_PARAM ::voxilux::test::CellTable &table,
#define VX_TABLE_ARG table,
#include "shared/cell_table.h"
#undef VX_TABLE_PARAM
#undef VX_TABLE_ARG

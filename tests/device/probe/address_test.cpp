// Buffers that are larger than a binding may be, reached by their address.

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "base/checked_cast.h"
#include "shared/hash.h"
#include "support/device_fixture.h"

namespace voxilux {
namespace {

using Words = std::vector<std::uint32_t>;

constexpr std::uint64_t kBigBytes = (std::uint64_t{256} << 20) + 64;
constexpr std::uint32_t kLastWord = static_cast<std::uint32_t>(kBigBytes / 4) - 1;
constexpr std::uint32_t kLine = (128u << 20) / 4;  // first word past the largest binding of lavapipe
constexpr std::uint32_t kBackground = 0xABCD0123u;

std::span<const std::byte> bytes_of(const Words& words) {
    return std::as_bytes(std::span(words));
}

// Both ends, both sides of each power of two up to the end (the line of 128 MiB among them), and words spread
// over the whole.
Words sparse_indices() {
    Words indices = {0, kLastWord - 1, kLastWord};
    for (std::uint32_t power = 2; power < kLastWord; power *= 2)
        indices.insert(indices.end(), {power - 1, power, power + 1});
    for (std::uint32_t i = 0; i < 4096; ++i)
        indices.push_back(gpu::pcg_hash(i) % (kLastWord + 1));
    std::ranges::sort(indices);
    const auto repeated = std::ranges::unique(indices);
    indices.erase(repeated.begin(), repeated.end());
    return indices;
}

// What the tests store at a word: never the background.
std::uint32_t value_at(std::uint32_t index) {
    return gpu::pcg_hash(index) & 0x7FFFFFFFu;
}

Words values_at(const Words& indices) {
    Words values(indices.size());
    std::ranges::transform(indices, values.begin(), value_at);
    return values;
}

class Addresses : public testing::Test {
  protected:
    Executor executor_{test_device(), all_shaders()};  // no poison, because filling large buffers takes long
};

std::uint32_t count_of(const Words& indices) {
    return checked_cast<std::uint32_t>(indices.size(), "indices");
}

Recording with_indices(const Words& indices, const BufferProxy& source) {
    Recording recording;
    recording.declare(source);
    recording.declare({.name = "t.indices", .size_bytes = 4 * indices.size()});
    recording.declare({.name = "t.values", .size_bytes = 4 * indices.size()});
    recording.declare({.name = "t.out", .size_bytes = 4 * indices.size()});
    recording.declare({.name = "t.none", .size_bytes = 4});
    recording.upload("t.indices", bytes_of(indices));
    return recording;
}

Dispatch gather(const std::string& from, const Words& indices) {
    return {.label = "t.gather",
            .shader = "gather_words",
            .extent = {count_of(indices), 1, 1},
            .bindings = {{"Bound", "t.none"}, {"Indices", "t.indices"}, {"Out", "t.out"}},
            .addresses = {{"from", from}},
            .push = to_bytes(count_of(indices))};
}

Dispatch scatter(const std::string& to, const Words& indices) {
    return {.label = "t.scatter",
            .shader = "scatter_words",
            .extent = {count_of(indices), 1, 1},
            .bindings = {{"Indices", "t.indices"}, {"In", "t.values"}},
            .addresses = {{"to", to}},
            .push = to_bytes(count_of(indices))};
}

// Uploads `values` word by word to their places in a buffer over the limit, and returns what the device reads
// there by address.
Words read_back_by_address(Executor& executor, const Words& indices, const Words& values) {
    Recording recording = with_indices(indices, {.name = "t.big", .size_bytes = kBigBytes});
    for (std::size_t i = 0; i < indices.size(); ++i)
        recording.upload("t.big", std::as_bytes(std::span(values).subspan(i, 1)),
                         std::uint64_t{4} * indices[i]);
    recording.dispatch(gather("t.big", indices));
    recording.readback("t.out");
    return values_of<std::uint32_t>(executor.run(recording), "t.out");
}

TEST_F(Addresses, words_on_both_sides_of_the_binding_limit_are_read) {
    const Words indices = sparse_indices();
    ASSERT_TRUE(std::ranges::binary_search(indices, kLine) && indices.back() == kLastWord);
    EXPECT_EQ(read_back_by_address(executor_, indices, values_at(indices)), values_at(indices));
}

TEST_F(Addresses, one_changed_word_in_a_large_buffer_is_seen) {
    const Words indices = sparse_indices();
    const Words expected = values_at(indices);
    Words changed = expected;
    const auto place = std::ranges::find(indices, kLine) - indices.begin();
    changed[static_cast<std::size_t>(place)] ^= 1u;
    const Words seen = read_back_by_address(executor_, indices, changed);
    EXPECT_EQ(seen, changed);
    EXPECT_NE(seen, expected);
}

// The words from `first` on after a scatter over a cleared buffer.
Words expected_window(const Words& indices, std::uint32_t first, std::uint32_t count) {
    Words window(count, kBackground);
    for (const std::uint32_t index : indices)
        if (index >= first && index - first < count) window[index - first] = value_at(index);
    return window;
}

TEST_F(Addresses, words_on_both_sides_of_the_binding_limit_are_written_and_no_others) {
    const Words indices = sparse_indices();
    const BufferProxy big{.name = "t.big", .size_bytes = kBigBytes, .persistent = true};
    Recording recording = with_indices(indices, big);
    recording.upload("t.values", bytes_of(values_at(indices)));
    recording.clear("t.big", kBackground);
    recording.dispatch(scatter("t.big", indices));
    recording.dispatch(gather("t.big", indices));
    recording.readback("t.out");
    EXPECT_EQ(values_of<std::uint32_t>(executor_.run(recording), "t.out"), values_at(indices));

    constexpr std::uint32_t window = 1u << 16;
    for (const std::uint32_t first : {0u, kLine - window / 2, kLastWord + 1 - window}) {
        Recording look;
        look.declare(big);
        look.readback("t.big", std::uint64_t{4} * first, std::uint64_t{4} * window);
        EXPECT_EQ(values_of<std::uint32_t>(executor_.run(look), "t.big"),
                  expected_window(indices, first, window))
            << first;
    }
}

TEST_F(Addresses, bound_and_addressed_uses_of_one_buffer_keep_their_order) {
    Words indices(1000);
    std::iota(indices.begin(), indices.end(), 0u);
    Recording recording = with_indices(indices, {.name = "t.a", .size_bytes = 4000});
    const auto add = [&](const std::string& from, const std::string& to) {
        recording.dispatch({.label = "t.add",
                            .shader = "add_constant",
                            .extent = {count_of(indices), 1, 1},
                            .bindings = {{"In", from}, {"Out", to}},
                            .push = to_bytes(count_of(indices))});
    };
    recording.upload("t.values", bytes_of(values_at(indices)));
    recording.dispatch(scatter("t.a", indices));
    add("t.a", "t.values");  // reads bound what was written by address
    add("t.values", "t.a");  // writes bound what is read by address
    recording.dispatch(gather("t.a", indices));
    recording.readback("t.out");
    const Words seen = values_of<std::uint32_t>(executor_.run(recording), "t.out");
    for (std::uint32_t i = 0; i < indices.size(); ++i)
        ASSERT_EQ(seen[i], value_at(i) + 2) << i;
}

TEST_F(Addresses, indirect_dispatch_reads_by_address_what_a_binding_reads) {
    Words indices(1000);
    std::iota(indices.rbegin(), indices.rend(), 0u);
    std::vector<Words> seen;
    for (const std::uint32_t is_by_address : {0u, 1u}) {
        Recording recording = with_indices(indices, {.name = "t.a", .size_bytes = 4000});
        recording.declare({.name = "t.groups", .size_bytes = 12});
        recording.upload("t.a", bytes_of(values_at(indices)));
        recording.upload("t.groups", bytes_of({(count_of(indices) + 63) / 64, 1, 1}));
        Dispatch dispatch = gather("t.a", indices);
        dispatch.bindings[0].buffer = "t.a";
        dispatch.constants = {{"is_by_address", is_by_address}};
        recording.dispatch_indirect(dispatch, "t.groups");
        recording.readback("t.out");
        seen.push_back(values_of<std::uint32_t>(executor_.run(recording), "t.out"));
    }
    Words expected = values_at(indices);
    std::ranges::reverse(expected);
    EXPECT_EQ(seen[0], expected);
    EXPECT_EQ(seen[1], expected);
}

}  // namespace
}  // namespace voxilux

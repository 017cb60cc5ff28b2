#include "vk/executor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "base/error.h"
#include "support/device_fixture.h"
#include "support/probe.h"

namespace voxilux {
namespace {

constexpr std::uint32_t kPoison = 0xCDCDCDCDu;

std::span<const std::byte> bytes_of_words(const std::vector<std::uint32_t>& words) {
    return std::as_bytes(std::span(words));
}

std::vector<std::uint32_t> counting(std::uint32_t count) {
    std::vector<std::uint32_t> words(count);
    std::iota(words.begin(), words.end(), 0u);
    return words;
}

Dispatch add_constant(std::uint32_t count, const std::string& from, const std::string& to) {
    return {.label = "probe.add",
            .shader = "add_constant",
            .extent = {count, 1, 1},
            .bindings = {{"In", from}, {"Out", to}},
            .push = to_bytes(count)};
}

struct Pair {
    std::uint32_t a, b;
};

TEST(Probe, vector_add_gives_every_sum) {
    std::vector<Pair> pairs;
    for (std::uint32_t i = 0; i < 1000; ++i)
        pairs.push_back({i * 7919u, 0xFFFFFFFFu - i});
    const auto sums = run_probe<Pair, std::uint32_t>("add_pairs", pairs);
    ASSERT_EQ(sums.size(), pairs.size());
    for (std::size_t i = 0; i < sums.size(); ++i)
        EXPECT_EQ(sums[i], pairs[i].a + pairs[i].b) << i;
}

TEST(Probe, no_inputs_give_no_outputs) {
    EXPECT_TRUE((run_probe<Pair, std::uint32_t>("add_pairs", {}).empty()));
}

// Hard case 39: group counts around the limits. Each invocation below the count runs exactly once.
class DispatchSize : public testing::TestWithParam<std::uint32_t> {};

TEST_P(DispatchSize, each_invocation_runs_once) {
    const std::uint32_t count = GetParam();
    Recording recording;
    recording.declare({.name = "t.counts", .size_bytes = std::uint64_t{4} * std::max(count, 1u)});
    recording.clear("t.counts");
    recording.dispatch({.label = "t.count",
                        .shader = "count_invocations",
                        .extent = {count, 1, 1},
                        .bindings = {{"Counts", "t.counts"}},
                        .push = to_bytes(count)});
    recording.readback("t.counts");
    const auto counts = values_of<std::uint32_t>(test_executor().run(recording), "t.counts");
    const auto wrong = std::ranges::count_if(counts, [](std::uint32_t n) { return n != 1; });
    EXPECT_EQ(wrong, count == 0 ? 1 : 0);
}

INSTANTIATE_TEST_SUITE_P(Executor, DispatchSize,
                         testing::Values(0u, 1u, 63u, 64u, 65u, 65535u * 64u, 65535u * 64u + 1u,
                                         65536u * 64u));

TEST(Executor, indirect_dispatch_takes_its_groups_from_the_device) {
    const std::uint32_t count = 1000;
    Recording recording;
    recording.declare({.name = "t.groups", .size_bytes = 16});
    recording.declare({.name = "t.counts", .size_bytes = 4 * count});
    recording.clear("t.counts");
    recording.dispatch({.label = "t.make",
                        .shader = "make_groups",
                        .bindings = {{"Groups", "t.groups"}},
                        .push = to_bytes(count / 2)});
    recording.dispatch_indirect({.label = "t.count",
                                 .shader = "count_invocations",
                                 .bindings = {{"Counts", "t.counts"}},
                                 .push = to_bytes(count)},
                                "t.groups");
    recording.readback("t.counts");
    const auto counts = values_of<std::uint32_t>(test_executor().run(recording), "t.counts");
    const std::uint32_t expected = (count / 2 + 63) / 64 * 64;
    for (std::uint32_t i = 0; i < count; ++i)
        ASSERT_EQ(counts[i], i < expected ? 1u : 0u) << i;
}

TEST(Executor, transfers_keep_the_order_of_the_recording) {
    Recording recording;
    recording.declare({.name = "t.a", .size_bytes = 32});
    recording.declare({.name = "t.b", .size_bytes = 32});
    recording.upload("t.a", bytes_of_words(counting(8)));
    recording.upload("t.a", bytes_of_words({100u}), 4);
    recording.dispatch(add_constant(8, "t.a", "t.b"));
    recording.upload(
        "t.a", bytes_of_words({50u, 51u, 52u, 53u, 54u, 55u, 56u, 57u}));  // after the dispatch has read it
    recording.readback("t.b");
    recording.clear("t.b", 9);  // after it was read back
    recording.readback("t.a", 8, 12);
    recording.dispatch(add_constant(8, "t.a", "t.b"));
    const RunResult result = test_executor().run(recording);
    EXPECT_EQ(values_of<std::uint32_t>(result, "t.b"),
              (std::vector<std::uint32_t>{1, 101, 3, 4, 5, 6, 7, 8}));
    EXPECT_EQ(values_of<std::uint32_t>(result, "t.a"), (std::vector<std::uint32_t>{52, 53, 54}));
}

TEST(Executor, transfers_longer_than_the_staging_memory_arrive_whole) {
    Executor executor(test_device(), all_shaders(), {.poison_transients = true, .staging_bytes = 4096});
    const std::uint32_t count = 100'003;
    Recording recording;
    for (const char* name : {"t.a", "t.b", "t.c"})
        recording.declare({.name = name, .size_bytes = 4 * count});
    recording.clear("t.a",
                    5);  // a use before the upload, and one after the readback, so that both are staged
    recording.upload("t.a", bytes_of_words(counting(count)));
    recording.dispatch(add_constant(count, "t.a", "t.b"));
    recording.readback("t.b");
    recording.dispatch(add_constant(count, "t.b", "t.c"));
    recording.readback("t.c");
    const RunResult result = executor.run(recording);
    const auto once = values_of<std::uint32_t>(result, "t.b");
    const auto twice = values_of<std::uint32_t>(result, "t.c");
    for (std::uint32_t i = 0; i < count; ++i) {
        ASSERT_EQ(once[i], i + 1);
        ASSERT_EQ(twice[i], i + 2);
    }
}

TEST(Executor, constants_are_set_by_name) {
    Recording recording;
    recording.declare({.name = "t.in", .size_bytes = 16});
    for (const char* name : {"t.plain", "t.seven", "t.minus"})
        recording.declare({.name = name, .size_bytes = 16});
    recording.upload("t.in", bytes_of_words({10u, 20u, 30u, 40u}));
    Dispatch dispatch = add_constant(4, "t.in", "t.plain");
    recording.dispatch(dispatch);
    dispatch.bindings = {{"Out", "t.seven"}, {"In", "t.in"}};
    dispatch.constants = {{"step", 7}};
    recording.dispatch(dispatch);
    dispatch.bindings = {{"Out", "t.minus"}, {"In", "t.in"}};
    dispatch.constants = {{"is_negative", 1}, {"step", 2}};
    recording.dispatch(dispatch);
    for (const char* name : {"t.plain", "t.seven", "t.minus"})
        recording.readback(name);
    Executor executor(test_device(), all_shaders());
    const RunResult result = executor.run(recording);
    EXPECT_EQ(values_of<std::uint32_t>(result, "t.plain"), (std::vector<std::uint32_t>{11, 21, 31, 41}));
    EXPECT_EQ(values_of<std::uint32_t>(result, "t.seven"), (std::vector<std::uint32_t>{17, 27, 37, 47}));
    EXPECT_EQ(values_of<std::uint32_t>(result, "t.minus"), (std::vector<std::uint32_t>{8, 18, 28, 38}));
    EXPECT_EQ(executor.pipelines_created(), 3u);
    executor.run(recording);
    EXPECT_EQ(executor.pipelines_created(), 3u);
}

struct Pixel {
    std::uint32_t index, group_x, group_y;
};

std::vector<Pixel> run_pixels(Executor& executor, std::uint32_t width, std::uint32_t height) {
    Recording recording;
    recording.declare({.name = "t.pixels", .size_bytes = std::uint64_t{12} * width * height});
    recording.dispatch({.label = "t.pixels",
                        .shader = "pixel_ids",
                        .extent = {width, height, 1},
                        .bindings = {{"Pixels", "t.pixels"}},
                        .push = to_bytes(std::array{width, height})});
    recording.readback("t.pixels");
    return values_of<Pixel>(executor.run(recording), "t.pixels");
}

TEST(Executor, group_size_option_shapes_image_groups_and_covers_odd_images) {
    for (const auto& [x, y] : {std::pair{8u, 8u}, std::pair{16u, 16u}, std::pair{64u, 1u}}) {
        Executor executor(test_device(), all_shaders(), {.group_size = {x, y}, .poison_transients = true});
        for (const auto& [width, height] : {std::pair{1u, 1u}, std::pair{1u, 67u}, std::pair{131u, 33u}}) {
            const auto pixels = run_pixels(executor, width, height);
            for (std::uint32_t i = 0; i < pixels.size(); ++i) {
                ASSERT_EQ(pixels[i].index, i);
                ASSERT_EQ(pixels[i].group_x, x);
                ASSERT_EQ(pixels[i].group_y, y);
            }
        }
    }
}

TEST(Executor, impossible_group_size_is_a_usage_error) {
    Executor executor(test_device(), all_shaders(), {.group_size = {1024, 1024}});
    try {
        run_pixels(executor, 4, 4);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::usage);
        EXPECT_NE(std::string(error.what()).find("1024x1024"), std::string::npos);
    }
}

TEST(Executor, persistent_buffers_survive_and_transient_ones_do_not_matter) {
    Executor executor(test_device(), all_shaders(), {.poison_transients = true});
    Recording first;
    first.declare({.name = "t.kept", .size_bytes = 16, .persistent = true});
    first.declare({.name = "t.lost", .size_bytes = 16});
    first.upload("t.kept", bytes_of_words({1u, 2u, 3u, 4u}));
    first.upload("t.lost", bytes_of_words({1u, 2u, 3u, 4u}));
    executor.run(first);
    Recording second;
    second.declare({.name = "t.kept", .size_bytes = 16, .persistent = true});
    second.declare({.name = "t.lost", .size_bytes = 16});
    second.readback("t.kept");
    second.readback("t.lost");
    const RunResult result = executor.run(second);
    EXPECT_EQ(values_of<std::uint32_t>(result, "t.kept"), (std::vector<std::uint32_t>{1, 2, 3, 4}));
    EXPECT_EQ(values_of<std::uint32_t>(result, "t.lost"), std::vector<std::uint32_t>(4, kPoison));
}

TEST(Executor, persistent_buffer_of_another_size_starts_anew) {
    Executor executor(test_device(), all_shaders());
    for (const std::uint64_t size : {std::uint64_t{16}, std::uint64_t{64}}) {
        Recording recording;
        recording.declare({.name = "t.kept", .size_bytes = size, .persistent = true});
        executor.run(recording);
        const auto rows = executor.memory();
        ASSERT_EQ(rows.size(), 1u);
        EXPECT_EQ(rows[0].buffer, "t.kept");
        EXPECT_EQ(rows[0].bytes, size);
    }
}

TEST(Executor, idle_transient_buffers_are_freed_and_persistent_ones_kept) {
    Executor executor(test_device(), all_shaders());
    Recording recording;
    recording.declare({.name = "t.kept", .size_bytes = 16, .persistent = true});
    recording.declare({.name = "t.idle", .size_bytes = 16});
    executor.run(recording);
    EXPECT_EQ(executor.memory().size(), 2u);
    for (int run = 0; run < 20; ++run)
        executor.run(Recording());
    ASSERT_EQ(executor.memory().size(), 1u);
    EXPECT_EQ(executor.memory()[0].buffer, "t.kept");
}

TEST(Executor, hundred_runs_of_two_dependent_dispatches_give_right_sums) {
    Executor executor(test_device(), all_shaders());
    const std::uint32_t count = 5000;
    Recording start;
    start.declare({.name = "t.sum", .size_bytes = 4 * count, .persistent = true});
    start.upload("t.sum", bytes_of_words(counting(count)));
    executor.run(start);
    Recording step;
    step.declare({.name = "t.sum", .size_bytes = 4 * count, .persistent = true});
    step.declare({.name = "t.other", .size_bytes = 4 * count});
    step.dispatch(add_constant(count, "t.sum", "t.other"));
    step.dispatch(add_constant(count, "t.other", "t.sum"));
    for (int run = 0; run < 99; ++run)
        executor.run(step);
    step.readback("t.sum");
    const auto sums = values_of<std::uint32_t>(executor.run(step), "t.sum");
    for (std::uint32_t i = 0; i < count; ++i)
        ASSERT_EQ(sums[i], i + 200);
}

TEST(Executor, times_add_up_by_label) {
    Recording recording;
    recording.declare({.name = "t.a", .size_bytes = 1 << 20});
    recording.declare({.name = "t.b", .size_bytes = 1 << 20});
    recording.clear("t.a");
    for (int i = 0; i < 3; ++i)
        recording.dispatch(add_constant(1 << 18, "t.a", "t.b"));
    Dispatch other = add_constant(1 << 18, "t.b", "t.a");
    other.label = "probe.other";
    recording.dispatch(other);
    const RunResult result = test_executor().run(recording);
    ASSERT_EQ(result.passes.size(), 2u);
    EXPECT_EQ(result.passes[0].label, "probe.add");
    EXPECT_EQ(result.passes[0].count, 3u);
    EXPECT_EQ(result.passes[1].label, "probe.other");
    EXPECT_EQ(result.passes[1].count, 1u);
    EXPECT_LE(result.passes[0].max_ms, result.passes[0].ms);
    EXPECT_EQ(result.passes[1].max_ms, result.passes[1].ms);
    for (const PassTime& pass : result.passes) {
        EXPECT_GT(pass.ms, 0.0);
        EXPECT_LT(pass.ms, 1000.0);
    }
}

TEST(Executor, absent_timing_counts_without_times) {
    Executor executor(test_device(), all_shaders(), {.time_dispatches = false});
    Recording recording;
    recording.declare({.name = "t.a", .size_bytes = 4});
    recording.declare({.name = "t.b", .size_bytes = 4});
    recording.clear("t.a");
    recording.dispatch(add_constant(1, "t.a", "t.b"));
    const RunResult result = executor.run(recording);
    ASSERT_EQ(result.passes.size(), 1u);
    EXPECT_EQ(result.passes[0].count, 1u);
    EXPECT_EQ(result.passes[0].ms, 0.0);
}

}  // namespace
}  // namespace voxilux

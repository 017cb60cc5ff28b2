// What the executor refuses, and what it accepts.

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "base/file.h"
#include "support/device_fixture.h"
#include "vk/device_state.h"

namespace voxilux {
namespace {

namespace fs = std::filesystem;

Dispatch good_dispatch() {
    return {.label = "t.add",
            .shader = "add_constant",
            .extent = {4, 1, 1},
            .bindings = {{"In", "t.a"}, {"Out", "t.b"}},
            .push = to_bytes(4u)};
}

Recording record(const Dispatch& dispatch) {
    Recording recording;
    recording.declare({.name = "t.a", .size_bytes = 16});
    recording.declare({.name = "t.b", .size_bytes = 16});
    recording.clear("t.a", 1);
    recording.dispatch(dispatch);
    recording.readback("t.b");
    return recording;
}

// The message of the InternalError with which the dispatch ends; "" when it succeeds.
std::string refusal(const Dispatch& dispatch) {
    try {
        test_executor().run(record(dispatch));
        return "";
    } catch (const InternalError& error) {
        return error.what();
    }
}

bool contains(const std::string& text, std::string_view part) {
    return text.find(part) != std::string::npos;
}

TEST(ExecutorRefuses, nothing_about_a_good_dispatch) {
    EXPECT_EQ(refusal(good_dispatch()), "");
}

TEST(ExecutorRefuses, unknown_shader) {
    Dispatch dispatch = good_dispatch();
    dispatch.shader = "no_such";
    EXPECT_TRUE(contains(refusal(dispatch), "'no_such'"));
}

TEST(ExecutorRefuses, wrong_missing_and_doubled_bindings_by_shader_and_block) {
    Dispatch dispatch = good_dispatch();
    dispatch.bindings[0].block = "in";
    EXPECT_TRUE(contains(refusal(dispatch), "'add_constant'"));
    EXPECT_TRUE(contains(refusal(dispatch), "'in'"));
    dispatch.bindings = {{"In", "t.a"}};
    EXPECT_TRUE(contains(refusal(dispatch), "'Out' is bound 0 times"));
    dispatch.bindings = {{"In", "t.a"}, {"Out", "t.b"}, {"Out", "t.a"}};
    EXPECT_TRUE(contains(refusal(dispatch), "'Out' is bound 2 times"));
    dispatch.bindings = {{"In", "t.a"}, {"Out", "t.b"}, {"Unused", "t.a"}};
    EXPECT_TRUE(contains(refusal(dispatch), "'Unused'"));
}

TEST(ExecutorRefuses, wrong_push_size_and_unknown_constant) {
    Dispatch dispatch = good_dispatch();
    dispatch.push = to_bytes(std::uint64_t{4});
    EXPECT_TRUE(contains(refusal(dispatch), "8 push bytes"));
    dispatch = good_dispatch();
    dispatch.constants = {{"steps", 1}};
    EXPECT_TRUE(contains(refusal(dispatch), "'steps'"));
}

TEST(ExecutorRefuses, second_readback_of_a_buffer) {
    Recording recording = record(good_dispatch());
    recording.readback("t.b");
    EXPECT_THROW(test_executor().run(recording), InternalError);
}

TEST(ExecutorRefuses, binding_over_the_device_limit_by_buffer) {
    const std::uint64_t limit = test_device().limits().max_binding_bytes;
    if (limit >= test_device().limits().max_allocation_bytes)
        GTEST_SKIP() << "bindings have no limit of their own";
    Recording recording;
    recording.declare({.name = "t.a", .size_bytes = limit + 4});
    recording.declare({.name = "t.b", .size_bytes = 16});
    recording.dispatch(good_dispatch());
    Executor executor(test_device(), all_shaders());
    try {
        executor.run(recording);
        FAIL() << "no error";
    } catch (const InternalError& error) {
        for (const char* part : {"'add_constant'", "'In'", "'t.a'"})
            EXPECT_TRUE(contains(error.what(), part)) << error.what();
    }
}

Dispatch gather_dispatch() {
    return {.label = "t.gather",
            .shader = "gather_words",
            .extent = {4, 1, 1},
            .bindings = {{"Bound", "t.a"}, {"Indices", "t.a"}, {"Out", "t.b"}},
            .addresses = {{"from", "t.a"}},
            .push = to_bytes(4u)};
}

TEST(ExecutorRefuses, wrong_missing_and_doubled_pointers_by_shader_and_member) {
    EXPECT_EQ(refusal(gather_dispatch()), "");
    Dispatch dispatch = gather_dispatch();
    dispatch.addresses[0].member = "to";
    EXPECT_TRUE(contains(refusal(dispatch), "'gather_words': has no pointer 'to'"));
    dispatch.addresses = {};
    EXPECT_TRUE(contains(refusal(dispatch), "'from' is given 0 times"));
    dispatch.addresses = {{"from", "t.a"}, {"from", "t.b"}};
    EXPECT_TRUE(contains(refusal(dispatch), "'from' is given 2 times"));
    dispatch = gather_dispatch();
    dispatch.push = to_bytes(std::array{0u, 0u, 4u});  // the place of the pointer is not part of them
    EXPECT_TRUE(contains(refusal(dispatch), "12 push bytes were given, its push struct has 4"));
    dispatch = good_dispatch();
    dispatch.addresses = {{"from", "t.a"}};
    EXPECT_TRUE(contains(refusal(dispatch), "'add_constant': has no pointer 'from'"));
}

// The device is opened anew and told that it lacks addresses.
TEST(ExecutorRefuses, shader_that_needs_what_the_device_lacks_and_runs_the_rest) {
    constexpr std::uint32_t kPhysicalStorageBufferAddresses = 5347;  // the SPIR-V capability
    Device device = open_device({.selector = std::to_string(test_device().info().index)});
    device.state().missing_capabilities.push_back(kPhysicalStorageBufferAddresses);
    Executor executor(device, all_shaders());
    EXPECT_NO_THROW(executor.run(record(good_dispatch())));
    try {
        executor.run(record(gather_dispatch()));
        FAIL() << "no error";
    } catch (const InternalError& error) {
        EXPECT_TRUE(contains(error.what(), "'gather_words'")) << error.what();
    }
}

TEST(ExecutorRefuses, allocation_over_the_device_limit_as_out_of_memory) {
    Recording recording;
    const std::uint64_t bytes = test_device().limits().max_allocation_bytes;
    recording.declare({.name = "t.huge", .size_bytes = bytes + 4});
    try {
        test_executor().run(recording);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::out_of_memory);
        EXPECT_TRUE(contains(error.what(), "'t.huge'"));
        EXPECT_TRUE(contains(error.what(), std::to_string(bytes + 4)));
    }
}

TEST(ExecutorRefuses, nothing_after_a_refusal) {
    Dispatch dispatch = good_dispatch();
    dispatch.push.clear();
    EXPECT_NE(refusal(dispatch), "");
    EXPECT_EQ(refusal(good_dispatch()), "");
}

class PipelineCacheFile : public testing::Test {
  protected:
    void SetUp() override {
        folder_ =
            fs::path(testing::TempDir()) /
            fmt::format("voxilux_cache_{}", ::testing::UnitTest::GetInstance()->current_test_info()->name());
        fs::remove_all(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    void run_once() {
        Executor executor(test_device(), all_shaders(), {.cache_dir = folder_});
        executor.run(record(good_dispatch()));
        EXPECT_EQ(executor.pipelines_created(), 1u);
    }
    fs::path only_file() const {
        std::vector<fs::path> files;
        for (const auto& entry : fs::directory_iterator(folder_))
            files.push_back(entry.path());
        EXPECT_EQ(files.size(), 1u);
        return files.empty() ? fs::path() : files[0];
    }

    fs::path folder_;
};

TEST_F(PipelineCacheFile, is_written_and_read_again) {
    run_once();
    const fs::path file = only_file();
    EXPECT_TRUE(contains(file.filename().string(), "pipelines-"));
    EXPECT_GE(fs::file_size(file), 32u);
    run_once();
}

TEST_F(PipelineCacheFile, damaged_or_foreign_is_ignored_and_replaced) {
    run_once();
    const fs::path file = only_file();
    const std::vector<std::byte> good = read_file(file);
    std::vector<std::vector<std::byte>> bad = {{}, {good.begin(), good.begin() + 20}};
    for (const std::size_t at : {std::size_t{0}, std::size_t{16}, good.size() - 1}) {
        bad.push_back(good);
        bad.back()[at] ^= std::byte{1};
    }
    bad.emplace_back(std::size_t{1000}, std::byte{0x5A});
    for (const auto& bytes : bad) {
        write_file_atomically(file, bytes);
        run_once();
        EXPECT_NE(read_file(file), bytes);
    }
}

TEST_F(PipelineCacheFile, folder_that_cannot_be_made_is_no_error) {
    folder_ = "/dev/null/cache";
    EXPECT_NO_THROW({
        Executor executor(test_device(), all_shaders(), {.cache_dir = folder_});
        executor.run(record(good_dispatch()));
    });
    folder_ = fs::path(testing::TempDir()) / "voxilux_cache_none";
}

}  // namespace
}  // namespace voxilux

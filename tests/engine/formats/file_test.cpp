#include "base/file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <span>

#include "base/error.h"
#include "base/json.h"
#include "support/scratch_folder.h"

namespace voxilux {
namespace {

namespace fs = std::filesystem;

std::string content_of(const fs::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
}

void write_new_text(const fs::path& file) {
    write_file_atomically(file, std::as_bytes(std::span("new", 3)));
}

std::vector<std::string> names_of_files(const fs::path& folder) {
    std::vector<std::string> names;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
}

ExitCode refusal_of_outputs(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs) {
    try {
        check_outputs(outputs, inputs);
    } catch (const Error& error) {
        return error.code();
    }
    return ExitCode::done;
}

TEST(AtomicWrite, keeps_the_mode_of_the_old_file) {
    const ScratchFolder folder;
    for (const mode_t mode : {0600u, 0640u, 0755u}) {
        std::ofstream(folder / "a") << "old";
        ::chmod((folder / "a").c_str(), mode);
        write_new_text(folder / "a");
        struct stat now {};
        ASSERT_EQ(::stat((folder / "a").c_str(), &now), 0);
        EXPECT_EQ(now.st_mode & 07777, mode);
    }
    EXPECT_EQ(content_of(folder / "a"), "new");
}

TEST(AtomicWrite, links_stay_links_and_dangling_ones_get_their_target) {
    const ScratchFolder folder;
    fs::create_directory(folder / "deep");
    fs::create_symlink("deep/middle", folder / "link");
    fs::create_symlink("target", folder / "deep/middle");  // relative to its own folder
    for (int round = 0; round < 2; ++round) {
        write_new_text(folder / "link");
        EXPECT_TRUE(fs::is_symlink(folder / "link") && fs::is_symlink(folder / "deep/middle"));
        EXPECT_EQ(content_of(folder / "deep/target"), "new");
    }
    EXPECT_EQ(names_of_files(folder.path()), (std::vector<std::string>{"deep", "link"}));
}

TEST(AtomicWrite, ring_of_links_is_refused) {
    const ScratchFolder folder;
    fs::create_symlink("b", folder / "a");
    fs::create_symlink("a", folder / "b");
    EXPECT_THROW(write_new_text(folder / "a"), Error);
    EXPECT_EQ(refusal_of_outputs({folder / "a"}, {}), ExitCode::cannot_write);
}

TEST(AtomicWrite, names_as_long_as_the_file_system_allows_work) {
    const ScratchFolder folder;
    const fs::path longest = folder / std::string(255, 'n');
    check_writable(longest);
    write_new_text(longest);
    EXPECT_EQ(content_of(longest), "new");
    EXPECT_EQ(refusal_of_outputs({folder / std::string(256, 'n')}, {}), ExitCode::cannot_write);
}

TEST(AtomicWrite, temporary_file_is_new_and_beside_the_target) {
    const ScratchFolder folder;
    fs::path first, second;
    const auto name_to = [&](fs::path& name) {
        write_file_atomically(folder / "a", [&](const fs::path& temporary) {
            name = temporary;
            EXPECT_EQ(temporary.parent_path(), folder.path());
            EXPECT_EQ(fs::file_size(temporary), 0u) << "there already, and ours";
        });
    };
    name_to(first);
    name_to(second);
    EXPECT_NE(first, second) << "nobody can guess it";
}

TEST(AtomicWrite, failure_leaves_nothing) {
    const ScratchFolder folder;
    EXPECT_THROW(write_file_atomically(folder / "a", [](const fs::path&) { throw std::runtime_error("no"); }),
                 Error);
    EXPECT_EQ(names_of_files(folder.path()), std::vector<std::string>{});
}

TEST(CheckOutputs, input_under_any_name_is_no_output) {
    const ScratchFolder folder;
    const std::string input = folder / "in.toml";
    std::ofstream(input) << "x";
    fs::create_symlink("in.toml", folder / "link");
    const std::string around = folder.path() / "." / "in.toml";
    for (const std::string& name : {input, (folder / "link").string(), around})
        EXPECT_EQ(refusal_of_outputs({name}, {input}), ExitCode::usage) << name;
    EXPECT_EQ(refusal_of_outputs({folder / "out.png"}, {input}), ExitCode::done);
    EXPECT_EQ(refusal_of_outputs({folder / "out.png", "-", ""}, {"-", ""}), ExitCode::done);
}

TEST(CheckOutputs, no_file_is_written_twice) {
    const ScratchFolder folder;
    EXPECT_EQ(refusal_of_outputs({folder / "a", folder / "a"}, {}), ExitCode::usage);
    EXPECT_EQ(refusal_of_outputs({folder / "a", folder / "b"}, {}), ExitCode::done);
    EXPECT_EQ(refusal_of_outputs({"/dev/null", "/dev/null", "-", "-"}, {}), ExitCode::done);
}

// There cannot be a process 4194304: it is the kernel's upper limit.
TEST(CheckOutputs, temporary_files_of_the_dead_are_removed_after_an_hour) {
    const ScratchFolder folder;
    const auto leave = [&](const std::string& name, std::chrono::minutes age) {
        std::ofstream(folder / name) << "half";
        fs::last_write_time(folder / name, fs::file_time_type::clock::now() - age);
    };
    const std::string living = ".voxilux-" + std::to_string(::getpid()) + "-0.tmp";
    leave(".voxilux-4194304-1.tmp", std::chrono::minutes(61));
    leave(".voxilux-4194304-2.tmp", std::chrono::minutes(1));
    leave(living, std::chrono::minutes(61));
    leave("mine.tmp", std::chrono::minutes(61));
    check_outputs({folder / "a.png"}, {});
    std::vector<std::string> expected = {".voxilux-4194304-2.tmp", living, "mine.tmp"};
    std::ranges::sort(expected);
    EXPECT_EQ(names_of_files(folder.path()), expected);
}

TEST(ReadFile, pipe_is_refused_at_once) {
    const ScratchFolder folder;
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    EXPECT_THROW((void)read_file(folder / "pipe"), Error);
}

TEST(JsonText, bytes_that_are_no_utf8_are_replaced) {
    const nlohmann::json json = {{"name", "K\xf6rper"}};
    EXPECT_EQ(json_text(json), "{\"name\":\"K\xef\xbf\xbdrper\"}");
    EXPECT_EQ(parse_json<nlohmann::json>(json_text(json)).value().at("name"), "K\xef\xbf\xbdrper");
}

TEST(JsonText, nesting_is_bounded_and_brackets_in_texts_do_not_count) {
    const auto nested = [](int depth) {
        return std::string(static_cast<std::size_t>(depth), '[') +
               std::string(static_cast<std::size_t>(depth), ']');
    };
    EXPECT_TRUE(parse_json<nlohmann::json>(nested(kMaxJsonDepth)));
    EXPECT_FALSE(parse_json<nlohmann::json>(nested(kMaxJsonDepth + 1)));
    EXPECT_FALSE(parse_json<nlohmann::json>(nested(1000000)));
    EXPECT_TRUE(parse_json<nlohmann::json>("[\"\\\"" + std::string(1000, '[') + "\"]"));
    EXPECT_FALSE(parse_json<nlohmann::json>("[1e999]")) << "no double holds it";
    EXPECT_FALSE(parse_json<nlohmann::json>("[1"));
}

}  // namespace
}  // namespace voxilux

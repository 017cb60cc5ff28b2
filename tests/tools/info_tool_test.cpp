#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/file.h"
#include "info/info.h"
#include "support/vox_builder.h"

namespace voxilux {
namespace {

// A scratch folder that is removed with the test.
class InfoTool : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = std::filesystem::temp_directory_path() / fmt::format("voxilux_info_{}", ::getpid());
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    [[nodiscard]] std::string write(const std::string& name, const std::string& text) const {
        write_file_atomically(folder_ / name, vox_builder::bytes_of(text));
        return (folder_ / name).string();
    }

    std::filesystem::path folder_;
};

TEST_F(InfoTool, dash_prints_only_json) {
    const std::string file = write("rich.VOX", vox_builder::rich_file_text());
    testing::internal::CaptureStdout();
    EXPECT_EQ(run_info({.file = file, .json = "-"}), 0);
    const auto json = nlohmann::json::parse(testing::internal::GetCapturedStdout());
    EXPECT_EQ(json["models"], 2);
    EXPECT_EQ(json["instances"], 3);
    EXPECT_EQ(json["hidden_instances"], 2);
    EXPECT_EQ(json["unknown_chunks"]["rLIT"], 1);
}

TEST_F(InfoTool, file_gets_json_beside_the_text) {
    const std::string file = write("rich.vox", vox_builder::rich_file_text());
    const std::string json = (folder_ / "facts.json").string();
    testing::internal::CaptureStdout();
    EXPECT_EQ(run_info({.file = file, .json = json}), 0);
    const std::string text = testing::internal::GetCapturedStdout();
    EXPECT_NE(text.find("instances        3 (2 hidden)"), std::string::npos) << text;
    std::ifstream in(json);
    EXPECT_EQ(nlohmann::json::parse(in)["version"], 200);
}

TEST_F(InfoTool, imported_file_has_the_note_of_render) {
    const std::string file = write("points.xyz", "0 0 0\n1 1 1\n");
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    EXPECT_EQ(run_info({.file = file}), 0);
    EXPECT_NE(testing::internal::GetCapturedStdout(), "");
    const std::string note = testing::internal::GetCapturedStderr();
    EXPECT_EQ(note.find("note: " + file + ": 2 points "), 0u) << note;
}

TEST_F(InfoTool, refusals_name_the_file_and_the_reason) {
    const auto reason_of = [](const std::string& file) -> std::string {
        try {
            run_info({.file = file});
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::input_refused);
            return error.what();
        }
        return "accepted";
    };
    const std::string broken = write("broken.vox", "VOX ");
    EXPECT_EQ(reason_of(broken),
              broken + ": at byte 4: the file needs 4 bytes for its version but has 0 left");
    const std::string other = write("picture.bmp", "");
    EXPECT_EQ(reason_of(other),
              other + ": info reads .vox, .toml, .exr and .png files, voxels of other formats and meshes");
    EXPECT_NE(reason_of((folder_ / "absent.vox").string()).find("absent.vox"), std::string::npos);
}

}  // namespace
}  // namespace voxilux

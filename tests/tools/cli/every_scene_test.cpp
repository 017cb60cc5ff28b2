#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "formats/exr.h"
#include "support/scratch_folder.h"
#include "support/shared_data.h"
#include "tools/cli/child_process.h"

namespace voxilux::test {
namespace {

namespace fs = std::filesystem;

// Renders a small picture of a file under the validation layers; any message, fault or value that is not
// finite fails.
void expect_clean_render(const std::string& file, bool may_warn) {
    const ScratchFolder scratch;
    const Ending ending = run({"render", file, "--size", "160x90", "--spp", "2", "--validation", "--json",
                               "-", "-o", scratch / "a.exr"});
    ASSERT_EQ(ending.code, 0) << ending.err;
    EXPECT_EQ(ending.err.find("validation"), std::string::npos) << ending.err;
    EXPECT_EQ(ending.err.find("fault"), std::string::npos) << ending.err;
    EXPECT_TRUE(may_warn || ending.err.find("warning") == std::string::npos) << ending.err;
    const auto report = nlohmann::json::parse(ending.out);
    for (const auto& [name, count] : report["faults"].items())
        EXPECT_EQ(count, 0) << name;
    const Image image = read_exr(scratch / "a.exr");
    EXPECT_EQ(image.width, 160);
    EXPECT_EQ(image.height, 90);
    for (const auto& [name, channel] : image.channels) {
        for (const float value : channel.pixels)
            ASSERT_TRUE(std::isfinite(value)) << name;
    }
}

std::vector<std::string> stems_in(const fs::path& folder, const std::string& ending) {
    std::vector<std::string> stems;
    if (!fs::is_directory(folder)) return stems;
    for (const std::string& name : names_in(folder)) {
        if (fs::path(name).extension() == ending) stems.push_back(fs::path(name).stem().string());
    }
    return stems;
}

// A test name that GoogleTest accepts.
std::string test_name(const testing::TestParamInfo<std::string>& test) {
    std::string name = test.param;
    for (char& letter : name) {
        if (std::isalnum(static_cast<unsigned char>(letter)) == 0) letter = '_';
    }
    return name;
}

class EveryScene : public testing::TestWithParam<std::string> {};

TEST_P(EveryScene, renders_without_a_message_or_a_fault) {
    expect_clean_render(scene_file(GetParam()), false);
}

INSTANTIATE_TEST_SUITE_P(scenes, EveryScene,
                         testing::ValuesIn(stems_in(fs::path(VX_SOURCE_DIR) / "scenes", ".toml")), test_name);

class EveryVoxExternal : public testing::TestWithParam<std::string> {};

// Real files may have oddities, which are reported.
TEST_P(EveryVoxExternal, renders_without_a_message_or_a_fault) {
    SKIP_WITHOUT_SHARED_DATA();
    expect_clean_render((shared_data() / "data" / "vox" / (GetParam() + ".vox")).string(), true);
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(EveryVoxExternal);
INSTANTIATE_TEST_SUITE_P(files, EveryVoxExternal,
                         testing::ValuesIn(shared_data().empty()
                                               ? std::vector<std::string>{}
                                               : stems_in(shared_data() / "data" / "vox", ".vox")),
                         test_name);

}  // namespace
}  // namespace voxilux::test

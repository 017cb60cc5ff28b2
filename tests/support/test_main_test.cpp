// The rules of test_main.cpp, by this binary run again with a sample test that breaks them.

#include <gtest/gtest.h>

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace voxilux::test {
namespace {

constexpr const char* kSample = "VX_SAMPLE_PARAMETER";  // set: there is a sample, with this parameter

class Skipping : public testing::Test {
    void TestBody() override { GTEST_SKIP() << "as asked for"; }
};

void add_sample(const char* suite, const char* parameter) {
    testing::RegisterTest(suite, "skips", nullptr, parameter, __FILE__, __LINE__,
                          [] { return new Skipping; });
}

[[maybe_unused]] const bool kHasSample = [] {
    const char* parameter = std::getenv(kSample);
    if (parameter == nullptr) return false;
    add_sample("SampleExternal", parameter);
    add_sample("Sample", parameter);
    return true;
}();

// Exit code of the samples of a suite.
int run_sample(const std::string& suite, const std::string& ci, const std::string& parameter = "night") {
    const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
    const std::string command = "CI=" + ci + " " + kSample + "='" + parameter + "' '" + self +
                                "' --gtest_filter=" + suite + ".* > /dev/null 2>&1";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(ExternalSkip, is_a_failure_where_ci_is_true) {
    EXPECT_EQ(run_sample("SampleExternal", "true"), 1);
}

TEST(ExternalSkip, is_a_skip_elsewhere) {
    EXPECT_EQ(run_sample("SampleExternal", "false"), 0);
    EXPECT_EQ(run_sample("SampleExternal", ""), 0);
}

TEST(ExternalSkip, rule_is_for_external_tests_alone) {
    EXPECT_EQ(run_sample("Sample", "true"), 0);
}

TEST(ReadableParameters, bytes_and_addresses_are_refused) {
    EXPECT_EQ(run_sample("Sample", "false", "4-byte object <0A-00 00-00>"), 1);
    EXPECT_EQ(run_sample("Sample", "false", "(\"night\", 0x55e0c0ffee10)"), 1);
    EXPECT_EQ(run_sample("Sample", "false", "640x360"), 0);
}

}  // namespace
}  // namespace voxilux::test

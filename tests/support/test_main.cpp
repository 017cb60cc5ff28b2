// main() of every test binary: that of GoogleTest, and two rules for all tests.

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <iostream>

namespace {

bool contains(const char* text, const char* part) {
    return text != nullptr && std::strstr(text, part) != nullptr;
}

// A test of External data may be skipped on a machine without the data or a tool that checks it. Continuous
// integration has both, so a skip there is a failure.
class ExternalSkips : public testing::EmptyTestEventListener {
    void OnTestEnd(const testing::TestInfo& test) override {
        const char* ci = std::getenv("CI");
        if (ci != nullptr && std::strcmp(ci, "true") == 0 && test.result()->Skipped() &&
            contains(test.test_suite_name(), "External"))
            ADD_FAILURE() << "an external test must not be skipped where CI=true";
    }
};

bool has_address(const char* text) {
    constexpr std::size_t kDigits = 8;  // at least, of an address
    while (text != nullptr && (text = std::strstr(text, "0x")) != nullptr) {
        text += 2;
        if (std::strspn(text, "0123456789abcdef") >= kDigits) return true;
    }
    return false;
}

// ctest shows the parameter of a test as part of its name: bytes and addresses tell nobody anything, and
// addresses differ from run to run.
bool has_readable_parameter(const testing::TestInfo& test) {
    return !contains(test.value_param(), "byte object") && !has_address(test.value_param());
}

bool all_parameters_are_readable() {
    const testing::UnitTest& tests = *testing::UnitTest::GetInstance();
    for (int s = 0; s < tests.total_test_suite_count(); ++s) {
        const testing::TestSuite& suite = *tests.GetTestSuite(s);
        for (int t = 0; t < suite.total_test_count(); ++t) {
            const testing::TestInfo& test = *suite.GetTestInfo(t);
            if (has_readable_parameter(test)) continue;
            std::cerr << suite.name() << '.' << test.name() << ": the parameter " << test.value_param()
                      << " needs PrintTo()\n";
            return false;
        }
    }
    return true;
}

}  // namespace

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    if (!all_parameters_are_readable()) return EXIT_FAILURE;
    testing::UnitTest::GetInstance()->listeners().Append(new ExternalSkips);  // owned by the list
    return RUN_ALL_TESTS();
}

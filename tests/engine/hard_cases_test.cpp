// The list of hard cases, tests/truth/stability/README.md, against the tests that exist.

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "support/source_tree.h"

namespace voxilux {
namespace {

using test::Pattern;
using test::SourceFile;

struct HardCaseRow {
    std::string number;
    std::vector<std::string> tests;  // "Suite.name"
    bool is_excused = false;         // says what it waits for, or that it is missing
};

std::vector<HardCaseRow> rows_of(const std::string& list) {
    const Pattern head(R"(^### ([A-Z]?[0-9]+)\. )");
    const Pattern test(R"(^- `([^`]+)`$)");
    const Pattern excuse(R"((^|[ .])(When .* exists?:|Missing[.:]))");
    std::vector<HardCaseRow> rows;
    for (const std::string& line : test::lines_of(list)) {
        if (const auto found = head.find(line); !found.empty()) rows.push_back({found[1], {}, false});
        if (rows.empty()) continue;
        if (const auto found = test.find(line); !found.empty()) rows.back().tests.push_back(found[1]);
        rows.back().is_excused |= !excuse.find(line).empty();
    }
    return rows;
}

// "Suite.name" of each TEST, TEST_F and TEST_P.
std::set<std::string> tests_in(const std::vector<SourceFile>& files) {
    const Pattern head(R"(^TEST(_[FP])?\(([A-Za-z0-9_]+), *([A-Za-z0-9_]+)\))");
    std::set<std::string> names;
    for (const SourceFile& file : files) {
        for (const std::string& line : test::lines_of(file.text)) {
            if (const auto found = head.find(line); !found.empty()) names.insert(found[2] + "." + found[3]);
        }
    }
    return names;
}

std::vector<std::string> faults_of(const std::vector<HardCaseRow>& rows, const std::set<std::string>& tests) {
    std::vector<std::string> faults;
    for (const HardCaseRow& row : rows) {
        if (row.tests.empty() && !row.is_excused) faults.push_back("row " + row.number + " has no test");
        for (const std::string& test : row.tests) {
            if (!tests.contains(test)) faults.push_back("row " + row.number + ": there is no test " + test);
        }
    }
    return faults;
}

std::vector<HardCaseRow> our_rows() {
    return rows_of(test::read_text(VX_SOURCE_DIR "/tests/truth/stability/README.md"));
}

TEST(HardCaseList, every_test_that_a_row_names_exists) {
    EXPECT_EQ(test::joined(faults_of(our_rows(), tests_in(test::source_files("tests", {"_test.cpp"})))), "");
}

TEST(HardCaseList, row_without_a_test_or_with_one_that_does_not_exist_is_found) {
    const std::set<std::string> tests =
        tests_in({{"a_test.cpp", "TEST(A, b) {\nTEST_P(C, d) {\n// TEST(A, gone) {\n"}});
    const auto faults = [&](const std::string& list) { return faults_of(rows_of(list), tests).size(); };
    EXPECT_EQ(faults("### 1. One\nIt holds.\n- `A.b`\n- `C.d`\n"), 0u);
    EXPECT_EQ(faults("### 1. One\nIt holds.\n- `A.gone`\n"), 1u);
    EXPECT_EQ(faults("### D1. One\nIt holds.\n\n### D2. Two\nIt holds.\n- `A.b`\n"), 1u);
    EXPECT_EQ(faults("### 1. One\nIt holds. Missing.\n"), 0u);
    EXPECT_EQ(faults("### 1. One\nWhen a window exists: it holds.\n"), 0u);
    EXPECT_EQ(faults("### 1. One\nWhen a window exists: it holds.\n- `A.gone`\n"), 1u);
}

TEST(HardCaseList, rows_are_numbered_without_a_gap) {
    std::vector<std::string> expected, numbers;
    for (const auto& [letter, count] : {std::pair{"", 47}, std::pair{"B", 21}, std::pair{"D", 8},
                                        std::pair{"P", 17}, std::pair{"S", 7}, std::pair{"N", 4}}) {
        for (int i = 1; i <= count; ++i)
            expected.push_back(letter + std::to_string(i));
    }
    std::ranges::transform(our_rows(), std::back_inserter(numbers), &HardCaseRow::number);
    EXPECT_EQ(numbers, expected);
}

// The row that a test is named after, or nothing.
std::string row_named_by(const std::string& test) {
    const Pattern row(R"((\.row|^Row)0*([0-9]+)[_.])");
    const Pattern hole(R"(\.(hole|b)0*([0-9]+)_)");
    const Pattern continuity(R"(^Continuity\.d([0-9])_)");
    if (const auto found = row.find(test); !found.empty()) return found[2];
    if (const auto found = hole.find(test); !found.empty()) return "B" + found[2];
    if (const auto found = continuity.find(test); !found.empty()) return "D" + found[1];
    return "";
}

std::vector<std::string> unlisted(const std::vector<HardCaseRow>& rows, const std::set<std::string>& tests) {
    std::vector<std::string> faults;
    for (const std::string& test : tests) {
        const std::string number = row_named_by(test);
        const auto row = std::ranges::find(rows, number, &HardCaseRow::number);
        if (!number.empty() && (row == rows.end() || std::ranges::find(row->tests, test) == row->tests.end()))
            faults.push_back(test);
    }
    return faults;
}

TEST(HardCaseList, every_test_named_after_a_row_is_listed_in_it) {
    EXPECT_EQ(test::joined(unlisted(our_rows(), tests_in(test::source_files("tests", {"_test.cpp"})))), "");
}

TEST(HardCaseList, test_that_its_row_does_not_list_is_found) {
    const std::vector<HardCaseRow> rows = rows_of("### 2. Two\n- `A.row02_b`\n\n### B3. Three\n- `Row2.c`\n");
    EXPECT_EQ(unlisted(rows, {"A.row02_b", "A.other"}).size(), 0u);
    EXPECT_EQ(unlisted(rows, {"Row2.c"}).size(), 1u);
    EXPECT_EQ(unlisted(rows, {"A.hole03_d", "A.b04_e", "Continuity.d1_f"}).size(), 3u);
}

}  // namespace
}  // namespace voxilux

// Rules of the source text that no compiler checks.

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "support/source_tree.h"

namespace voxilux {
namespace {

using test::Pattern;
using test::SourceFile;

// Blocks that shaders both read and write, with the reason.
const std::map<std::string, std::string> kReadAndWritten = {
    {"Counters", "atomic counters"},
    {"Keys", "slots are claimed by atomics in one pass and emptied in another"},
    {"Samples",
     "each sample takes its number by an atomic, and the pass that empties slots reads what was in them"},
    {"Opens", "atomic counters"},
    {"Missed", "a list that grows by atomics"},
    {"Touched",
     "every writer of a frame writes the number of the frame; the pass that empties slots reads it"},
    {"PhotonHeads", "the store's length grows by atomics; the prefix sum adds the workgroups that it takes"},
    {"BucketCounts", "atomic counters"},
    {"WantedCells", "marks are set by atomics"},
    {"Starts", "one file holds how one pass writes them and another reads them"},
    {"States", "an invocation goes on from what it has written in the round before"},
    {"PhotonTotals", "sums that photons add to by atomics, and runs of photons one after the other"},
    {"MetTotals", "sums that runs of photons add to one after the other"},
    {"PixelRadii", "each pixel's radius shrinks from iteration to iteration; it belongs to one invocation"},
    {"BucketRunSums", "photon_scan turns them into prefix sums in place, in one workgroup"},
    {"Counts", "a probe that counts its invocations with atomics"},
    {"Unused", "a probe of reflection: a block that the shader never touches"},
};

std::vector<std::string> undeclared_access(const SourceFile& file) {
    const Pattern block(R"(layout\([^)]*\)(.*)\b(buffer|uimageBuffer)[ \t]+([A-Za-z_0-9]+))");
    const Pattern access(R"(\b(readonly|writeonly)\b)");
    std::vector<std::string> faults;
    for (const std::string& line : test::lines_of(file.text)) {
        const std::vector<std::string> found = block.find(line);
        if (!found.empty() && access.find(found[1]).empty() && !kReadAndWritten.contains(found[3]))
            faults.push_back(file.path + ": " + line);
    }
    return faults;
}

// Two places that somebody has to keep equal by hand.
std::vector<std::string> hand_kept_copies(const SourceFile& file) {
    const Pattern phrase("(must|should) match|in sync", REG_ICASE);
    std::vector<std::string> faults;
    for (const std::string& line : test::lines_of(file.text)) {
        if (!phrase.find(line).empty()) faults.push_back(file.path + ": " + line);
    }
    return faults;
}

// Library calls that throw, for which we have a form that cannot fail, and what to write instead.
std::vector<std::string> calls_that_throw(const SourceFile& file) {
    const Pattern print(R"(\b(fmt|std)::print(ln)?\()"), dump(R"(\.dump\()");
    std::vector<std::string> faults;
    for (const std::string& line : test::lines_of(file.text)) {
        if (!print.find(line).empty()) faults.push_back(file.path + ": print_result, print_message: " + line);
        if (!dump.find(line).empty() && file.path != "engine/base/json.h")
            faults.push_back(file.path + ": json_text: " + line);
    }
    return faults;
}

// The largest number of lines of a file.
std::size_t longest_file(const std::string& path) {
    if (path.starts_with("shaders/shared/")) return 250;
    return path.ends_with(".comp") ? 120 : 500;
}

std::vector<std::string> long_files(const std::vector<SourceFile>& files) {
    std::vector<std::string> faults;
    for (const SourceFile& file : files) {
        const std::size_t lines = test::lines_of(file.text).size();
        if (lines > longest_file(file.path))
            faults.push_back(file.path + " has " + std::to_string(lines) + " lines");
    }
    return faults;
}

// What the build requires: names in find_package, pkg_check_modules and find_program. QUIET marks what is
// optional.
std::set<std::string> wanted_by(const SourceFile& file) {
    const Pattern requests[] = {Pattern(R"(^ *find_package\(([A-Za-z_0-9]+))"),
                                Pattern(R"(^ *pkg_check_modules\(.*[ ]([A-Za-z_0-9.+-]+)\))"),
                                Pattern(R"(^ *find_program\([A-Za-z_0-9]+ +([A-Za-z_0-9.+-]+))")};
    std::set<std::string> names;
    for (const std::string& line : test::lines_of(file.text)) {
        if (line.find(" QUIET)") != std::string::npos) continue;
        for (const Pattern& request : requests) {
            const std::vector<std::string> found = request.find(line);
            if (!found.empty()) names.insert(found[1]);
        }
    }
    return names;
}

// The third and later columns of setup/packages.txt: the names that a package provides.
std::set<std::string> provided_by(const std::string& packages) {
    std::set<std::string> names;
    for (const std::string& line : test::lines_of(packages)) {
        if (line.starts_with("#")) continue;
        std::istringstream words(line);
        std::string word;
        for (int column = 0; words >> word; ++column) {
            if (column >= 2) names.insert(word);
        }
    }
    return names;
}

std::vector<std::string> unprovided(const std::vector<SourceFile>& files, const std::string& packages) {
    const std::set<std::string> provided = provided_by(packages);
    std::vector<std::string> faults;
    for (const SourceFile& file : files) {
        for (const std::string& name : wanted_by(file)) {
            if (name != "Threads" && !provided.contains(name))  // Threads is the C library
                faults.push_back(file.path + " wants " + name);
        }
    }
    return faults;
}

// Tests that need the shared data, but do not have External in their suite name.
std::vector<std::string> unnamed_externals(const SourceFile& file) {
    const Pattern head(R"(^TEST(_[FP])?\(([A-Za-z0-9_]+),)");
    const Pattern skip("^ *SKIP_WITHOUT_");
    std::vector<std::string> faults;
    std::string suite;
    for (const std::string& line : test::lines_of(file.text)) {
        if (const auto found = head.find(line); !found.empty()) suite = found[2];
        if (!skip.find(line).empty() && !suite.empty() && suite.find("External") == std::string::npos)
            faults.push_back(file.path + ": " + suite);
    }
    return faults;
}

TEST(ShaderBlocks, each_is_readonly_or_writeonly_or_has_a_reason) {
    const std::vector<SourceFile> files = test::source_files("shaders", {".comp", ".glsl", ".h"});
    ASSERT_GT(files.size(), 20u);
    for (const SourceFile& file : files)
        EXPECT_EQ(test::joined(undeclared_access(file)), "");
}

TEST(ShaderBlocks, block_without_access_is_found) {
    EXPECT_EQ(undeclared_access({"a.comp", "layout(scalar) readonly buffer A {\n"}).size(), 0u);
    EXPECT_EQ(undeclared_access({"a.comp", "layout(scalar) buffer Counters {\n"}).size(), 0u);
    EXPECT_EQ(undeclared_access({"a.comp", "layout(scalar) buffer A {\n"}).size(), 1u);
    EXPECT_EQ(undeclared_access({"a.comp", "layout(scalar) buffer A { uint readonly_words[]; };\n"}).size(),
              1u);
    EXPECT_EQ(undeclared_access({"a.comp", "layout(scalar) coherent buffer A\n{\n"}).size(), 1u);
}

TEST(SourceText, nothing_is_kept_equal_by_hand) {
    for (const SourceFile& file : test::all_code()) {
        if (file.path.ends_with("source_rules_test.cpp")) continue;  // it names the phrases
        EXPECT_EQ(test::joined(hand_kept_copies(file)), "");
    }
}

TEST(SourceText, copy_kept_by_hand_is_found) {
    EXPECT_EQ(hand_kept_copies({"a.h", "// Must match gpu_types.h\n"}).size(), 1u);
    EXPECT_EQ(hand_kept_copies({"a.h", "// keep in sync with the shader\n"}).size(), 1u);
    EXPECT_EQ(hand_kept_copies({"a.h", "// the matching state\n"}).size(), 0u);
}

TEST(SourceText, what_is_printed_and_written_as_json_cannot_throw) {
    for (const char* folder : {"engine", "tools", "voxelizer"}) {
        for (const SourceFile& file : test::source_files(folder, {".cpp", ".h"}))
            EXPECT_EQ(test::joined(calls_that_throw(file)), "");
    }
}

TEST(SourceText, call_that_throws_is_found) {
    EXPECT_EQ(calls_that_throw({"a.cpp", "    fmt::print(stderr, \"a\");\n"}).size(), 1u);
    EXPECT_EQ(calls_that_throw({"a.cpp", "    text = json.dump();\n"}).size(), 1u);
    EXPECT_EQ(calls_that_throw({"a.cpp", "    print_result(\"a\");\n"}).size(), 0u);
}

TEST(SourceText, files_stay_short) {
    EXPECT_EQ(test::joined(long_files(test::all_code())), "");
}

TEST(SourceText, long_file_is_found) {
    const auto lines = [](std::size_t count) { return std::string(count, '\n'); };
    EXPECT_EQ(long_files({{"engine/a.cpp", lines(500)}, {"shaders/shared/a.h", lines(250)}}).size(), 0u);
    EXPECT_EQ(long_files({{"engine/a.cpp", lines(501)}, {"shaders/shared/a.h", lines(251)}}).size(), 2u);
    EXPECT_EQ(long_files({{"shaders/passes/a.comp", lines(121)}}).size(), 1u);
}

TEST(SourceText, tests_of_shared_data_are_external) {
    for (const SourceFile& file : test::source_files("tests", {"_test.cpp"}))
        EXPECT_EQ(test::joined(unnamed_externals(file)), "");
}

TEST(SourceText, test_of_shared_data_without_the_name_is_found) {
    const std::string skip = ", b) {\n    SKIP_WITHOUT_SHARED_DATA();\n";
    EXPECT_EQ(unnamed_externals({"a_test.cpp", "TEST(AExternal" + skip}).size(), 0u);
    EXPECT_EQ(unnamed_externals({"a_test.cpp", "TEST_P(AExternalNightly" + skip}).size(), 0u);
    EXPECT_EQ(unnamed_externals({"a_test.cpp", "TEST(AExternal" + skip + "TEST(A" + skip}).size(), 1u);
}

TEST(Packages, everything_the_build_looks_for_is_installed) {
    const std::string packages = test::read_text(VX_SOURCE_DIR "/setup/packages.txt");
    EXPECT_EQ(test::joined(unprovided(test::all_code(), packages)), "");
}

TEST(Packages, request_without_a_package_is_found) {
    const std::string packages =
        "# libghost-dev picture ghost\nlibfmt-dev picture fmt\nlibstb-dev picture stb\n";
    const auto missing = [&](const std::string& line) {
        return unprovided({{"CMakeLists.txt", line}}, packages).size();
    };
    EXPECT_EQ(missing("find_package(fmt REQUIRED)\n"), 0u);
    EXPECT_EQ(missing("find_package(ghost REQUIRED)\n"), 1u);
    EXPECT_EQ(missing("  pkg_check_modules(STB REQUIRED IMPORTED_TARGET stb)\n"), 0u);
    EXPECT_EQ(missing("pkg_check_modules(XXHASH REQUIRED IMPORTED_TARGET libxxhash)\n"), 1u);
    EXPECT_EQ(missing("find_program(GLSLANG glslangValidator REQUIRED)\n"), 1u);
    EXPECT_EQ(missing("find_package(ghost 3 QUIET)\n"), 0u);
}

}  // namespace
}  // namespace voxilux

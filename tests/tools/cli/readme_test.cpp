// What the documents say about the command, against the command.

#include <gtest/gtest.h>

#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "support/source_tree.h"
#include "tools/cli/child_process.h"

namespace voxilux::test {
namespace {

constexpr const char* kIndent = "    ";

std::string document(const std::string& name) {
    return read_text(VX_SOURCE_DIR "/docs/" + name);
}

// An indented block "$ voxilux ..." and the output below it.
struct Example {
    std::vector<std::string> arguments;
    std::string output;
};

std::vector<Example> examples_of(const std::string& text, const std::string& subcommand) {
    std::vector<Example> examples;
    bool inside = false;
    for (const std::string& line : lines_of(text)) {
        if (line.starts_with(kIndent + ("$ voxilux " + subcommand + " "))) {
            inside = true;
            std::istringstream words(line);
            Example example;
            for (std::string word; words >> word;)
                example.arguments.push_back(word);
            example.arguments.erase(example.arguments.begin(), example.arguments.begin() + 2);
            examples.push_back(example);
        } else if (inside && line.starts_with(kIndent)) {
            examples.back().output += line.substr(std::string(kIndent).size()) + "\n";
        } else {
            inside = false;
        }
    }
    return examples;
}

// The words "--flag" of a text.
std::set<std::string> flags_in(const std::string& text) {
    const Pattern flag("(^|[^a-z-])(--[a-z][a-z-]*)");
    std::set<std::string> flags;
    for (std::string rest : lines_of(text)) {
        for (auto found = flag.find(rest); !found.empty(); found = flag.find(rest)) {
            flags.insert(found[2]);
            rest = rest.substr(rest.find(found[2]) + found[2].size());
        }
    }
    return flags;
}

std::set<std::string> real_flags() {
    return flags_in(run({"generate", "bash"}).out);  // which offers all of them
}

std::vector<std::string> invented_flags(const std::string& usage, const std::set<std::string>& real) {
    std::vector<std::string> invented;
    for (const std::string& flag : flags_in(usage)) {
        if (!real.contains(flag)) invented.push_back(flag);
    }
    return invented;
}

TEST(Documents, plan_is_the_real_one) {
    const std::vector<Example> examples = examples_of(document("commands.md"), "plan");
    ASSERT_EQ(examples.size(), 1u);
    const Ending ending = run(examples[0].arguments, {.folder = VX_SOURCE_DIR});
    EXPECT_EQ(ending.code, 0) << ending.err;
    EXPECT_EQ(examples[0].output, ending.out);
}

TEST(Documents, example_ends_where_its_block_ends) {
    const std::vector<Example> examples =
        examples_of("    $ voxilux plan a.toml -o a.exr\n    one\n      two\n\nthree\n    four\n", "plan");
    ASSERT_EQ(examples.size(), 1u);
    EXPECT_EQ(examples[0].arguments, (std::vector<std::string>{"plan", "a.toml", "-o", "a.exr"}));
    EXPECT_EQ(examples[0].output, "one\n  two\n");
}

TEST(Documents, flags_of_the_usage_exist) {
    const std::string commands = document("commands.md");
    ASSERT_GT(flags_in(commands).size(), 50u);
    EXPECT_EQ(joined(invented_flags(commands + document("window.md"), real_flags())), "");
}

TEST(Documents, flag_that_does_not_exist_is_found) {
    const std::string usage = "| `--size WxH`, `--sizes` | and (`--progress=never`) | --no-such-flag\n";
    EXPECT_EQ(invented_flags(usage, {"--size", "--progress"}),
              (std::vector<std::string>{"--no-such-flag", "--sizes"}));
}

}  // namespace
}  // namespace voxilux::test

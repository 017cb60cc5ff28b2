// Which room may include which. The rooms and their order are the table of engine/README.md; above them are
// the voxelizer and the tools.

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "support/source_tree.h"

namespace voxilux {
namespace {

using test::Pattern;
using test::SourceFile;
using Rooms = std::vector<std::string>;

// First cells of the table whose head starts with "| room |".
Rooms rooms_of(const std::string& readme) {
    const Pattern row(R"(^\| `([a-z_]+)` \|)");
    Rooms rooms;
    bool inside = false;
    for (const std::string& line : test::lines_of(readme)) {
        inside = line.starts_with("| room |") || (inside && line.starts_with("|"));
        const std::vector<std::string> found = row.find(line);
        if (inside && !found.empty()) rooms.push_back(found[1]);
    }
    return rooms;
}

struct Include {
    std::string target;
    bool quoted = false;
};

std::vector<Include> includes_of(const SourceFile& file) {
    const Pattern directive(R"(^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+))");
    std::vector<Include> includes;
    for (const std::string& line : test::lines_of(file.text)) {
        const std::vector<std::string> found = directive.find(line);
        if (!found.empty()) includes.push_back({found[2], found[1] == "\""});
    }
    return includes;
}

std::string first_folder(const std::string& path) {
    const std::size_t slash = path.find('/');
    return slash == std::string::npos ? "" : path.substr(0, slash);
}

// The room of "engine/<room>/...", or nothing.
std::string room_of(const std::string& path) {
    const std::string prefix = "engine/";
    return path.starts_with(prefix) ? first_folder(path.substr(prefix.size())) : "";
}

bool may_include(const Rooms& rooms, const std::string& room, const Include& include) {
    const std::string folder = first_folder(include.target);
    if (!include.quoted || folder == "shared" || include.target == "embedded.h") return true;
    const auto own = std::ranges::find(rooms, room);
    const auto other = std::ranges::find(rooms, folder);
    return own != rooms.end() && other != rooms.end() && other <= own;
}

std::vector<std::string> wrong_room_includes(const Rooms& rooms, const std::vector<SourceFile>& files) {
    std::vector<std::string> faults;
    for (const SourceFile& file : files) {
        for (const Include& include : includes_of(file)) {
            if (!may_include(rooms, room_of(file.path), include))
                faults.push_back(file.path + " includes " + include.target);
        }
    }
    return faults;
}

std::vector<std::string> vulkan_includes_outside_vk(const std::vector<SourceFile>& files) {
    const Pattern vulkan(R"((^|/)(vulkan/|vk_mem_alloc\.h|volk\.h))");
    std::vector<std::string> faults;
    for (const SourceFile& file : files) {
        for (const Include& include : includes_of(file)) {
            if (room_of(file.path) != "vk" && !vulkan.find(include.target).empty())
                faults.push_back(file.path + " includes " + include.target);
        }
    }
    return faults;
}

Rooms our_rooms() {
    return rooms_of(test::read_text(VX_SOURCE_DIR "/engine/README.md"));
}

const Rooms kThree = {"base", "scene", "vk"};

TEST(Rooms, table_of_the_readme_lists_every_folder_once) {
    const Rooms rooms = our_rooms();
    std::set<std::string> folders;
    for (const auto& entry : std::filesystem::directory_iterator(VX_SOURCE_DIR "/engine")) {
        if (entry.is_directory()) folders.insert(entry.path().filename().string());
    }
    EXPECT_EQ(std::set<std::string>(rooms.begin(), rooms.end()), folders);
    EXPECT_EQ(rooms.size(), folders.size());
}

TEST(Rooms, room_includes_only_itself_and_rooms_above) {
    const std::vector<SourceFile> files = test::source_files("engine", {".h", ".cpp"});
    ASSERT_GT(files.size(), 50u);
    EXPECT_EQ(test::joined(wrong_room_includes(our_rooms(), files)), "");
}

TEST(Rooms, include_of_a_room_below_is_found) {
    const SourceFile up{"engine/vk/device.cpp", "#include \"base/error.h\"\n#include \"vk/device.h\"\n"};
    const SourceFile down{"engine/scene/scene.cpp", "#include <vector>\n  #  include \"vk/device.h\"\n"};
    const SourceFile tool{"engine/base/file.h", "#include \"render/render.h\"\n"};
    const SourceFile bare{"engine/base/file.h", "#include \"file.h\"\n"};
    EXPECT_EQ(wrong_room_includes(kThree, {up}).size(), 0u);
    EXPECT_EQ(wrong_room_includes(kThree, {down}).size(), 1u);
    EXPECT_EQ(wrong_room_includes(kThree, {tool}).size(), 1u);
    EXPECT_EQ(wrong_room_includes(kThree, {bare}).size(), 1u);
}

TEST(Rooms, shared_headers_may_be_included_anywhere) {
    const SourceFile file{"engine/scene/scene.cpp", "#include \"shared/limits.h\"\n"};
    EXPECT_EQ(wrong_room_includes(kThree, {file}).size(), 0u);
}

TEST(Rooms, only_vk_includes_vulkan) {
    EXPECT_EQ(test::joined(vulkan_includes_outside_vk(test::all_code())), "");
}

TEST(Rooms, vulkan_header_outside_vk_is_found) {
    for (const char* header :
         {"<vulkan/vulkan.h>", "<volk.h>", "\"vulkan/vulkan_core.h\"", "<vk_mem_alloc.h>"}) {
        const std::string text = std::string("#include ") + header + "\n";
        EXPECT_EQ(vulkan_includes_outside_vk({{"engine/vk/check.h", text}}).size(), 0u) << header;
        EXPECT_EQ(vulkan_includes_outside_vk({{"engine/film/film.h", text}}).size(), 1u) << header;
        EXPECT_EQ(vulkan_includes_outside_vk({{"tests/device/probe/a_test.cpp", text}}).size(), 1u) << header;
    }
}

// What the voxelizer may include of the engine: it knows meshes and files, and nothing that renders.
const Rooms kVoxelizerRooms = {"base", "scene", "formats", "estimators"};

std::vector<std::string> wrong_voxelizer_includes(const std::vector<SourceFile>& files) {
    std::vector<std::string> faults;
    for (const SourceFile& file : files) {
        for (const Include& include : includes_of(file)) {
            const std::string folder = first_folder(include.target);
            const bool may = !include.quoted || folder == "voxelizer" || folder == "shared" ||
                             std::ranges::find(kVoxelizerRooms, folder) != kVoxelizerRooms.end();
            if (!may) faults.push_back(file.path + " includes " + include.target);
        }
    }
    return faults;
}

// Folders of tools that other subcommands may include: plan takes the flags of render.
const Rooms kSharedTools = {"render"};

// A subcommand includes its own folder, what all share at the top of tools/, the engine and the voxelizer. Of
// the files at the top, only the command line, which lists the subcommands, includes their folders; the
// Python module calls them.
bool may_tool_include(const Rooms& rooms, const std::string& path, const Include& include) {
    const std::string folder = first_folder(include.target);
    if (!include.quoted || folder.empty() || folder == "voxelizer" || folder == "shared" ||
        path == "tools/command_line.cpp" || path.starts_with("tools/python/"))
        return true;
    const bool is_room = std::ranges::find(rooms, folder) != rooms.end();
    const bool is_other_tool = std::filesystem::exists(VX_SOURCE_DIR "/tools/" + include.target);
    if (is_room && !is_other_tool) return true;
    const std::string own = first_folder(path.substr(std::string("tools/").size()));
    const bool is_shared = std::ranges::find(kSharedTools, folder) != kSharedTools.end();
    return !own.empty() && (folder == own || is_shared);
}

std::vector<std::string> wrong_tool_includes(const Rooms& rooms, const std::vector<SourceFile>& files) {
    std::vector<std::string> faults;
    for (const SourceFile& file : files) {
        for (const Include& include : includes_of(file)) {
            if (!may_tool_include(rooms, file.path, include))
                faults.push_back(file.path + " includes " + include.target);
        }
    }
    return faults;
}

// The parser of command lines takes ten seconds to compile.
const std::vector<std::string> kMayParse = {"tools/command_line.cpp", "tools/flags.cpp",
                                            "tools/manual/command_tree.cpp"};

std::vector<std::string> wrong_parser_includes(const std::vector<SourceFile>& files) {
    std::vector<std::string> faults;
    for (const SourceFile& file : files) {
        const bool may =
            file.path.starts_with("tests/") || std::ranges::find(kMayParse, file.path) != kMayParse.end();
        for (const Include& include : includes_of(file)) {
            if (!may && include.target.starts_with("CLI/"))
                faults.push_back(file.path + " includes " + include.target);
        }
    }
    return faults;
}

TEST(Rooms, voxelizer_includes_nothing_that_renders) {
    const std::vector<SourceFile> files = test::source_files("voxelizer", {".h", ".cpp"});
    ASSERT_GT(files.size(), 20u);
    EXPECT_EQ(test::joined(wrong_voxelizer_includes(files)), "");
}

TEST(Rooms, voxelizer_that_includes_a_plan_or_a_tool_is_found) {
    const std::string path = "voxelizer/mesh.h";
    for (const char* target :
         {"plan/render_plan.h", "jobs/report.h", "progress_line.h", "voxelize/voxelize.h"})
        EXPECT_EQ(wrong_voxelizer_includes({{path, std::string("#include \"") + target + "\"\n"}}).size(), 1u)
            << target;
    EXPECT_EQ(wrong_voxelizer_includes({{path, "#include \"base/error.h\"\n#include <vector>\n"}}).size(),
              0u);
}

TEST(Rooms, tool_includes_no_other_tool) {
    const std::vector<SourceFile> files = test::source_files("tools", {".h", ".cpp"});
    ASSERT_GT(files.size(), 30u);
    EXPECT_EQ(test::joined(wrong_tool_includes(our_rooms(), files)), "");
}

TEST(Rooms, tool_that_includes_another_tool_is_found) {
    const Rooms rooms = our_rooms();
    const auto faults = [&](const char* path, const std::string& target) {
        return wrong_tool_includes(rooms, {{path, "#include \"" + target + "\"\n"}}).size();
    };
    EXPECT_EQ(faults("tools/merge/merge.cpp", "compare/compare.h"), 1u);
    EXPECT_EQ(faults("tools/merge/merge.cpp", "plan/plan.h"), 1u) << "plan is a room and a tool";
    EXPECT_EQ(faults("tools/shared_flags.cpp", "render/render.h"), 1u);
    EXPECT_EQ(faults("tools/merge/merge.cpp", "merge/merge.h"), 0u);
    EXPECT_EQ(faults("tools/plan/plan.cpp", "render/render.h"), 0u);
    EXPECT_EQ(faults("tools/merge/merge.cpp", "plan/render_plan.h"), 0u);
    EXPECT_EQ(faults("tools/merge/merge.cpp", "shared_flags.h"), 0u);
    EXPECT_EQ(faults("tools/command_line.cpp", "compare/compare.h"), 0u);
    EXPECT_EQ(faults("tools/python/module.cpp", "compare/compare.h"), 0u);
}

TEST(Rooms, parser_of_command_lines_is_included_in_three_places) {
    std::vector<SourceFile> files = test::all_code();
    std::ranges::move(test::source_files("voxelizer", {".h", ".cpp"}), std::back_inserter(files));
    EXPECT_EQ(test::joined(wrong_parser_includes(files)), "");
}

TEST(Rooms, parser_elsewhere_is_found) {
    const std::string text = "#include <CLI/CLI.hpp>\n";
    for (const char* path : {"engine/jobs/report.h", "voxelizer/mesh.h", "tools/render/render_flags.cpp"})
        EXPECT_EQ(wrong_parser_includes({{path, text}}).size(), 1u) << path;
    EXPECT_EQ(wrong_parser_includes({{"tools/flags.cpp", text}}).size(), 0u);
}

TEST(Rooms, rows_outside_the_table_are_no_rooms) {
    const std::string readme =
        "| `no` | x |\n\n| room | what |\n|---|---|\n| `a` | x |\n| `b` | `c` |\n\n| `d` | x |\n";
    EXPECT_EQ(rooms_of(readme), (Rooms{"a", "b"}));
}

}  // namespace
}  // namespace voxilux

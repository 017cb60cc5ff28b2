// Who may include whom. The rooms and their order are the table of engine/README.md.

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

TEST(Rooms, rows_outside_the_table_are_no_rooms) {
    const std::string readme =
        "| `no` | x |\n\n| room | what |\n|---|---|\n| `a` | x |\n| `b` | `c` |\n\n| `d` | x |\n";
    EXPECT_EQ(rooms_of(readme), (Rooms{"a", "b"}));
}

}  // namespace
}  // namespace voxilux

#include <gtest/gtest.h>

#include "formats/vox_read.h"
#include "formats/vox_write.h"
#include "scene/vox_file.h"
#include "support/vox_builder.h"

namespace voxilux {
namespace {

using namespace vox_builder;

std::string text_of_file(const std::vector<std::byte>& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

VoxFile read_written(std::span<const std::byte> bytes) {
    auto file = read_vox(bytes);
    EXPECT_TRUE(file) << (file ? "" : file.reason());
    return file ? file.value() : VoxFile{};
}

TEST(VoxWrite, rich_file_reads_back_equal) {
    const VoxFile file = read_written(bytes_of(rich_file_text()));
    const VoxFile again = read_written(write_vox(file));
    EXPECT_TRUE(again.nodes == file.nodes);
    EXPECT_TRUE(again.unknown == file.unknown);
    VoxFile expected = file;
    expected.warnings = again.warnings;  // warnings name bytes, and the order of the chunks may differ
    EXPECT_TRUE(again == expected);
    EXPECT_EQ(write_vox(again), write_vox(file));
}

// Negative control: the equality above fails for a change in any part of the file.
TEST(VoxWrite, comparison_sees_a_change_in_each_part) {
    const VoxFile file = read_written(bytes_of(rich_file_text()));
    void (*const changes[])(VoxFile&) = {
        [](VoxFile& f) { f.version = 150; },
        [](VoxFile& f) { f.pack = 2; },
        [](VoxFile& f) { f.models[0].voxels[0].index = 9; },
        [](VoxFile& f) { std::get<VoxTransform>(f.nodes[2]).frames[0][1].second = "5 -6 8"; },
        [](VoxFile& f) { std::get<VoxGroup>(f.nodes[1]).children[0] = 4; },
        [](VoxFile& f) { std::get<VoxShape>(f.nodes[3]).models[0].model = 1; },
        [](VoxFile& f) { f.layers[0].id = 5; },
        [](VoxFile& f) { ++f.palette[255].a; },
        [](VoxFile& f) { (*f.imap)[3] = 0; },
        [](VoxFile& f) { f.materials[0].attributes[0].second = "_glass"; },
        [](VoxFile& f) { f.old_materials[0].values[0] = 0.75f; },
        [](VoxFile& f) { f.cameras.clear(); },
        [](VoxFile& f) { f.objects[0].pop_back(); },
        [](VoxFile& f) { f.notes->push_back("x"); },
        [](VoxFile& f) { f.meta.reset(); },
        [](VoxFile& f) { f.unknown[0].content.pop_back(); },
    };
    for (const auto change : changes) {
        VoxFile changed = file;
        change(changed);
        EXPECT_FALSE(changed == file);
        VoxFile again = read_written(write_vox(changed));
        again.warnings = changed.warnings;
        EXPECT_TRUE(again == changed);
    }
}

// The builder writes by hand what the published format says, in MagicaVoxel's order.
TEST(VoxWrite, bytes_equal_the_published_layout) {
    VoxFile file;
    file.version = 200;
    file.models.push_back({.size = {2, 3, 4}, .voxels = {{0, 1, 2, 3}, {1, 2, 3, 255}}});
    file.nodes = {
        VoxTransform{.id = 0, .attributes = {{"_name", "root"}}, .child = 1, .layer = -1, .frames = {{}}},
        VoxGroup{.id = 1, .children = {2}},
        VoxTransform{.id = 2, .child = 3, .layer = 0, .frames = {{{"_t", "1 2 3"}}}},
        VoxShape{.id = 3, .models = {{.model = 0}}}};
    file.layers.push_back({.id = 0, .attributes = {{"_name", "a"}}});
    file.has_palette = true;
    file.palette.fill({1, 2, 3, 4});
    file.materials.push_back({.id = 3, .attributes = {{"_type", "_metal"}}});
    std::string rgba;
    for (int i = 0; i < 256; ++i)
        rgba += "\1\2\3\4";
    const std::string chunks = size_chunk(2, 3, 4) + voxels_chunk({{0, 1, 2, 3}, {1, 2, 3, 255}}) +
                               transform(0, 1, -1, {{}}, {{"_name", "root"}}) + group(1, {2}) +
                               transform(2, 3, 0, {{{"_t", "1 2 3"}}}) + shape(3, {{0, {}}}) +
                               layer(0, {{"_name", "a"}}) + chunk("RGBA", rgba) +
                               record("MATL", 3, {{"_type", "_metal"}});
    EXPECT_EQ(text_of_file(write_vox(file)), file_text(chunks, 200));
}

TEST(VoxWrite, default_palette_is_left_out_and_any_other_is_1024_bytes) {
    VoxFile file;
    file.models.push_back({.size = {1, 1, 1}, .voxels = {{0, 0, 0, 1}}});
    EXPECT_EQ(text_of_file(write_vox(file)).find("RGBA"), std::string::npos);
    file.palette[3] = {9, 9, 9, 9};
    const std::string text = text_of_file(write_vox(file));
    const std::size_t at = text.find("RGBA");
    ASSERT_NE(at, std::string::npos);
    EXPECT_EQ(text.substr(at + 4, 8), u32(1024) + u32(0));
}

}  // namespace
}  // namespace voxilux

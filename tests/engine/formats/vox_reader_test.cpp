#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "formats/vox_read.h"
#include "scene/vox_cells.h"
#include "scene/vox_file.h"
#include "support/vox_builder.h"

namespace voxilux {
namespace {

using namespace vox_builder;

VoxFile read_good(const std::string& chunks) {
    auto file = read_vox(vox_builder::file(chunks));
    EXPECT_TRUE(file) << (file ? "" : file.reason());
    return file ? file.value() : VoxFile{};
}

std::string vox_refusal(std::string_view text) {
    const auto file = read_vox(bytes_of(text));
    return file ? "loaded" : file.reason();
}

TEST(VoxReader, rich_file_gives_every_chunk_as_stored) {
    const auto result = read_vox(bytes_of(rich_file_text()));
    ASSERT_TRUE(result) << result.reason();
    const VoxFile& file = result.value();
    EXPECT_EQ(file.version, 200);
    ASSERT_EQ(file.models.size(), 2u);
    EXPECT_EQ(file.models[0].size, glm::ivec3(3, 4, 5));
    EXPECT_EQ(file.models[0].voxels[2], (VoxVoxel{0, 3, 0, 3}));
    EXPECT_EQ(file.models[1].duplicates, 1u);
    ASSERT_EQ(file.nodes.size(), 7u);
    const auto& first = std::get<VoxTransform>(file.nodes[2]);
    EXPECT_EQ(first.child, 3);
    EXPECT_EQ(first.frames[1], (VoxDict{{"_f", "10"}, {"_r", "40"}, {"_t", "1 2 3"}}));
    EXPECT_EQ(std::get<VoxGroup>(file.nodes[1]).children, (std::vector<std::int32_t>{2, 4, 6}));
    EXPECT_EQ(std::get<VoxShape>(file.nodes[3]).models[1].model, 1);
    ASSERT_EQ(file.layers.size(), 3u);
    EXPECT_EQ(*find_value(file.layers[1].attributes, "_hidden"), "1");
    EXPECT_TRUE(file.has_palette);
    EXPECT_EQ(colour_of(file, 1), (VoxColour{0, 255, 0, 255}));
    EXPECT_EQ(colour_of(file, 255), (VoxColour{254, 1, 254 * 7 % 256, 255}));
    ASSERT_TRUE(file.imap);
    EXPECT_EQ((*file.imap)[0], 255);
    EXPECT_EQ(file.materials.size(), 6u);
    ASSERT_EQ(file.old_materials.size(), 1u);
    EXPECT_EQ(file.old_materials[0].values, (std::vector<float>{0.25f, 0.5f}));
    EXPECT_EQ(file.cameras.size(), 1u);
    EXPECT_EQ(file.objects.size(), 1u);
    EXPECT_EQ(*file.notes, (std::vector<std::string>{"rock", ""}));
    EXPECT_EQ(*file.meta, (VoxDict{{"_anim_range", "0 30"}}));
    ASSERT_EQ(file.unknown.size(), 2u);
    EXPECT_EQ(file.unknown[0].content.size(), 8u);
    EXPECT_FALSE(file.unknown[0].children.empty());
}

// Entries of the table that the format publishes (0xAABBGGRR there), at its corners.
TEST(VoxReader, absent_palette_is_the_published_one) {
    const VoxFile file = read_good(chiral_model(2, 2, 2));
    EXPECT_FALSE(file.has_palette);
    const std::pair<int, VoxColour> published[] = {
        {1, {0xff, 0xff, 0xff, 0xff}},   {2, {0xff, 0xff, 0xcc, 0xff}},   {7, {0xff, 0xcc, 0xff, 0xff}},
        {37, {0xcc, 0xff, 0xff, 0xff}},  {215, {0x00, 0x00, 0x33, 0xff}}, {216, {0xee, 0x00, 0x00, 0xff}},
        {225, {0x11, 0x00, 0x00, 0xff}}, {226, {0x00, 0xee, 0x00, 0xff}}, {236, {0x00, 0x00, 0xee, 0xff}},
        {246, {0xee, 0xee, 0xee, 0xff}}, {255, {0x11, 0x11, 0x11, 0xff}}};
    for (const auto& [index, colour] : published)
        EXPECT_EQ(colour_of(file, static_cast<std::uint8_t>(index)), colour) << index;
}

TEST(VoxReader, short_palette_is_padded_with_a_warning) {
    const VoxFile file = read_good(chiral_model(2, 2, 2) + chunk("RGBA", "abcdefg"));
    EXPECT_EQ(colour_of(file, 1), (VoxColour{'a', 'b', 'c', 'd'}));
    EXPECT_EQ(colour_of(file, 2), (VoxColour{'e', 'f', 'g', 0}));
    EXPECT_EQ(colour_of(file, 3), VoxColour{});
    ASSERT_EQ(file.warnings.size(), 1u);
    EXPECT_NE(file.warnings[0].find("RGBA has 7 bytes, not 1024"), std::string::npos);
}

TEST(VoxReader, last_duplicate_wins_and_index_0_erases) {
    const VoxFile file = read_good(
        size_chunk(2, 2, 2) +
        voxels_chunk({{0, 0, 0, 5}, {1, 0, 0, 6}, {0, 0, 0, 7}, {1, 0, 0, 0}, {1, 1, 1, 8}, {2, 0, 0, 9}}));
    EXPECT_EQ(file.models[0].duplicates, 2u);
    EXPECT_EQ(file.models[0].index0, 1u);
    EXPECT_EQ(file.models[0].out_of_size, 1u);
    VoxCells cells;
    for (int again = 0; again < 2; ++again) {  // the set must not keep what it has seen
        EXPECT_EQ(filled_voxels(file.models[0], cells), (std::vector<VoxVoxel>{{0, 0, 0, 7}, {1, 1, 1, 8}}));
    }
}

TEST(VoxReader, sides_from_1_to_256_are_read) {
    const VoxFile file = read_good(size_chunk(256, 1, 256) + voxels_chunk({{255, 0, 255, 1}}));
    EXPECT_EQ(file.models[0].out_of_size, 0u);
    EXPECT_TRUE(file.warnings.empty());
}

TEST(VoxReader, repeated_key_gives_its_last_value) {
    const VoxDict dict = {{"_name", "a"}, {"_t", "1 2 3"}, {"_name", "b"}};
    EXPECT_EQ(*find_value(dict, "_name"), "b");
    EXPECT_EQ(find_value(dict, "_r"), nullptr);
}

TEST(VoxReader, unfinite_old_material_is_repaired_with_a_warning) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float inf = std::numeric_limits<float>::infinity();
    const VoxFile file =
        read_good(chiral_model(2, 2, 2) + chunk("MATT", i32(1) + i32(3) + f32(inf) + u32(2) + f32(nan)));
    EXPECT_EQ(file.old_materials[0].weight, 0.0f);
    EXPECT_EQ(file.old_materials[0].values, std::vector<float>{0.0f});
    EXPECT_EQ(file.warnings.size(), 2u);
}

TEST(VoxReader, warnings_are_bounded_and_the_rest_counted) {
    std::string chunks = chiral_model(2, 2, 2);
    for (int i = 0; i < 1000; ++i)
        chunks += chunk("IMAP", "");
    const VoxFile file = read_good(chunks);
    EXPECT_EQ(file.warnings.size(), kVoxMaxWarnings + 1);
    EXPECT_EQ(file.warnings.back(), fmt::format("and {} more warnings", 1000 - kVoxMaxWarnings));
}

// Models are looked at after all chunks are read; what is odd about them is told where they stand.
TEST(VoxReader, warnings_come_in_the_order_of_what_they_are_about) {
    const std::string odd = size_chunk(1, 1, 1) + voxels_chunk({{0, 0, 0, 1}, {0, 0, 0, 0}, {1, 0, 0, 2}});
    const std::string imap = chunk("IMAP", "");
    const VoxFile file = read_good(imap + odd + imap + imap + odd + imap);
    std::vector<std::string> told;
    for (const std::string& warning : file.warnings)
        told.push_back(warning.substr(warning.find(": ") + 2));
    const std::string ignored = "IMAP has 0 bytes, not 256: ignored";
    const auto of_model = [](int id) {
        return std::vector<std::string>{fmt::format("model {}: 1 voxels outside its size are ignored", id),
                                        fmt::format("model {}: 1 voxels replace earlier ones", id),
                                        fmt::format("model {}: 1 voxels have the empty index 0", id)};
    };
    std::vector<std::string> expected{ignored};
    std::ranges::copy(of_model(0), std::back_inserter(expected));
    expected.insert(expected.end(), 2, ignored);
    std::ranges::copy(of_model(1), std::back_inserter(expected));
    expected.push_back(ignored);
    EXPECT_EQ(told, expected);
}

TEST(VoxReader, warnings_of_models_count_among_those_that_are_kept) {
    const std::string odd = size_chunk(1, 1, 1) + voxels_chunk({{0, 0, 0, 0}});
    std::string chunks;
    for (int i = 0; i < 50; ++i)
        chunks += chunk("IMAP", "") + odd + chunk("IMAP", "");
    const VoxFile file = read_good(chunks);
    ASSERT_EQ(file.warnings.size(), kVoxMaxWarnings + 1);
    EXPECT_EQ(file.warnings.back(), fmt::format("and {} more warnings", 150 - kVoxMaxWarnings));
    for (std::size_t i = 0; i < kVoxMaxWarnings; ++i)
        EXPECT_EQ(file.warnings[i].find(fmt::format("model {}:", i / 3)) != std::string::npos, i % 3 == 1)
            << i;
}

struct RefusedVox {
    const char* name;
    std::string text;
    const char* reason;
};

// Offsets: the first chunk begins at byte 20, its content at 32; a chunk after SIZE begins at 44.
const std::string kModel = size_chunk(3, 3, 3) + voxels_chunk({{0, 0, 0, 1}});  // 44 bytes
const RefusedVox kRefused[] = {
    {"empty", "", "at byte 0: the file needs 4 bytes for its id but has 0 left"},
    {"wrong magic", "VOXX" + i32(150), "at byte 0: not a .vox file"},
    {"no MAIN", "VOX " + i32(150) + chunk("MAIM", ""), "at byte 8: the first chunk is not MAIN"},
    {"cut MAIN", "VOX " + i32(150) + "MAIN" + i32(0) + i32(100),
     "at byte 8: MAIN says 0 + 100 bytes but the file has 0"},
    {"negative MAIN", "VOX " + i32(150) + "MAIN" + i32(0) + i32(-1),
     "at byte 8: MAIN says 0 + 4294967295 bytes"},
    {"cut header", file_text("SIZE"), "at byte 24: MAIN needs 4 bytes for its content size but has 0 left"},
    {"long chunk", file_text("SIZE" + i32(99) + i32(0)),
     "at byte 20: 'SIZE' has 99 + 0 bytes where MAIN has 0 left"},
    {"long children", file_text("ABC\n" + i32(0) + i32(-1)),
     "at byte 20: 'ABC\\x0a' has 0 + 4294967295 bytes where"},
    {"short SIZE", file_text(chunk("SIZE", i32(1) + i32(1))),
     "at byte 40: SIZE needs 4 bytes for its side but has 0 left"},
    {"side 0", file_text(size_chunk(1, 0, 1)),
     "at byte 32: SIZE has a side of 0, which must be from 1 to 256"},
    {"side 257", file_text(size_chunk(1, 257, 1)), "at byte 32: SIZE has a side of 257"},
    {"side -1", file_text(size_chunk(1, 1, -1)), "at byte 32: SIZE has a side of -1"},
    {"XYZI first", file_text(voxels_chunk({{0, 0, 0, 1}})), "at byte 32: XYZI without a SIZE before it"},
    {"XYZI count", file_text(size_chunk(1, 1, 1) + chunk("XYZI", i32(1000000) + "abcdabcdabcd")),
     "at byte 56: XYZI holds 1000000 voxels but the chunk has room for 3"},
    {"XYZI negative", file_text(size_chunk(1, 1, 1) + chunk("XYZI", i32(-1))),
     "at byte 56: XYZI holds 4294967295 voxels"},
    {"text length", file_text(kModel + chunk("rOBJ", i32(1) + i32(-1) + i32(0))),
     "at byte 80: rOBJ holds 4294967295 bytes of text but the chunk has room for 4"},
    {"frames",
     file_text(kModel + chunk("nTRN", i32(0) + i32(0) + i32(1) + i32(-1) + i32(0) + i32(0x7fffffff))),
     "at byte 96: nTRN holds 2147483647 frames but the chunk has room for 0"},
    {"children", file_text(kModel + chunk("nGRP", i32(0) + i32(0) + i32(9))),
     "at byte 84: nGRP holds 9 children"},
    {"rotation column 3", file_text(kModel + transform(0, 1, -1, {{{"_r", "3"}}})),
     "at byte 100: node 0: rotation 3: rows"},
    {"rotation columns equal", file_text(kModel + transform(0, 1, -1, {{{"_r", "5"}}})),
     "at byte 100: node 0: rotation 5: rows 1 and 2 name columns 1 and 1, which must be two of 0, 1, 2"},
    {"rotation text", file_text(kModel + transform(0, 1, -1, {{{"_r", "x\1y"}}})),
     "node 0: rotation 'x\\x01y' is not a byte"},
    {"translation text", file_text(kModel + transform(0, 1, -1, {{{"_t", "1 two 3"}}})),
     "translation '1 two 3' is not three numbers"},
    {"translation short", file_text(kModel + transform(0, 1, -1, {{{"_t", "1 2"}}})),
     "translation '1 2' is not three numbers"},
    {"translation long", file_text(kModel + transform(0, 1, -1, {{{"_t", "1 2 3 4"}}})),
     "is not three numbers"},
    {"translation nan", file_text(kModel + transform(0, 1, -1, {{{"_t", "1 nan 3"}}})),
     "is beyond 268435456 voxels"},
    {"translation far", file_text(kModel + transform(0, 1, -1, {{{"_t", "1 2 1e30"}}})),
     "is beyond 268435456 voxels"},
    {"frame text", file_text(kModel + shape(0, {{0, {{"_f", "1.5"}}}})),
     "at byte 88: node 0: frame '1.5' is not a 32-bit integer"},
    {"id twice", file_text(kModel + transform(0, 1, -1, {{}}) + shape(1, {{0, {}}}) + group(1, {})),
     "at byte 136: node id 1 is used twice"},
    {"self", file_text(kModel + transform(0, 0, -1, {{}})),
     "at byte 64: node 0 is below itself: the scene graph has a cycle"},
    {"cycle", file_text(kModel + transform(0, 1, -1, {{}}) + group(1, {2}) + transform(2, 1, 0, {{}})),
     "at byte 104: node 1 is below itself"},
    {"notes", file_text(kModel + chunk("NOTE", i32(5) + i32(0))),
     "at byte 76: NOTE holds 5 notes but the chunk has room for 1"},
};

TEST(VoxReader, broken_rules_are_named_with_their_offset) {
    for (const RefusedVox& row : kRefused)
        EXPECT_NE(vox_refusal(row.text).find(row.reason), std::string::npos)
            << row.name << ": " << vox_refusal(row.text);
}

struct Repaired {
    const char* name;
    std::string chunks;
    const char* warning;
};

const Repaired kRepaired[] = {
    {"missing child", kModel + transform(0, 1, -1, {{}}) + group(1, {7}),
     "node 1 names node 7, which is absent"},
    {"missing model", kModel + transform(0, 1, -1, {{}}) + shape(1, {{1, {}}}),
     "node 1 shows model 1 of 1: skipped"},
    {"no root", kModel + transform(5, 1, -1, {{}}), "no node 0: nothing is placed"},
    {"two SIZE", size_chunk(2, 2, 2) + kModel, "at byte 56: the SIZE before has no XYZI"},
    {"lone SIZE", kModel + size_chunk(2, 2, 2), "the last SIZE has no XYZI"},
    {"PACK lies", chunk("PACK", i32(3)) + kModel, "PACK says 3 models, the file has 1"},
    {"nothing", "", "no models"},
    {"short MATT", kModel + chunk("MATT", i32(9) + i32(1) + f32(1) + u32(0x7f) + f32(1)),
     "MATT 9 has fewer values than property bits"},
    {"long RGBA", kModel + chunk("RGBA", std::string(1028, 'x')), "'RGBA' has 4 spare bytes"},
    {"children of SIZE", chunk("SIZE", i32(1) + i32(1) + i32(1), "abc") + voxels_chunk({}),
     "'SIZE' has 3 bytes of children"},
};

TEST(VoxReader, harmless_faults_load_with_one_warning) {
    for (const Repaired& row : kRepaired) {
        const VoxFile file = read_good(row.chunks);
        ASSERT_EQ(file.warnings.size(), 1u) << row.name;
        EXPECT_NE(file.warnings[0].find(row.warning), std::string::npos)
            << row.name << ": " << file.warnings[0];
        EXPECT_TRUE(file.warnings[0].starts_with("at byte ")) << row.name;
    }
}

TEST(VoxReader, bytes_after_main_and_other_versions_are_reported) {
    const auto trailing = read_vox(bytes_of(file_text(kModel) + "tail"));
    ASSERT_TRUE(trailing);
    EXPECT_EQ(trailing.value().warnings,
              std::vector<std::string>{"at byte 64: 4 bytes after MAIN are ignored"});
    const auto version = read_vox(vox_builder::file(kModel, 201));
    ASSERT_TRUE(version);
    EXPECT_EQ(version.value().warnings, std::vector<std::string>{"at byte 4: version 201 is not 150 or 200"});
}

}  // namespace
}  // namespace voxilux

// Readers of other voxel formats, with files whose cells are known, and with damaged files.

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <set>

#include "formats/block_looks.h"
#include "formats/voxel_cells.h"
#include "support/allocation_counter.h"
#include "support/voxel_file_builder.h"

namespace voxilux {
namespace {

using namespace voxel_file_builder;

constexpr std::uint32_t kMutationSeed = 20250301;

std::span<const std::byte> as_bytes_of(const std::string& text) {
    return std::as_bytes(std::span(text));
}

const VoxelFormat& format_of(const char* ending) {
    const VoxelFormat* const format = voxel_format_of(std::string("a") + ending);
    EXPECT_NE(format, nullptr) << ending;
    return *format;
}

Cells cells_of(const Result<VoxelCells>& voxels) {
    Cells cells;
    if (!voxels) return cells;
    for (const ColouredCell& voxel : voxels.value().cells)
        cells[voxel.cell] = voxel.colour;
    return cells;
}

TEST(VoxelFormats, ten_files_of_each_format_hold_the_cells_that_were_written) {
    for (const auto& [ending, make] : kSampledFormats) {
        for (std::uint32_t seed = 0; seed < 10; ++seed) {
            const Sample sample = make(seed);
            const auto voxels = read_voxel_cells(format_of(ending), as_bytes_of(sample.bytes));
            ASSERT_TRUE(voxels) << ending << " " << seed << ": " << voxels.reason();
            EXPECT_TRUE(cells_of(voxels) == sample.expected) << ending << " " << seed;
            EXPECT_EQ(voxels.value().cells.size(), sample.expected.size()) << ending;
            EXPECT_TRUE(voxels.value().warnings.empty()) << voxels.value().warnings.front();
        }
    }
}

// Negative control of the comparison above.
TEST(VoxelFormats, comparison_sees_a_mirrored_file_and_a_changed_colour) {
    const Sample sample = qb_sample(6);
    std::string mirrored = sample.bytes, coloured = sample.bytes;
    mirrored[8] = static_cast<char>(mirrored[8] ^ 1);  // the orientation
    coloured[4] = static_cast<char>(coloured[4] ^ 1);  // RGBA or BGRA
    for (const std::string& bytes : {mirrored, coloured})
        EXPECT_FALSE(cells_of(read_voxel_cells(format_of(".qb"), as_bytes_of(bytes))) == sample.expected);
}

// Handedness, by hand: three voxels along the axes of a right-handed and of a left-handed program, seen from
// the same side, lie on the same side.
TEST(VoxelFormats, qb_orientations_show_the_same_from_the_side_that_each_program_looks_from) {
    const auto y_of_near = [&](bool is_right_handed) {
        Cells cells = {{{0, 0, 0}, {1, 1, 1}}, {{0, 0, 1}, {2, 2, 2}}};
        const std::string bytes = qb_header(false, is_right_handed, false, 1) +
                                  qb_matrix(cells, {1, 1, 2}, {0, 0, 0}, false, false);
        const auto voxels = read_voxel_cells(format_of(".qb"), as_bytes_of(bytes));
        const ColouredCell near = voxels.value().cells[is_right_handed ? 1 : 0];
        const ColouredCell far = voxels.value().cells[is_right_handed ? 0 : 1];
        return near.cell.y < far.cell.y;  // .vox files look along +y
    };
    EXPECT_TRUE(y_of_near(false));
    EXPECT_TRUE(y_of_near(true));
}

TEST(VoxelFormats, map_without_a_header_is_512_by_512_by_64) {
    std::mt19937 random(1);
    std::string flat = "  cc";
    flat += std::string(60, '#');
    const std::string column = vxl_column(flat, [](int) { return glm::u8vec3(1, 2, 3); });
    std::string bytes;
    for (int i = 0; i < 512 * 512; ++i)
        bytes += column;
    const auto voxels = read_voxel_cells(format_of(".vxl"), as_bytes_of(bytes));
    ASSERT_TRUE(voxels) << voxels.reason();
    constexpr std::size_t kSides = 4 * 511 * 60;
    EXPECT_EQ(voxels.value().cells.size(), 2u * 512 * 512 + kSides);
    EXPECT_EQ(voxels.value().cells.front().cell, glm::ivec3(0, 511, 61));
}

TEST(VoxelFormats, mutated_files_are_refused_with_an_offset_or_load_in_bounded_memory) {
    constexpr std::size_t kMost = 4096;
    constexpr std::size_t kBytesOfTexts = 4096;    // texts
    constexpr std::size_t kBytesOfBlocks = 32768;  // palettes of Minecraft, and what unpacks them
    for (const auto& [ending, make] : kSampledFormats) {
        std::mt19937 random(kMutationSeed);
        std::size_t refused = 0, loaded = 0;
        std::vector<std::string> files;
        for (std::uint32_t seed = 0; seed < 10; ++seed)
            files.push_back(make(seed).bytes);
        for (std::uint32_t round = 0; round < 2000; ++round) {
            std::string bytes = files[round % 10];
            if (random() % 4 == 0) bytes.resize(random() % bytes.size());
            for (unsigned i = random() % 4; i > 0 && !bytes.empty(); --i) {
                // Half of the changes hit the first bytes, where counts and sizes are.
                const std::size_t reach =
                    random() % 2 == 0 ? std::min<std::size_t>(bytes.size(), 48) : bytes.size();
                bytes[random() % reach] = static_cast<char>(random());
            }
            const PeakAllocation peak;
            const auto voxels = read_voxel_cells(format_of(ending), as_bytes_of(bytes), kMost);
            EXPECT_LE(peak.bytes(), 2 * sizeof(ColouredCell) * kMost + kBytesOfTexts + kBytesOfBlocks)
                << ending << round;
            ++(voxels ? loaded : refused);
            EXPECT_TRUE(voxels || voxels.reason().starts_with("at byte "));
        }
        EXPECT_GT(refused, 300u) << ending;
        EXPECT_GT(loaded, 200u) << ending;
    }
}

TEST(VoxelFormats, every_truncation_is_refused) {
    for (const auto& [ending, make] : kSampledFormats) {
        const std::string bytes = make(1).bytes;  // without what may be missing at the end
        for (std::size_t length = 0; length < bytes.size(); ++length)
            EXPECT_FALSE(read_voxel_cells(format_of(ending), as_bytes_of(bytes.substr(0, length))))
                << ending << length;
    }
}

// A gzip stream hides the counts, so its content is damaged before it is packed, too.
TEST(VoxelFormats, mutated_content_of_minecraft_files_is_refused_or_loads_in_bounded_memory) {
    constexpr std::size_t kMost = 4096, kBytesOfBlocks = std::size_t{2} << 20;
    std::mt19937 random(kMutationSeed);
    for (const auto make : {schem_sample, litematic_sample}) {
        const VoxelFormat& format = format_of(make == schem_sample ? ".schem" : ".litematic");
        int refused = 0, loaded = 0;
        for (std::uint32_t round = 0; round < 1000; ++round) {
            std::string bytes = unpacked(make(round % 10).bytes);
            for (std::uint_fast32_t i = 1 + random() % 3; i > 0; --i)
                bytes[random() % bytes.size()] =
                    static_cast<char>(random() % 2 == 0 ? random() : random() % 13);
            const PeakAllocation peak;
            const auto voxels = read_voxel_cells(format, as_bytes_of(gzipped(bytes)), kMost);
            EXPECT_LE(peak.bytes(), 2 * sizeof(ColouredCell) * kMost + kBytesOfBlocks) << round;
            ++(voxels ? loaded : refused);
        }
        EXPECT_GT(refused, 200) << format.ending;
        EXPECT_GT(loaded, 50) << format.ending;
    }
}

TEST(VoxelFormats, blocks_have_the_looks_of_their_names) {
    const auto colour = [](const char* name) { return glm::ivec3(look_of_block(name).colour); };
    EXPECT_EQ(colour("minecraft:red_concrete"), colour("minecraft:red_wool"));
    EXPECT_EQ(colour("minecraft:oak_stairs[half=top,facing=east]"), colour("minecraft:oak_planks"));
    EXPECT_EQ(colour("minecraft:stone_brick_stairs"), colour("minecraft:stone"));
    EXPECT_EQ(colour("minecraft:waxed_oxidized_cut_copper_slab"), colour("minecraft:oxidized_copper"));
    EXPECT_EQ(colour("minecraft:deepslate_brick_wall"), colour("minecraft:deepslate"));
    EXPECT_EQ(colour("minecraft:dead_tube_coral_wall_fan"), colour("minecraft:tube_coral"));
    EXPECT_EQ(colour("minecraft:deepslate_gold_ore"), colour("minecraft:gold_ore"));
    EXPECT_NE(colour("minecraft:oak_log"), colour("minecraft:oak_planks"));
    EXPECT_NE(colour("minecraft:light_blue_wool"), colour("minecraft:blue_wool"));
    EXPECT_EQ(look_of_block("minecraft:lime_stained_glass_pane").look, CellLook::glass);
    EXPECT_EQ(look_of_block("minecraft:water[level=0]").look, CellLook::water);
    EXPECT_EQ(look_of_block("minecraft:lava").look, CellLook::light);
    EXPECT_EQ(look_of_block("minecraft:redstone_lamp[lit=true]").look, CellLook::light);
    EXPECT_EQ(look_of_block("minecraft:redstone_lamp[lit=false]").look, CellLook::diffuse);
    EXPECT_TRUE(look_of_block("minecraft:cave_air").is_empty);
    EXPECT_EQ(look_of_block("mod:gadget"), (BlockLook{.colour = {128, 128, 128}, .is_known = false}));
}

TEST(VoxelFormats, every_dye_and_wood_is_known_in_every_form) {
    const std::string dyes[] = {"white", "orange", "magenta",    "light_blue", "yellow", "lime",
                                "pink",  "gray",   "light_gray", "cyan",       "purple", "blue",
                                "brown", "green",  "red",        "black"};
    const std::string dyed[] = {"wool",          "carpet",
                                "concrete",      "concrete_powder",
                                "terracotta",    "glazed_terracotta",
                                "stained_glass", "stained_glass_pane",
                                "bed",           "shulker_box"};
    std::set<std::array<int, 3>> colours;
    for (const std::string& dye : dyes)
        for (const std::string& form : dyed) {
            const BlockLook look = look_of_block("minecraft:" + dye + "_" + form);
            EXPECT_TRUE(look.is_known) << dye << form;
            colours.insert({look.colour.r, look.colour.g, look.colour.b});
        }
    EXPECT_EQ(colours.size(), std::size(dyes)) << "one colour for each dye";
    for (const char* wood : {"oak", "spruce", "birch", "jungle", "acacia", "dark_oak", "mangrove", "cherry"})
        for (const char* form : {"planks", "log", "wood", "stairs", "slab", "fence", "fence_gate", "door",
                                 "trapdoor", "button", "sign", "leaves", "pressure_plate"})
            EXPECT_TRUE(look_of_block(std::string("minecraft:") + wood + "_" + form).is_known)
                << wood << form;
}

TEST(VoxelFormats, unknown_blocks_are_grey_and_counted) {
    const std::string body =
        nbt_compound("Schematic", nbt_short("Width", 4) + nbt_short("Height", 1) + nbt_short("Length", 1) +
                                      nbt_compound("Palette", nbt_int("mod:a", 0) + nbt_int("mod:b", 1) +
                                                                  nbt_int("minecraft:dirt", 2)) +
                                      nbt_bytes("BlockData", std::string("\0\0\1\2", 4)));
    const auto voxels = read_voxel_cells(format_of(".schem"), as_bytes_of(gzipped(body)));
    ASSERT_TRUE(voxels) << voxels.reason();
    EXPECT_EQ(voxels.value().cells[0].colour, glm::u8vec3(128));
    ASSERT_EQ(voxels.value().warnings.size(), 1u);
    EXPECT_EQ(voxels.value().warnings[0],
              "3 voxels are grey: the colours of 2 kinds of blocks are unknown, 'mod:a' among them");
}

TEST(VoxelFormats, minecraft_files_that_do_not_add_up_are_refused) {
    const auto schem = [](int width, const std::string& data, const std::string& more = "") {
        return nbt_compound("Schematic", nbt_short("Width", width) + nbt_short("Height", 1) +
                                             nbt_short("Length", 1) +
                                             nbt_compound("Palette", nbt_int("minecraft:dirt", 0)) +
                                             nbt_bytes("BlockData", data) + more);
    };
    const std::string good = schem(2, std::string(2, '\0'));
    ASSERT_TRUE(read_voxel_cells(format_of(".schem"), as_bytes_of(good)));
    std::string deep;
    for (int i = 0; i < 600; ++i)
        deep += nbt_tag(10, "", "");
    std::string wrong_sum = gzipped(good);
    wrong_sum[wrong_sum.size() - 6] ^= 1;
    for (const auto& [bytes, words] :
         {std::pair{schem(3, std::string(2, '\0')), "3 x 1 x 1"},
          {schem(1, std::string(2, '\0')), "1 x 1 x 1"},
          {schem(1, "\1"), "not in the palette"},
          {schem(1, "\x80"), "does not end"},
          {schem(0, ""), "no Width"},
          {schem(1, std::string(1, '\0'), nbt_tag(13, "x", "")), "type 13"},
          {schem(1, std::string(1, '\0'), nbt_tag(11, "x", big(0xFFFFFFFF, 4))), "-1 elements"},
          {schem(1, std::string(1, '\0'), deep), "nested"},
          {nbt_compound("Schematic", nbt_short("Width", 1) + nbt_short("Height", 1) + nbt_short("Length", 1)),
           "no blocks"},
          {std::string("PK"), "type 80"},
          {wrong_sum, "damaged"}}) {
        const auto voxels = read_voxel_cells(format_of(".schem"), as_bytes_of(bytes));
        ASSERT_FALSE(voxels) << words;
        EXPECT_NE(voxels.reason().find(words), std::string::npos) << voxels.reason();
    }
}

TEST(VoxelFormatsNightly, gzip_bomb_is_refused_at_the_bound_in_little_memory) {
    const std::string bomb = schem_bomb();
    ASSERT_LT(bomb.size(), std::size_t{8} << 20);
    const PeakAllocation peak;
    const auto voxels = read_voxel_cells(format_of(".schem"), as_bytes_of(bomb));
    ASSERT_FALSE(voxels);
    EXPECT_NE(voxels.reason().find("over 1024 MiB"), std::string::npos) << voxels.reason();
    EXPECT_LE(peak.bytes(), std::size_t{1} << 16);
}

TEST(VoxelFormats, files_that_claim_too_much_are_refused_before_memory_is_taken) {
    const std::string qb = qb_header(false, false, true, 1) + "\1n" + u32(65536) + u32(65536) + u32(2) +
                           i32(0) + i32(0) + i32(0) + u32(2) + u32(0xFFFFFFFF) + u32(0xFFFFFFFF) + u32(6) +
                           u32(6);
    const std::string kv6 =
        "Kvxl" + u32(65536) + u32(65536) + u32(65536) + f32(0) + f32(0) + f32(0) + u32(0xFFFFFFFF);
    std::string binvox = "#binvox 1\ndim 65536 65536 65536\ndata\n";
    for (int i = 0; i < 100; ++i)
        binvox += "\1\xff";
    const std::string far = qb_header(false, false, false, 2) +
                            qb_matrix({{{0, 0, 0}, {1, 2, 3}}}, {1, 1, 1}, {0, 0, 0}, false, false) +
                            qb_matrix({{{0, 0, 0}, {1, 2, 3}}}, {1, 1, 1}, {1 << 20, 0, 0}, false, false);
    const std::pair<const char*, std::string> liars[] = {
        {".qb", qb}, {".qb", far}, {".kv6", kv6}, {".binvox", binvox}};
    for (const auto& [ending, bytes] : liars) {
        const PeakAllocation peak;
        const auto voxels = read_voxel_cells(format_of(ending), as_bytes_of(bytes), 1 << 10);
        EXPECT_FALSE(voxels) << ending;
        EXPECT_LE(peak.bytes(), std::size_t{1} << 16);
    }
}

}  // namespace
}  // namespace voxilux

// Readers of other voxel formats, with files whose cells are known, and with damaged files.

#include <gtest/gtest.h>

#include <random>

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
    constexpr std::size_t kBytesOfTexts = 4096;  // texts
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
            EXPECT_LE(peak.bytes(), 2 * sizeof(ColouredCell) * kMost + kBytesOfTexts) << ending << round;
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

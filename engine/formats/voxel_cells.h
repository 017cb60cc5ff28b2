#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "base/error.h"

namespace voxilux {

// How light leaves a cell beside its colour.
enum class CellLook : std::uint8_t { diffuse, glass, water, light };

// A filled cell in the space of .vox files: z up, right handed.
struct ColouredCell {
    glm::ivec3 cell{0};
    glm::u8vec3 colour{0};  // sRGB
    CellLook look = CellLook::diffuse;

    bool operator==(const ColouredCell&) const = default;
};

// Most cells on an axis from the first filled one to the last, as in a voxelized mesh.
inline constexpr int kMaxCellSide = 1 << 16;
// A solid 323^3. Memory is 16 bytes for each, and twice that while the list grows.
inline constexpr std::size_t kMaxColouredCells = std::size_t{1} << 25;

static_assert(sizeof(ColouredCell) == 16);

// Voxels with a colour each: what the formats of other programs hold.
struct VoxelCells {
    std::vector<ColouredCell> cells;  // where a cell comes twice, the last counts
    std::vector<std::string> warnings;
};

// One format. `read` appends no more than `most` cells and throws VoxRefusal.
struct VoxelFormat {
    std::string_view ending;
    void (*read)(std::span<const std::byte> bytes, std::size_t most, VoxelCells& into);
};

// .qb, .kv6, .vxl, .binvox, .schem, .litematic
[[nodiscard]] std::span<const VoxelFormat> voxel_formats();

// The format of a file's ending, or nullptr.
[[nodiscard]] const VoxelFormat* voxel_format_of(const std::filesystem::path& file);

// The cells of a file, or the first broken rule and its byte offset. Nothing is allocated for a number that
// the file merely claims. Memory: 32 bytes for each of at most `most` cells and 4 KiB, for files of Minecraft
// 2 MiB; time: linear in bytes (unpacked ones, at most kMaxNbtBytes) and cells.
[[nodiscard]] Result<VoxelCells> read_voxel_cells(const VoxelFormat& format, std::span<const std::byte> bytes,
                                                  std::size_t most = kMaxColouredCells);

// For the readers: appends a cell. Throws VoxRefusal, which names `offset`, where there are `most` already.
void add_cell(VoxelCells& into, std::size_t most, const ColouredCell& cell, std::size_t offset);

void read_qb(std::span<const std::byte> bytes, std::size_t most, VoxelCells& into);
void read_kv6(std::span<const std::byte> bytes, std::size_t most, VoxelCells& into);
void read_vxl(std::span<const std::byte> bytes, std::size_t most, VoxelCells& into);
void read_binvox(std::span<const std::byte> bytes, std::size_t most, VoxelCells& into);
void read_schem(std::span<const std::byte> bytes, std::size_t most, VoxelCells& into);
void read_litematic(std::span<const std::byte> bytes, std::size_t most, VoxelCells& into);

}  // namespace voxilux

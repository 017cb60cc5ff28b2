// Voxlap sprites (.kv6), as Slab6 writes them. Format: the comments of Voxlap's voxlap5.c and Slab6's
// slab6.txt (Ken Silverman, advsys.net/ken). Only voxels of the surface are stored. Voxlap's z points down
// and its views look along -y, so (x, y, z) is (x, -y, -z) of a .vox file; the pivot becomes the origin.

#include <cmath>
#include <numeric>

#include "formats/vox_bytes.h"
#include "formats/voxel_cells.h"

namespace voxilux {
namespace {

constexpr std::uint32_t kKv6Magic = 0x6C78764B;  // "Kvxl"
constexpr std::size_t kKv6VoxelBytes = 8;

struct Kv6Header {
    glm::uvec3 size{0};
    glm::ivec3 pivot{0};
    std::uint32_t voxels = 0;
};

int read_pivot(VoxBytes& in) {
    const std::size_t start = in.offset();
    const float pivot = in.f32("pivot");
    if (!(std::abs(pivot) <= static_cast<float>(kMaxCellSide)))
        throw VoxRefusal(start, fmt::format("the pivot lies beyond {}", kMaxCellSide));
    return static_cast<int>(std::lround(pivot));
}

Kv6Header read_kv6_header(VoxBytes& in) {
    if (in.u32("magic") != kKv6Magic) throw VoxRefusal(0, "not a .kv6 file: it does not begin with 'Kvxl'");
    Kv6Header header;
    for (int axis = 0; axis < 3; ++axis) {
        header.size[axis] = in.u32("side");
        if (header.size[axis] > static_cast<std::uint32_t>(kMaxCellSide))
            throw VoxRefusal(4, fmt::format("a side is {}, more than {}", header.size[axis], kMaxCellSide));
    }
    for (int axis = 0; axis < 3; ++axis)
        header.pivot[axis] = read_pivot(in);
    header.voxels = in.u32("number of voxels");
    return header;
}

// Adds the voxels of one column. A file has the voxels of all columns first, then the lengths of the columns.
void read_kv6_column(VoxBytes& in, const Kv6Header& header, glm::ivec2 column, std::uint32_t count,
                     std::size_t most, VoxelCells& into) {
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::size_t start = in.offset();
        const std::uint32_t colour = in.u32("colour");
        const std::uint16_t z = in.u16("height");
        (void)in.u16("visible sides and normal");
        if (z >= header.size.z)
            throw VoxRefusal(start, fmt::format("a voxel at height {} of {}", z, header.size.z));
        const glm::ivec3 at = glm::ivec3(column, z) - header.pivot;
        add_cell(into, most,
                 {{at.x, -at.y - 1, -at.z - 1},
                  glm::u8vec3(colour >> 16 & 0xFF, colour >> 8 & 0xFF, colour & 0xFF)},
                 start);
    }
}

}  // namespace

void read_kv6(std::span<const std::byte> bytes, std::size_t most, VoxelCells& into) {
    VoxBytes in(bytes, 0, bytes.size(), "the file");
    const Kv6Header header = read_kv6_header(in);
    const std::size_t first = in.offset();
    (void)in.bytes(std::size_t{header.voxels} * kKv6VoxelBytes, "voxels");
    VoxBytes voxels(bytes, first, in.offset(), "the list of voxels");
    (void)in.bytes(std::size_t{header.size.x} * 4, "lengths of rows");  // the sums of those of its columns
    for (std::uint32_t x = 0; x < header.size.x; ++x) {
        for (std::uint32_t y = 0; y < header.size.y; ++y)
            read_kv6_column(voxels, header, {x, y}, in.u16("length of a column"), most, into);
    }
    if (voxels.left() > 0)
        throw VoxRefusal(voxels.offset(),
                         fmt::format("the columns leave out {} voxels", voxels.left() / kKv6VoxelBytes));
    // What may follow is a palette for 8-bit displays.
}

}  // namespace voxilux

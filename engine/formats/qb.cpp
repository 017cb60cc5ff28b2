// Qubicle binary (.qb). Format: "Qubicle Binary File Specifications", getqubicle.com. Matrices of voxels with
// y up, x fastest, then y, then z. Left handed files look along +z, so that (x, y, z) is (x, z, y) of a .vox
// file; right handed ones turn as a mesh does, to (x, -z, y).

#include <algorithm>
#include <limits>

#include "formats/vox_bytes.h"
#include "formats/voxel_cells.h"

namespace voxilux {
namespace {

// Words of compressed slices that are not colours.
constexpr std::uint32_t kRun = 2, kNextSlice = 6;
// So that no sum of a place and a side leaves 32 bits.
constexpr std::int32_t kFarthest = 1 << 28;

struct QbHeader {
    bool is_bgra = false;
    bool is_right_handed = false;
    bool is_compressed = false;
    std::uint32_t matrices = 0;
};

struct QbMatrix {
    glm::uvec3 size{0};
    glm::ivec3 low{0};
};

bool read_bit(VoxBytes& in, std::string_view name) {
    const std::size_t start = in.offset();
    const std::uint32_t value = in.u32(name);
    if (value > 1) throw VoxRefusal(start, fmt::format("the {} is {}, not 0 or 1", name, value));
    return value == 1;
}

QbHeader read_qb_header(VoxBytes& in) {
    const std::uint32_t version = in.u32("version");
    if (version != 0x101 && version != 0x1)  // 1.1.0.0, 1.0.0.0
        throw VoxRefusal(0, "not a Qubicle binary file: its version is not 1.1 or 1.0");
    QbHeader header;
    header.is_bgra = read_bit(in, "colour format");
    header.is_right_handed = read_bit(in, "orientation of the z axis");
    header.is_compressed = read_bit(in, "compression");
    (void)read_bit(in, "encoding of visibility");  // either way, an alpha of 0 is an empty cell
    header.matrices = in.u32("number of matrices");
    return header;
}

QbMatrix read_matrix_head(VoxBytes& in) {
    (void)in.bytes(in.u8("length of a name"), "name");
    QbMatrix matrix;
    const std::size_t start = in.offset();
    for (int axis = 0; axis < 3; ++axis) {
        matrix.size[axis] = in.u32("side");
        if (matrix.size[axis] < 1 || matrix.size[axis] > static_cast<std::uint32_t>(kMaxCellSide))
            throw VoxRefusal(start,
                             fmt::format("a side is {}, not from 1 to {}", matrix.size[axis], kMaxCellSide));
    }
    for (int axis = 0; axis < 3; ++axis) {
        matrix.low[axis] = in.i32("place");
        if (std::abs(std::int64_t{matrix.low[axis]}) > kFarthest)
            throw VoxRefusal(start,
                             fmt::format("a matrix stands at {}, beyond {}", matrix.low[axis], kFarthest));
    }
    return matrix;
}

class QbReader {
  public:
    QbReader(VoxBytes& in, std::size_t most, VoxelCells& into) : in_(in), most_(most), into_(into) {}

    void read() {
        header_ = read_qb_header(in_);
        for (std::uint32_t i = 0; i < header_.matrices; ++i) {
            const QbMatrix matrix = read_matrix_head(in_);
            for (std::uint32_t z = 0; z < matrix.size.z; ++z)
                header_.is_compressed ? read_runs(matrix, z) : read_slice(matrix, z);
        }
    }

  private:
    void read_slice(const QbMatrix& matrix, std::uint32_t z) {
        const std::uint64_t cells = std::uint64_t{matrix.size.x} * matrix.size.y;
        for (std::uint64_t i = 0; i < cells; ++i)
            add(matrix, z, i, 1, in_.u32("voxel"));
    }

    void read_runs(const QbMatrix& matrix, std::uint32_t z) {
        const std::uint64_t cells = std::uint64_t{matrix.size.x} * matrix.size.y;
        std::uint64_t index = 0;
        while (true) {
            const std::size_t start = in_.offset();
            std::uint32_t word = in_.u32("voxel");
            if (word == kNextSlice) return;
            std::uint32_t count = 1;
            if (word == kRun) {
                count = in_.u32("length of a run");
                word = in_.u32("voxel");
            }
            if (count > cells - index)
                throw VoxRefusal(start, fmt::format("a run of {} voxels where the slice has {} left", count,
                                                    cells - index));
            add(matrix, z, index, count, word);
            index += count;
        }
    }

    void add(const QbMatrix& matrix, std::uint32_t z, std::uint64_t first, std::uint32_t count,
             std::uint32_t word) {
        if (word >> 24 == 0) return;
        glm::u8vec3 colour(word & 0xFF, word >> 8 & 0xFF, word >> 16 & 0xFF);
        if (header_.is_bgra) std::swap(colour.r, colour.b);
        for (std::uint64_t i = first; i < first + count; ++i) {
            const glm::ivec3 at =
                matrix.low + glm::ivec3(glm::uvec3(i % matrix.size.x, i / matrix.size.x, z));
            // A cell is the space from its number to the next, so -z turns to -z - 1.
            add_cell(into_, most_, {{at.x, header_.is_right_handed ? -at.z - 1 : at.z, at.y}, colour},
                     in_.offset());
        }
    }

    VoxBytes& in_;
    std::size_t most_;
    VoxelCells& into_;
    QbHeader header_;
};

}  // namespace

void read_qb(std::span<const std::byte> bytes, std::size_t most, VoxelCells& into) {
    VoxBytes in(bytes, 0, bytes.size(), "the file");
    QbReader(in, most, into).read();
    if (in.left() > 0)
        into.warnings.push_back(fmt::format("{} bytes after the last matrix are ignored", in.left()));
}

}  // namespace voxilux

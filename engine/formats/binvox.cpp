// binvox (.binvox). Format: "BINVOX voxel file format specification", patrickmin.com/binvox. A text header,
// then runs (value, length) over the cells, y fastest, then z, then x. y is taken as up, as in a mesh:
// (x, y, z) is (x, -z, y) of a .vox file. The format has no colours, so the voxels are white.

#include <charconv>

#include "formats/vox_bytes.h"
#include "formats/voxel_cells.h"

namespace voxilux {
namespace {

constexpr std::size_t kMaxHeaderLine = 256;
constexpr glm::u8vec3 kWhite{255};

std::string read_line(VoxBytes& in) {
    const std::size_t start = in.offset();
    std::string line;
    while (true) {
        const char c = static_cast<char>(in.u8("header"));
        if (c == '\n') break;
        if (line.size() == kMaxHeaderLine) throw VoxRefusal(start, "a line of the header is too long");
        line += c;
    }
    if (line.ends_with('\r')) line.pop_back();
    return line;
}

// The sides of "dim 32 32 32": x, z and y, which the format calls depth, height and width.
glm::ivec3 parse_sides(std::string_view text, std::size_t offset) {
    glm::ivec3 sides{0};
    for (int axis = 0; axis < 3; ++axis) {
        text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), sides[axis]);
        if (error != std::errc() || sides[axis] < 1 || sides[axis] > kMaxCellSide)
            throw VoxRefusal(offset, fmt::format("dim needs three sides from 1 to {}", kMaxCellSide));
        text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    }
    return {sides[0], sides[2], sides[1]};
}

glm::ivec3 read_binvox_header(VoxBytes& in) {
    const std::string magic = read_line(in);
    if (magic != "#binvox 1" && magic != "#binvox 2")
        throw VoxRefusal(0, "not a .binvox file: it does not begin with '#binvox 1' or '#binvox 2'");
    glm::ivec3 sides{0};
    while (true) {
        const std::size_t start = in.offset();
        const std::string line = read_line(in);
        if (line == "data") break;
        if (line.starts_with("dim ")) {
            sides = parse_sides(std::string_view(line).substr(4), start);
        } else if (!line.starts_with("translate ") && !line.starts_with("scale ") && !line.starts_with("#")) {
            throw VoxRefusal(start, fmt::format("the header has a line {}", quoted_name(line)));
        }
    }
    if (sides.x == 0) throw VoxRefusal(in.offset(), "the header has no dim");
    return sides;
}

}  // namespace

void read_binvox(std::span<const std::byte> bytes, std::size_t most, VoxelCells& into) {
    VoxBytes in(bytes, 0, bytes.size(), "the file");
    const glm::i64vec3 sides(read_binvox_header(in));
    const std::int64_t cells = sides.x * sides.y * sides.z;
    for (std::int64_t index = 0; index < cells;) {
        const std::size_t start = in.offset();
        const std::uint8_t value = in.u8("value");
        const std::int64_t count = in.u8("length of a run");
        if (count > cells - index)
            throw VoxRefusal(start,
                             fmt::format("a run of {} voxels where {} are left", count, cells - index));
        for (std::int64_t i = index; value != 0 && i < index + count; ++i) {
            const glm::ivec3 at(i / (sides.y * sides.z), i % sides.y, i / sides.y % sides.z);
            add_cell(into, most, {{at.x, static_cast<int>(sides.z) - 1 - at.z, at.y}, kWhite}, start);
        }
        index += count;
    }
    if (in.left() > 0)
        into.warnings.push_back(fmt::format("{} bytes after the last run are ignored", in.left()));
}

}  // namespace voxilux

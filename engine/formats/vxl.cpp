// Voxlap maps (.vxl). Formats: loadvxl of Voxlap's voxlap5.c (Ken Silverman), with a header; "Ace of Spades
// Map File Format version 1" (Sean Barrett), without one, 512 x 512 x 64. A column is a chain of spans: air,
// coloured voxels, solid ground without a colour, coloured voxels. z points down and views look along -y, so
// (x, y, z) is (x, -y, -z) of a .vox file. Ground without a colour is hidden and left out, except on the
// sides of the map, where it takes the colour above it.

#include "formats/vox_bytes.h"
#include "formats/voxel_cells.h"

namespace voxilux {
namespace {

constexpr std::uint32_t kVxlMagic = 0x09072000;
constexpr std::size_t kCameraBytes = 4 * 24;  // position, right, down and forward in doubles
constexpr int kMaxMapSide = 16384;

struct VxlMap {
    int side = 512;
    int depth = 64;
};

VxlMap read_vxl_header(std::span<const std::byte> bytes, VoxBytes& in) {
    VoxBytes peek(bytes, 0, bytes.size(), "the file");
    if (peek.u32("first span") != kVxlMagic) return {};
    (void)in.u32("magic");
    const std::uint32_t width = in.u32("width"), height = in.u32("height");
    if (width != height || width == 0 || width > static_cast<std::uint32_t>(kMaxMapSide))
        throw VoxRefusal(4, fmt::format("the map has {} x {} columns, not a square of at most {}", width,
                                        height, kMaxMapSide));
    (void)in.bytes(kCameraBytes, "camera");
    return {static_cast<int>(width), 256};
}

struct VxlSpan {
    std::size_t offset = 0;
    int words = 0;  // of the span, with this head; 0 in the last span of a column
    int first = 0;  // coloured voxels under the air
    int last = -1;
    int air = 0;  // where the air begins

    [[nodiscard]] int top_colours() const { return last - first + 1; }
    [[nodiscard]] int bottom_colours() const { return words - 1 - top_colours(); }
};

VxlSpan read_span(VoxBytes& in, const VxlMap& map) {
    VxlSpan span{.offset = in.offset()};
    span.words = in.u8("length of a span");
    span.first = in.u8("first colour");
    span.last = in.u8("last colour");
    span.air = in.u8("begin of the air");
    if (span.last >= map.depth || span.top_colours() < 0)
        throw VoxRefusal(span.offset, fmt::format("colours from {} to {} in {} cells of height", span.first,
                                                  span.last, map.depth));
    if (span.words != 0 && span.bottom_colours() < 0)
        throw VoxRefusal(span.offset,
                         fmt::format("a span of {} words for {} colours", span.words, span.top_colours()));
    return span;
}

class VxlReader {
  public:
    VxlReader(VoxBytes& in, const VxlMap& map, std::size_t most, VoxelCells& into)
        : in_(in), map_(map), most_(most), into_(into) {}

    void read_column(glm::ivec2 column) {
        column_ = column;
        VxlSpan span = read_span(in_, map_);
        int end = 0;  // of what is known of the column
        while (true) {
            if (span.first < end) refuse_order(span.offset, span.first, end);
            read_colours(span.first, span.top_colours());
            end = span.last + 1;
            if (span.words == 0) break;
            const std::size_t colours = in_.offset();
            (void)in_.bytes(4 * static_cast<std::size_t>(span.bottom_colours()), "colours");
            const VxlSpan next = read_span(in_, map_);
            const int bottom = next.air - span.bottom_colours();
            if (bottom < end || next.air > map_.depth) refuse_order(next.offset, bottom, end);
            fill(end, bottom);
            read_bottom(colours, bottom, span.bottom_colours());
            end = next.air;
            span = next;
        }
        fill(end, map_.depth);
    }

  private:
    [[noreturn]] static void refuse_order(std::size_t offset, int height, int end) {
        throw VoxRefusal(
            offset, fmt::format("a span begins at height {}, above {} where the last one ends", height, end));
    }

    void read_colours(int first, int count) {
        for (int z = first; z < first + count; ++z)
            add(z, in_.u32("colour"));
    }

    void read_bottom(std::size_t offset, int first, int count) {
        VoxBytes colours = in_.from(offset);
        for (int z = first; z < first + count; ++z)
            add(z, colours.u32("colour"));
    }

    void add(int z, std::uint32_t word) {
        word_ = word;
        add_cell(into_, most_,
                 {{column_.x, map_.side - 1 - column_.y, map_.depth - 1 - z},
                  glm::u8vec3(word >> 16 & 0xFF, word >> 8 & 0xFF, word & 0xFF)},
                 in_.offset());
    }

    // Ground on the sides of the map; a map has a colour above it.
    void fill(int first, int end) {
        const bool is_side =
            column_.x == 0 || column_.y == 0 || column_.x == map_.side - 1 || column_.y == map_.side - 1;
        for (int z = first; is_side && z < end; ++z)
            add(z, word_);
    }

    VoxBytes& in_;
    VxlMap map_;
    std::size_t most_;
    VoxelCells& into_;
    glm::ivec2 column_{0};
    std::uint32_t word_ = 0;  // the last colour
};

}  // namespace

void read_vxl(std::span<const std::byte> bytes, std::size_t most, VoxelCells& into) {
    VoxBytes in(bytes, 0, bytes.size(), "the file");
    const VxlMap map = read_vxl_header(bytes, in);
    VxlReader reader(in, map, most, into);
    for (int y = 0; y < map.side; ++y) {
        for (int x = 0; x < map.side; ++x)
            reader.read_column({x, y});
    }
    if (in.left() > 0)
        into.warnings.push_back(fmt::format("{} bytes after the last column are ignored", in.left()));
}

}  // namespace voxilux

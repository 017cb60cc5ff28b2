// Minecraft schematics (.schem). Format: "Sponge Schematic Specification" versions 1 to 3 (SpongePowered,
// github.com/SpongePowered/Schematic-Specification). A palette names the blocks; their numbers follow as
// variable-length integers, x fastest, then z, then y. y is up and z points south, so (x, y, z) is (x, -z, y)
// of a .vox file. The file is read twice, because the blocks may come before what explains them.

#include <algorithm>
#include <array>

#include "formats/block_palette.h"
#include "formats/nbt_reader.h"
#include "formats/vox_bytes.h"
#include "formats/voxel_cells.h"

namespace voxilux {
namespace {

constexpr int kVarintBits = 7, kMaxVarintBytes = 5;

class SchemReader {
  public:
    SchemReader(std::span<const std::byte> bytes, std::size_t most, VoxelCells& into)
        : bytes_(bytes), most_(most), into_(into) {}

    void read() {
        const std::uint64_t rest = walk();
        if (rest > 0) into_.warnings.push_back(fmt::format("{} bytes after the last tag are ignored", rest));
        for (int axis = 0; axis < 3; ++axis) {
            if (size_[axis] == 0)
                throw VoxRefusal(
                    0, fmt::format("the schematic has no {}", kSides[static_cast<std::size_t>(axis)]));
        }
        if (!has_blocks_ || palette_.empty()) throw VoxRefusal(0, "the schematic has no blocks");
        palette_.sort();
        is_second_ = true;
        (void)walk();
        palette_.warn(into_.warnings);
    }

  private:
    static constexpr std::array<std::string_view, 3> kSides{"Width", "Height", "Length"};

    // Returns how many bytes follow the root.
    std::uint64_t walk() {
        NbtReader in(bytes_);
        in.open_root();
        read_compound(in, 0);
        return in.finish();
    }

    // Version 3 has a compound "Schematic" in its root, and "Blocks" in that; before, all was in the root.
    void read_compound(NbtReader& in, int depth) {
        for (NbtTag tag = in.next_tag(); tag.type != NbtType::end; tag = in.next_tag()) {
            const auto side = std::ranges::find(kSides, tag.name);
            const bool is_outer = tag.name == "Schematic" || tag.name == "Blocks";
            if (side != kSides.end() && !is_second_) {
                in.expect(tag, NbtType::int16);
                size_[static_cast<int>(side - kSides.begin())] = in.u16();
            } else if (is_outer && tag.type == NbtType::compound && depth < 2) {
                read_compound(in, depth + 1);
            } else if (tag.name == "Palette" && !is_second_) {
                in.expect(tag, NbtType::compound);
                read_palette(in);
            } else if (tag.name == "BlockData" || (tag.name == "Data" && depth > 0)) {
                in.expect(tag, NbtType::bytes);
                has_blocks_ = true;
                is_second_ ? read_blocks(in) : in.skip(tag.type);
            } else {
                in.skip(tag.type);
            }
        }
    }

    void read_palette(NbtReader& in) {
        for (NbtTag tag = in.next_tag(); tag.type != NbtType::end; tag = in.next_tag()) {
            in.expect(tag, NbtType::int32);
            palette_.add(static_cast<std::uint32_t>(in.i32()), tag.name, in.offset());
        }
    }

    static std::uint32_t read_varint(NbtReader& in, std::uint32_t& bytes_left) {
        const std::size_t start = in.offset();
        std::uint32_t value = 0;
        for (int i = 0; i < kMaxVarintBytes && bytes_left > 0; ++i) {
            const std::uint32_t byte = in.u8();
            --bytes_left;
            value |= (byte & 0x7F) << (i * kVarintBits);
            if (byte < 0x80) return value;
        }
        throw VoxRefusal(start, "the number of a block does not end");
    }

    void read_blocks(NbtReader& in) {
        const std::size_t start = in.offset();
        std::uint32_t left = in.count();
        const glm::i64vec3 size(size_);
        const std::int64_t cells = size.x * size.y * size.z;
        std::int64_t index = 0;
        for (; left > 0 && index < cells; ++index) {
            const BlockLook* const block = palette_.find(read_varint(in, left));
            if (block == nullptr) throw VoxRefusal(in.offset(), "a block is not in the palette");
            if (block->is_empty) continue;
            const glm::ivec3 at(index % size.x, index / (size.x * size.z), index / size.x % size.z);
            add_cell(into_, most_, {{at.x, size_.z - 1 - at.z, at.y}, block->colour, block->look},
                     in.offset());
        }
        if (left > 0 || index < cells)
            throw VoxRefusal(
                start, fmt::format("the blocks are not those of {} x {} x {} cells", size.x, size.y, size.z));
    }

    std::span<const std::byte> bytes_;
    std::size_t most_;
    VoxelCells& into_;
    glm::ivec3 size_{0};
    BlockPalette palette_;
    bool has_blocks_ = false;
    bool is_second_ = false;
};

}  // namespace

void read_schem(std::span<const std::byte> bytes, std::size_t most, VoxelCells& into) {
    SchemReader(bytes, most, into).read();
}

}  // namespace voxilux

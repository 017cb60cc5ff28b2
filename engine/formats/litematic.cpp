// Schematics of the Minecraft mod Litematica (.litematic). No specification is published; the layout is that
// of its source (maruohon, github.com/maruohon/litematica: LitematicaSchematic, LitematicaBitArray). Regions
// with a position, a size that may be negative, a palette and block numbers: as few bits each as the palette
// needs, at least 2, one after the other across 64-bit words, lowest bits first; x fastest, then z, then y.
// (x, y, z) is (x, -z, y) of a .vox file. The file is read twice, because the blocks may come before what
// explains them.

#include <algorithm>
#include <bit>
#include <cstdlib>

#include "formats/block_palette.h"
#include "formats/nbt_reader.h"
#include "formats/vox_bytes.h"
#include "formats/voxel_cells.h"

namespace voxilux {
namespace {

constexpr std::size_t kMaxRegions = 4096;
// So that no sum of a place and a side leaves 32 bits.
constexpr std::int32_t kFarthestRegion = 1 << 28;

struct Region {
    glm::ivec3 place{0};
    glm::ivec3 size{0};                         // negative: towards lower coordinates
    std::uint32_t first_block = 0, blocks = 0;  // in the palette of all regions
    bool has_states = false;
};

// Numbers of a fixed count of bits, from words.
class PackedNumbers {
  public:
    PackedNumbers(NbtReader& in, std::uint32_t words, unsigned bits)
        : in_(in), words_left_(words), bits_(bits) {}

    [[nodiscard]] std::uint32_t next() {
        std::uint64_t value = word_;
        if (left_ < bits_) {
            if (words_left_ == 0) throw VoxRefusal(in_.offset(), "the block states end too early");
            --words_left_;
            const std::uint64_t fresh = in_.u64();
            value |= fresh << left_;
            word_ = fresh >> (bits_ - left_);
            left_ += 64 - bits_;
        } else {
            word_ >>= bits_;
            left_ -= bits_;
        }
        return static_cast<std::uint32_t>(value & ((std::uint64_t{1} << bits_) - 1));
    }
    [[nodiscard]] std::uint32_t words_left() const { return words_left_; }

  private:
    NbtReader& in_;
    std::uint32_t words_left_;
    unsigned bits_;
    unsigned left_ = 0;  // bits of word_
    std::uint64_t word_ = 0;
};

glm::ivec3 read_vector(NbtReader& in) {
    glm::ivec3 value{0};
    for (NbtTag tag = in.next_tag(); tag.type != NbtType::end; tag = in.next_tag()) {
        const std::size_t axis = std::string_view("xyz").find(tag.name);
        in.expect(tag, NbtType::int32);
        const std::int32_t number = in.i32();
        if (tag.name.size() == 1 && axis < 3) value[static_cast<int>(axis)] = number;
    }
    return value;
}

class LitematicReader {
  public:
    LitematicReader(std::span<const std::byte> bytes, std::size_t most, VoxelCells& into)
        : bytes_(bytes), most_(most), into_(into) {}

    void read() {
        const std::uint64_t rest = walk();
        if (rest > 0) into_.warnings.push_back(fmt::format("{} bytes after the last tag are ignored", rest));
        if (regions_.empty()) throw VoxRefusal(0, "the schematic has no region");
        for (const Region& region : regions_)
            check(region);
        palette_.sort();
        is_second_ = true;
        (void)walk();
        palette_.warn(into_.warnings);
    }

  private:
    std::uint64_t walk() {
        NbtReader in(bytes_);
        in.open_root();
        for (NbtTag tag = in.next_tag(); tag.type != NbtType::end; tag = in.next_tag()) {
            if (tag.name != "Regions") {
                in.skip(tag.type);
                continue;
            }
            in.expect(tag, NbtType::compound);
            std::size_t number = 0;
            for (NbtTag region = in.next_tag(); region.type != NbtType::end; region = in.next_tag()) {
                in.expect(region, NbtType::compound);
                read_region(in, number++);
            }
        }
        return in.finish();
    }

    static void check(const Region& region) {
        for (int axis = 0; axis < 3; ++axis) {
            const std::int64_t side = std::abs(std::int64_t{region.size[axis]});
            if (side < 1 || side > kMaxCellSide)
                throw VoxRefusal(
                    0, fmt::format("a side of a region is {}, not from 1 to {}", side, kMaxCellSide));
            if (std::abs(std::int64_t{region.place[axis]}) > kFarthestRegion)
                throw VoxRefusal(
                    0, fmt::format("a region stands at {}, beyond {}", region.place[axis], kFarthestRegion));
        }
        if (region.blocks == 0 || !region.has_states) throw VoxRefusal(0, "a region has no blocks");
    }

    void read_region(NbtReader& in, std::size_t number) {
        if (!is_second_) {
            if (number == kMaxRegions)
                throw VoxRefusal(in.offset(), fmt::format("there are over {} regions", kMaxRegions));
            regions_.push_back({.first_block = states_});
        }
        Region& region = regions_[number];
        for (NbtTag tag = in.next_tag(); tag.type != NbtType::end; tag = in.next_tag()) {
            if (tag.name == "Position" && tag.type == NbtType::compound && !is_second_) {
                region.place = read_vector(in);
            } else if (tag.name == "Size" && tag.type == NbtType::compound && !is_second_) {
                region.size = read_vector(in);
            } else if (tag.name == "BlockStatePalette" && tag.type == NbtType::list && !is_second_) {
                read_palette(in, region);
            } else if (tag.name == "BlockStates") {
                in.expect(tag, NbtType::longs);
                region.has_states = true;
                is_second_ ? read_states(in, region) : in.skip(tag.type);
            } else {
                in.skip(tag.type);
            }
        }
    }

    void read_palette(NbtReader& in, Region& region) {
        const auto [type, count] = in.list();
        if (count > 0 && type != NbtType::compound)
            throw VoxRefusal(in.offset(), "a palette holds no compounds");
        region.first_block = states_;
        for (std::uint32_t i = 0; i < count; ++i)
            palette_.add(states_++, read_name(in), in.offset());
        region.blocks = count;
    }

    // A block of a palette as schematics of another kind name it; "lit" is the one property that counts.
    static std::string read_name(NbtReader& in) {
        std::string name, lit;
        for (NbtTag tag = in.next_tag(); tag.type != NbtType::end; tag = in.next_tag()) {
            if (tag.name == "Name" && tag.type == NbtType::text) {
                name = in.text();
            } else if (tag.name == "Properties" && tag.type == NbtType::compound) {
                for (NbtTag one = in.next_tag(); one.type != NbtType::end; one = in.next_tag()) {
                    if (one.name == "lit" && one.type == NbtType::text)
                        lit = "[lit=" + in.text() + "]";
                    else
                        in.skip(one.type);
                }
            } else {
                in.skip(tag.type);
            }
        }
        return name + lit;
    }

    void read_states(NbtReader& in, const Region& region) {
        const std::size_t start = in.offset();
        const glm::i64vec3 side(glm::abs(region.size));
        const glm::ivec3 low = region.place + glm::min(region.size + 1, 0);
        const unsigned bits = std::max(2u, static_cast<unsigned>(std::bit_width(region.blocks - 1)));
        PackedNumbers numbers(in, in.count(), bits);
        const std::int64_t cells = side.x * side.y * side.z;
        for (std::int64_t index = 0; index < cells; ++index) {
            const std::uint32_t number = numbers.next();
            if (number >= region.blocks) throw VoxRefusal(in.offset(), "a block is not in the palette");
            const BlockLook& block = *palette_.find(region.first_block + number);
            if (block.is_empty) continue;
            const glm::ivec3 at =
                low + glm::ivec3(index % side.x, index / (side.x * side.z), index / side.x % side.z);
            add_cell(into_, most_, {{at.x, -1 - at.z, at.y}, block.colour, block.look}, in.offset());
        }
        if (numbers.words_left() > 0)
            throw VoxRefusal(start, fmt::format("the block states are not those of {} x {} x {} cells",
                                                side.x, side.y, side.z));
    }

    std::span<const std::byte> bytes_;
    std::size_t most_;
    VoxelCells& into_;
    std::vector<Region> regions_;
    BlockPalette palette_;  // of all regions, one after the other
    std::uint32_t states_ = 0;
    bool is_second_ = false;
};

}  // namespace

void read_litematic(std::span<const std::byte> bytes, std::size_t most, VoxelCells& into) {
    LitematicReader(bytes, most, into).read();
}

}  // namespace voxilux

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace voxilux {

// Most bytes of a file once it is unpacked: a gzip stream may hold a thousand times its own size.
inline constexpr std::uint64_t kMaxNbtBytes = std::uint64_t{1} << 30;
// Of compounds and lists in each other, as the format says.
inline constexpr int kMaxNbtDepth = 512;

// Types of the payload of a tag.
enum class NbtType : std::uint8_t {
    end,
    int8,
    int16,
    int32,
    int64,
    float32,
    float64,
    bytes,
    text,
    list,
    compound,
    ints,
    longs
};

struct NbtTag {
    NbtType type = NbtType::end;  // `end` closes a compound and has no name
    std::string name;
};

// A cursor over a file of Minecraft: Named Binary Tag (minecraft.wiki, "NBT format"), big endian, gzipped or
// not. Nothing of the file is held but a few kilobytes, so whoever needs two parts in another order reads it
// twice. All functions throw VoxRefusal, whose offset counts unpacked bytes. Debian has no library for this
// format; zlib unpacks.
class NbtReader {
  public:
    explicit NbtReader(std::span<const std::byte> file);
    ~NbtReader();
    NbtReader(const NbtReader&) = delete;
    NbtReader& operator=(const NbtReader&) = delete;

    [[nodiscard]] std::size_t offset() const { return static_cast<std::size_t>(offset_); }

    [[nodiscard]] NbtTag next_tag();
    // As next_tag, for the whole file: a compound.
    void open_root();

    [[nodiscard]] std::uint8_t u8();
    [[nodiscard]] std::uint16_t u16() { return static_cast<std::uint16_t>(number(2)); }
    [[nodiscard]] std::int32_t i32() { return static_cast<std::int32_t>(number(4)); }
    [[nodiscard]] std::uint64_t u64() { return number(8); }
    // The head of an array: its length.
    [[nodiscard]] std::uint32_t count();
    // The head of a list: the type of its elements and their number.
    [[nodiscard]] std::pair<NbtType, std::uint32_t> list();
    // A text; what is beyond 256 bytes is left out.
    [[nodiscard]] std::string text();

    // Passes over a payload.
    void skip(NbtType type) { skip(type, 0); }
    // Refuses a tag of another type.
    void expect(const NbtTag& tag, NbtType type) const;
    // After the root: refuses a gzip stream that is cut off or damaged. Returns how many bytes follow.
    [[nodiscard]] std::uint64_t finish();

  private:
    struct Unpacker;

    [[nodiscard]] std::uint64_t number(int bytes);
    [[nodiscard]] bool refill();
    [[nodiscard]] NbtType type();
    void drop(std::uint64_t bytes);
    void skip(NbtType type, int depth);

    std::unique_ptr<Unpacker> unpacker_;  // of a gzipped file
    std::span<const std::byte> ready_;    // unpacked and not read
    std::uint64_t offset_ = 0;
};

}  // namespace voxilux

#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/printable.h"

namespace voxilux {

// Why a file is refused: a rule and the byte where it is broken. Always caught by read_vox and
// read_voxel_cells.
class VoxRefusal : public std::runtime_error {
  public:
    VoxRefusal(std::size_t offset, std::string_view rule)
        : std::runtime_error(fmt::format("at byte {}: {}", offset, rule)) {}
};

// A cursor over a range of a file. Reads little-endian values; throws VoxRefusal where the range is too
// short.
class VoxBytes {
  public:
    // `begin` and `end` are offsets in `file`; `what` names the range in messages: "XYZI".
    VoxBytes(std::span<const std::byte> file, std::size_t begin, std::size_t end, std::string what)
        : file_(file), at_(begin), end_(end), what_(std::move(what)) {}

    [[nodiscard]] std::size_t offset() const { return at_; }
    [[nodiscard]] std::size_t left() const { return end_ - at_; }
    [[nodiscard]] const std::string& what() const { return what_; }

    // The same range from an earlier offset on.
    [[nodiscard]] VoxBytes from(std::size_t offset) const { return {file_, offset, end_, what_}; }

    [[nodiscard]] std::span<const std::byte> bytes(std::size_t count, std::string_view name) {
        if (count > left())
            throw VoxRefusal(at_, fmt::format("{} needs {} bytes for its {} but has {} left",
                                              printable(what_), count, name, left()));
        const auto part = file_.subspan(at_, count);
        at_ += count;
        return part;
    }

    [[nodiscard]] std::uint8_t u8(std::string_view name) {
        return std::to_integer<std::uint8_t>(bytes(1, name)[0]);
    }

    [[nodiscard]] std::uint16_t u16(std::string_view name) {
        const auto b = bytes(2, name);
        return static_cast<std::uint16_t>(std::to_integer<unsigned>(b[0]) | std::to_integer<unsigned>(b[1])
                                                                                << 8);
    }

    [[nodiscard]] std::uint32_t u32(std::string_view name) {
        const auto b = bytes(4, name);
        std::uint32_t value = 0;
        for (std::size_t i = 0; i < 4; ++i)
            value |= std::to_integer<std::uint32_t>(b[i]) << (8 * i);
        return value;
    }

    [[nodiscard]] std::int32_t i32(std::string_view name) { return std::bit_cast<std::int32_t>(u32(name)); }

    [[nodiscard]] float f32(std::string_view name) { return std::bit_cast<float>(u32(name)); }

    // A count of `items` of at least `item_bytes` each: refused before anything is allocated for them.
    [[nodiscard]] std::uint32_t count(std::size_t item_bytes, std::string_view items) {
        const std::size_t start = at_;
        const std::uint32_t n = u32(items);
        const std::size_t room = left() / item_bytes;
        if (n > room)
            throw VoxRefusal(start, fmt::format("{} holds {} {} but the chunk has room for {}",
                                                printable(what_), n, items, room));
        return n;
    }

    [[nodiscard]] std::string string() {
        const std::uint32_t length = count(1, "bytes of text");
        const auto b = bytes(length, "text");
        return {reinterpret_cast<const char*>(b.data()), b.size()};
    }

  private:
    std::span<const std::byte> file_;
    std::size_t at_ = 0;
    std::size_t end_ = 0;
    std::string what_;
};

}  // namespace voxilux

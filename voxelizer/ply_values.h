#pragma once

// The header of a .ply file, and its values one by one, in text or binary (G. Turk, "The PLY Polygon File
// Format", 1994).

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace voxilux {

enum class PlyType : std::uint8_t { i8, u8, i16, u16, i32, u32, f32, f64 };

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::f32;  // of a list: of its items
    bool is_list = false;
    PlyType count_type = PlyType::u8;  // of a list
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
};

enum class PlyForm : std::uint8_t { text, little_endian, big_endian };

struct PlyHeader {
    PlyForm form = PlyForm::text;
    std::vector<PlyElement> elements;
    std::size_t bytes = 0;  // after which the values begin
};

// Throws MeshFault, also where the elements need more bytes than the file has.
[[nodiscard]] PlyHeader read_ply_header(std::span<const std::byte> file);

// The largest value of a type, which stands for a colour of 1.
[[nodiscard]] double full_scale(PlyType type);

class PlyValues {
  public:
    PlyValues(std::span<const std::byte> file, const PlyHeader& header)
        : file_(file), form_(header.form), at_(header.bytes) {}

    // The next value. Throws MeshFault at the end of the file and at a word that is not a number.
    [[nodiscard]] double next(PlyType type);

    // The number of items of a list, each of which takes at least a byte.
    [[nodiscard]] std::uint64_t next_count(PlyType type);

    void skip(const PlyProperty& property);

  private:
    [[nodiscard]] double next_word();

    std::span<const std::byte> file_;
    PlyForm form_;
    std::size_t at_ = 0;
};

}  // namespace voxilux

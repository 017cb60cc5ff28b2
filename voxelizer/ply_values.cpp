#include "voxelizer/ply_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>

#include "base/printable.h"
#include "voxelizer/load_mesh.h"
#include "voxelizer/obj_text.h"

namespace voxilux {
namespace {

constexpr std::size_t kMaxHeaderBytes = 1 << 16;
constexpr std::size_t kMaxProperties = 256;  // of all elements

struct PlyTypeRow {
    std::string_view name, other_name;
    std::size_t bytes = 0;
    double full = 1.0;
};

// In the order of PlyType.
constexpr std::array<PlyTypeRow, 8> kPlyTypes = {{{"char", "int8", 1, 127.0},
                                                  {"uchar", "uint8", 1, 255.0},
                                                  {"short", "int16", 2, 32767.0},
                                                  {"ushort", "uint16", 2, 65535.0},
                                                  {"int", "int32", 4, 2147483647.0},
                                                  {"uint", "uint32", 4, 4294967295.0},
                                                  {"float", "float32", 4, 1.0},
                                                  {"double", "float64", 8, 1.0}}};

const PlyTypeRow& ply_row(PlyType type) {
    return kPlyTypes[static_cast<std::size_t>(type)];
}

PlyType type_named(std::string_view name, const ObjLines& lines) {
    const auto found = std::ranges::find_if(
        kPlyTypes, [&](const PlyTypeRow& row) { return row.name == name || row.other_name == name; });
    if (found == kPlyTypes.end()) lines.refuse(fmt::format("{} is no type of a value", quoted_name(name)));
    return static_cast<PlyType>(found - kPlyTypes.begin());
}

PlyForm read_form(ObjLines& lines) {
    const std::string name(lines.next_word());
    if (lines.next_word() != "1.0") lines.refuse("the version of the format is not 1.0");
    if (name == "ascii") return PlyForm::text;
    if (name == "binary_little_endian") return PlyForm::little_endian;
    if (name == "binary_big_endian") return PlyForm::big_endian;
    lines.refuse(fmt::format("{} is no format of a .ply file", quoted_name(name)));
}

PlyElement read_element(ObjLines& lines) {
    PlyElement element{.name = std::string(lines.next_word())};
    const std::string_view word = lines.next_word();
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), element.count);
    if (error != std::errc() || end != word.data() + word.size() || element.name.empty())
        lines.refuse("an element needs a name and a number");
    return element;
}

PlyProperty read_property(ObjLines& lines) {
    PlyProperty property;
    std::string_view word = lines.next_word();
    property.is_list = word == "list";
    if (property.is_list) {
        property.count_type = type_named(lines.next_word(), lines);
        if (property.count_type >= PlyType::f32) lines.refuse("the length of a list is no whole number");
        word = lines.next_word();
    }
    property.type = type_named(word, lines);
    property.name = lines.next_word();
    if (property.name.empty()) lines.refuse("a property has no name");
    return property;
}

// The text up to the line "end_header", and where the values begin.
std::string_view header_text(std::span<const std::byte> file, std::size_t& bytes) {
    const std::string_view text(reinterpret_cast<const char*>(file.data()),
                                std::min(file.size(), kMaxHeaderBytes));
    if (!text.starts_with("ply\n") && !text.starts_with("ply\r\n"))
        throw MeshFault("not a .ply file: it does not begin with 'ply'");
    const std::size_t last = text.find("\nend_header");
    const std::size_t end = last == std::string_view::npos ? last : text.find('\n', last + 1);
    if (end == std::string_view::npos)
        throw MeshFault(fmt::format("there is no end_header in the first {} bytes", kMaxHeaderBytes));
    bytes = end + 1;
    return text.substr(0, last + 1);
}

// An item of text takes at least a digit and a separator.
void check_room(const PlyHeader& header, std::size_t left) {
    for (const PlyElement& element : header.elements) {
        std::uint64_t least = 0;
        for (const PlyProperty& property : element.properties)
            least += header.form == PlyForm::text
                         ? 2
                         : ply_row(property.is_list ? property.count_type : property.type).bytes;
        if (least == 0 ? element.count > 0 : element.count > (std::uint64_t{left} + 1) / least)
            throw MeshFault(fmt::format("{} elements {} need more than the {} bytes that are left",
                                        element.count, quoted_name(element.name), left));
    }
}

}  // namespace

double full_scale(PlyType type) {
    return ply_row(type).full;
}

PlyHeader read_ply_header(std::span<const std::byte> file) {
    PlyHeader header;
    ObjLines lines(header_text(file, header.bytes), LineRules::plain);
    (void)lines.next_line();  // "ply"
    bool has_form = false;
    std::size_t properties = 0;
    while (lines.next_line()) {
        const std::string_view key = lines.next_word();
        if (key == "format") {
            header.form = read_form(lines);
            has_form = true;
        } else if (key == "element") {
            if (++properties > kMaxProperties) lines.refuse("there are too many elements");
            header.elements.push_back(read_element(lines));
        } else if (key == "property") {
            if (header.elements.empty() || ++properties > kMaxProperties)
                lines.refuse("a property without an element, or too many");
            header.elements.back().properties.push_back(read_property(lines));
        } else if (key != "comment" && key != "obj_info") {
            lines.refuse(fmt::format("{} is no word of a .ply header", quoted_name(key)));
        }
    }
    if (!has_form) throw MeshFault("the header names no format");
    check_room(header, file.size() - header.bytes);
    return header;
}

double PlyValues::next_word() {
    const auto is_blank = [&](std::size_t at) {
        const char c = static_cast<char>(file_[at]);
        return c == ' ' || c == '\n' || c == '\r' || c == '\t';
    };
    while (at_ < file_.size() && is_blank(at_))
        ++at_;
    const std::size_t first = at_;
    while (at_ < file_.size() && !is_blank(at_))
        ++at_;
    const std::string_view word(reinterpret_cast<const char*>(file_.data()) + first, at_ - first);
    const auto number = number_in(word);
    if (!number) throw MeshFault(fmt::format("at byte {}: {} is not a number", first, quoted_name(word)));
    return *number;
}

double PlyValues::next(PlyType type) {
    if (form_ == PlyForm::text) return next_word();
    const std::size_t size = ply_row(type).bytes;
    if (size > file_.size() - at_) throw MeshFault(fmt::format("the file ends at byte {}, too early", at_));
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < size; ++i) {
        const std::size_t shift = 8 * (form_ == PlyForm::little_endian ? i : size - 1 - i);
        bits |= std::to_integer<std::uint64_t>(file_[at_ + i]) << shift;
    }
    at_ += size;
    switch (type) {
        case PlyType::i8:
            return static_cast<std::int8_t>(bits);
        case PlyType::i16:
            return static_cast<std::int16_t>(bits);
        case PlyType::i32:
            return static_cast<std::int32_t>(bits);
        case PlyType::f32:
            return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
        case PlyType::f64:
            return std::bit_cast<double>(bits);
        default:
            return static_cast<double>(bits);
    }
}

std::uint64_t PlyValues::next_count(PlyType type) {
    const std::size_t start = at_;
    const double count = next(type);
    if (!(count >= 0.0 && count <= static_cast<double>(file_.size() - at_)) || count != std::floor(count))
        throw MeshFault(fmt::format("at byte {}: a list of {} items where {} bytes are left", start, count,
                                    file_.size() - at_));
    return static_cast<std::uint64_t>(count);
}

void PlyValues::skip(const PlyProperty& property) {
    const std::uint64_t count = property.is_list ? next_count(property.count_type) : 1;
    for (std::uint64_t i = 0; i < count; ++i)
        (void)next(property.type);
}

}  // namespace voxilux

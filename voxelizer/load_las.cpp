// Format: "LAS Specification 1.4 - R15" (ASPRS, 2019), tables 3 to 16. Only the public header and the fields
// of a point that are needed are read. Debian 12 has no library for LAS or LAZ.

#include "voxelizer/load_las.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "base/colour.h"

namespace voxilux {
namespace {

constexpr std::size_t kMinHeaderBytes = 227, kHeaderBytesOf14 = 375;
constexpr std::uint8_t kCompressedBit = 0x80;

// Bytes of a point and where its red, green and blue stand; 0: it has none.
struct PointFormat {
    std::size_t bytes = 0, colours = 0;
};
constexpr std::array<PointFormat, 11> kPointFormats{{{20, 0},
                                                     {28, 0},
                                                     {26, 20},
                                                     {34, 28},
                                                     {57, 0},
                                                     {63, 28},
                                                     {30, 0},
                                                     {36, 30},
                                                     {38, 30},
                                                     {59, 0},
                                                     {67, 30}}};

// A value in the file, which is little endian as the machines are that we run on.
template <class T>
T value_at(std::span<const std::byte> bytes, std::size_t offset) {
    T value;
    std::memcpy(&value, bytes.subspan(offset, sizeof(T)).data(), sizeof(T));
    return value;
}

struct LasHeader {
    PointFormat format;
    std::size_t first = 0, stride = 0;  // of the points, bytes
    std::uint64_t points = 0;
    glm::dvec3 scale{1.0}, offset{0.0};
};

PointFormat point_format(std::uint8_t number) {
    if ((number & kCompressedBit) != 0)
        throw MeshFault("the points are compressed (LAZ); laszip makes a .las file of them");
    if (number >= kPointFormats.size()) throw MeshFault(fmt::format("point format {} is not read", number));
    return kPointFormats[number];
}

LasHeader read_las_header(std::span<const std::byte> bytes) {
    if (bytes.size() < kMinHeaderBytes || std::memcmp(bytes.data(), "LASF", 4) != 0)
        throw MeshFault("not a LAS file: it does not begin with LASF and a header");
    const int version = 10 * value_at<std::uint8_t>(bytes, 24) + value_at<std::uint8_t>(bytes, 25);
    if (version < 10 || version > 14) throw MeshFault("the version is not LAS 1.0 to 1.4");
    LasHeader header{.format = point_format(value_at<std::uint8_t>(bytes, 104)),
                     .first = value_at<std::uint32_t>(bytes, 96),
                     .stride = value_at<std::uint16_t>(bytes, 105),
                     .points = value_at<std::uint32_t>(bytes, 107)};
    if (version == 14 && bytes.size() >= kHeaderBytesOf14)
        header.points = std::max(header.points, value_at<std::uint64_t>(bytes, 247));
    for (int axis = 0; axis < 3; ++axis) {
        header.scale[axis] = value_at<double>(bytes, 131 + 8 * static_cast<std::size_t>(axis));
        header.offset[axis] = value_at<double>(bytes, 155 + 8 * static_cast<std::size_t>(axis));
    }
    return header;
}

void check(const LasHeader& header, std::size_t file_bytes, const MeshRequest& request) {
    if (header.points == 0) throw MeshFault("there is no point");
    if (header.points > request.limits.vertices)
        throw MeshFault(fmt::format("over {} points are not read", request.limits.vertices));
    if (header.stride < header.format.bytes)
        throw MeshFault(
            fmt::format("a point has {} bytes, its format {}", header.stride, header.format.bytes));
    if (header.first > file_bytes || (file_bytes - header.first) / header.stride < header.points)
        throw MeshFault(fmt::format("the file is too short for {} points", header.points));
}

using Rgb16 = std::array<std::uint16_t, 3>;

Rgb16 colour_at(std::span<const std::byte> point, std::size_t offset) {
    return {value_at<std::uint16_t>(point, offset), value_at<std::uint16_t>(point, offset + 2),
            value_at<std::uint16_t>(point, offset + 4)};
}

// Colours have 16 bits, but many programs write only 8 of them. Both are sRGB, as in photographs.
void add_colours(std::span<const std::byte> points, const LasHeader& header, Mesh& mesh) {
    std::uint16_t largest = 0;
    for (std::uint64_t i = 0; i < header.points; ++i)
        largest = std::max(
            largest, std::ranges::max(colour_at(points.subspan(i * header.stride), header.format.colours)));
    const double full = largest > 255 ? 65535.0 : 255.0;
    mesh.colors.reserve(header.points);
    for (std::uint64_t i = 0; i < header.points; ++i) {
        glm::vec4 colour(1.0f);
        const Rgb16 codes = colour_at(points.subspan(i * header.stride), header.format.colours);
        for (int c = 0; c < 3; ++c)
            colour[c] = static_cast<float>(decode_srgb(codes[static_cast<std::size_t>(c)] / full));
        mesh.colors.push_back(colour);
    }
}

}  // namespace

Mesh load_las(std::span<const std::byte> bytes, const std::filesystem::path&, const MeshRequest& request,
              MeshNotes&) {
    const LasHeader header = read_las_header(bytes);
    check(header, bytes.size(), request);
    const std::span<const std::byte> points = bytes.subspan(header.first);
    Mesh mesh;
    mesh.is_z_up = true;
    mesh.materials.push_back({.name = "default", .metallic = 0.0f});
    mesh.positions.reserve(header.points);
    for (std::uint64_t i = 0; i < header.points; ++i) {
        const std::span<const std::byte> point = points.subspan(i * header.stride);
        mesh.positions.emplace_back(value_at<std::int32_t>(point, 0), value_at<std::int32_t>(point, 4),
                                    value_at<std::int32_t>(point, 8));
        mesh.positions.back() = mesh.positions.back() * header.scale + header.offset;
    }
    if (header.format.colours != 0) add_colours(points, header, mesh);
    return mesh;
}

}  // namespace voxilux

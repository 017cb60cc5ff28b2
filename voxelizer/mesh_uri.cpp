#include "voxelizer/mesh_uri.h"

#include <fmt/format.h>

#include <cstdint>
#include <optional>

#include "base/printable.h"
#include "voxelizer/load_mesh.h"

namespace voxilux {
namespace {

std::optional<unsigned> sextet(char c) {
    if (c >= 'A' && c <= 'Z') return static_cast<unsigned>(c - 'A');
    if (c >= 'a' && c <= 'z') return static_cast<unsigned>(c - 'a') + 26;
    if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0') + 52;
    if (c == '+') return 62;
    if (c == '/') return 63;
    return std::nullopt;
}

std::optional<unsigned> hex_digit(char c) {
    if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0');
    if (c >= 'a' && c <= 'f') return static_cast<unsigned>(c - 'a') + 10;
    if (c >= 'A' && c <= 'F') return static_cast<unsigned>(c - 'A') + 10;
    return std::nullopt;
}

}  // namespace

bool is_data_uri(std::string_view uri) {
    return uri.starts_with("data:");
}

std::vector<std::byte> decode_data_uri(std::string_view uri) {
    const std::size_t comma = uri.find(',');
    if (comma == std::string_view::npos || !uri.substr(0, comma).ends_with(";base64"))
        throw MeshFault("a data URI is not base64");
    std::string_view text = uri.substr(comma + 1);
    for (int i = 0; i < 2 && text.ends_with('='); ++i)
        text.remove_suffix(1);
    if (text.size() % 4 == 1) throw MeshFault("the base64 text of a data URI is cut off");
    std::vector<std::byte> bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t bits = 0;
    int held = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto value = sextet(text[i]);
        if (!value) throw MeshFault(fmt::format("the base64 text of a data URI breaks at character {}", i));
        bits = (bits << 6 | *value) & 0xFFFFu;
        held += 6;
        if (held < 8) continue;
        held -= 8;
        bytes.push_back(static_cast<std::byte>(bits >> held & 0xFFu));
    }
    return bytes;
}

std::string percent_decoded(std::string_view uri) {
    std::string text;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        char c = uri[i];
        if (c == '%') {
            const auto high = i + 2 < uri.size() ? hex_digit(uri[i + 1]) : std::nullopt;
            const auto low = high ? hex_digit(uri[i + 2]) : std::nullopt;
            if (!low) throw MeshFault(fmt::format("the URI {} has a broken %", quoted_name(uri)));
            c = static_cast<char>(*high << 4 | *low);
            i += 2;
        }
        if (c == '\0') throw MeshFault(fmt::format("the URI {} holds a zero byte", quoted_name(uri)));
        text += c;
    }
    return text;
}

std::filesystem::path path_inside(const std::filesystem::path& folder, const std::string& relative) {
    const std::filesystem::path path = std::filesystem::path(relative).lexically_normal();
    const std::size_t colon = relative.find(':');
    const bool has_scheme = colon != std::string::npos && relative.find('/') > colon;
    if (relative.empty() || path.is_absolute() || has_scheme || relative.find('\\') != std::string::npos)
        throw MeshFault(fmt::format("{} is not a path relative to the file", quoted_name(relative)));
    if (path.begin() != path.end() && *path.begin() == "..")
        throw MeshFault(fmt::format("{} leaves the folder of the file", quoted_name(relative)));
    return folder / path;
}

}  // namespace voxilux

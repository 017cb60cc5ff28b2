#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace voxilux {

// The bytes of a data URI's base64 text (RFC 2397, RFC 4648: padding is optional, white space is not
// allowed). Throws MeshFault for anything else.
[[nodiscard]] std::vector<std::byte> decode_data_uri(std::string_view uri);

[[nodiscard]] bool is_data_uri(std::string_view uri);

// A URI reference with %XX decoded (RFC 3986). Throws MeshFault for an invalid %XX and for a zero byte.
[[nodiscard]] std::string percent_decoded(std::string_view uri);

// `relative` inside `folder`. Throws MeshFault when it is empty, absolute, has a scheme, or leaves the folder
// by "..": a mesh file must not name files elsewhere on the machine.
[[nodiscard]] std::filesystem::path path_inside(const std::filesystem::path& folder,
                                                const std::string& relative);

}  // namespace voxilux

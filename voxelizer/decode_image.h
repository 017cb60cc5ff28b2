#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace voxilux {

// Width and height that a PNG or JPEG file says; nothing for a file of another kind.
[[nodiscard]] std::optional<glm::ivec2> image_size(std::span<const std::byte> bytes);

// The texels of a PNG or JPEG file, row by row from the top; nothing for a broken file, and for one that
// unpacks into far more than its size says: memory stays below 32 bytes a texel, 4 a byte of the file, and 1
// MiB.
[[nodiscard]] std::optional<std::vector<glm::u8vec4>> decode_image(std::span<const std::byte> bytes);

}  // namespace voxilux

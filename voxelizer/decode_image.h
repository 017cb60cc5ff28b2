#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace voxilux {

// Width and height from the header of a PNG or JPEG file; nothing for other files.
[[nodiscard]] std::optional<glm::ivec2> image_size(std::span<const std::byte> bytes);

// The texels of a PNG or JPEG file, row by row from the top; nothing for a broken file, or for one that
// unpacks to far more than its header says: memory stays below 32 bytes a texel, plus 4 per byte of the file,
// plus 1 MiB.
[[nodiscard]] std::optional<std::vector<glm::u8vec4>> decode_image(std::span<const std::byte> bytes);

}  // namespace voxilux

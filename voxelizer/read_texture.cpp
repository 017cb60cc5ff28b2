#include "voxelizer/read_texture.h"

#include <fmt/format.h>

#include "base/printable.h"
#include "voxelizer/decode_image.h"

namespace voxilux {

Texture decode_texture(std::span<const std::byte> bytes, const std::string& name, TexelBudget& budget) {
    const auto refuse = [&](const std::string& reason) {
        throw MeshFault(fmt::format("image {}: {}", quoted_name(name), reason));
    };
    const auto size = image_size(bytes);
    if (!size) refuse("it is not a readable PNG or JPEG");
    const std::uint64_t texels = static_cast<std::uint64_t>(size->x) * static_cast<std::uint64_t>(size->y);
    if (texels > budget.limits.texels_per_image || texels > budget.limits.texels - budget.taken)
        refuse(fmt::format("{} x {} texels are more than are read", size->x, size->y));
    auto decoded = decode_image(bytes);
    if (!decoded) refuse("it is broken");
    budget.taken += texels;
    return {.name = name, .size = *size, .texels = std::move(*decoded)};
}

}  // namespace voxilux

#include "voxelize/read_texture.h"

#include <fmt/format.h>
#include <stb_image.h>

#include <cstring>
#include <limits>
#include <memory>

#include "voxelize/mesh_notes.h"

namespace voxilux {

Texture decode_texture(std::span<const std::byte> bytes, const std::string& name, TexelBudget& budget) {
    const auto refuse = [&](const std::string& reason) {
        throw MeshFault(fmt::format("image {}: {}", quoted_name(name), reason));
    };
    if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) refuse("over 2 GiB");
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int size = static_cast<int>(bytes.size());
    int width = 0, height = 0, channels = 0;
    if (stbi_info_from_memory(data, size, &width, &height, &channels) == 0 || width < 1 || height < 1)
        refuse("it is not a readable PNG or JPEG");
    const std::uint64_t texels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    if (texels > budget.limits.texels_per_image || texels > budget.limits.texels - budget.taken)
        refuse(fmt::format("{} x {} texels are more than are read", width, height));
    const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> codes(
        stbi_load_from_memory(data, size, &width, &height, &channels, 4), &stbi_image_free);
    if (codes == nullptr) refuse("it cannot be decoded");
    budget.taken += texels;
    Texture texture{.name = name, .size = glm::ivec2(width, height), .texels = {}};
    texture.texels.resize(static_cast<std::size_t>(texels));
    std::memcpy(texture.texels.data(), codes.get(), texture.texels.size() * sizeof(glm::u8vec4));
    return texture;
}

}  // namespace voxilux

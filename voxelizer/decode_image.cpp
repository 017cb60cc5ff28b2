#include "voxelizer/decode_image.h"

// The decoder is compiled here instead of using the system's library, because it allocates as much memory as
// a file claims to need: a PNG of 100 bytes can request 2 GiB. Here its memory comes from a budget, and it
// supports only the two formats of glTF.

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>

namespace {

constexpr std::size_t kFront = alignof(std::max_align_t);  // holds the size of a block

thread_local std::size_t bytes_left = 0;

std::size_t size_of(void* block) {
    std::size_t size = 0;
    std::memcpy(&size, static_cast<char*>(block) - kFront, sizeof size);
    return size;
}

void* take(std::size_t size) {
    if (size > bytes_left) return nullptr;
    auto* block = static_cast<char*>(std::malloc(size + kFront));
    if (block == nullptr) return nullptr;
    bytes_left -= size;
    std::memcpy(block, &size, sizeof size);
    return block + kFront;
}

void give_back(void* block) {
    if (block == nullptr) return;
    bytes_left += size_of(block);
    std::free(static_cast<char*>(block) - kFront);
}

void* change(void* block, std::size_t size) {
    void* larger = take(size);
    if (larger == nullptr || block == nullptr) return larger;
    std::memcpy(larger, block, std::min(size_of(block), size));
    give_back(block);
    return larger;
}

}  // namespace

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_MALLOC(size) take(size)
#define STBI_REALLOC(block, size) change(block, size)
#define STBI_FREE(block) give_back(block)
#include <stb_image.h>

namespace voxilux {
namespace {

constexpr std::size_t kBytesPerTexel = 32;
constexpr std::size_t kBytesPerFileByte = 4;
constexpr std::size_t kFixedBytes = std::size_t{1} << 20;

// A progressive JPEG passes over all texels once per scan, however short the scan is. Encoders write about
// ten.
constexpr int kMaxScans = 64;

bool has_too_many_scans(std::span<const std::byte> bytes) {
    if (bytes.empty() || bytes[0] != std::byte{0xFF}) return false;
    int scans = 0;
    for (std::size_t i = 0; i + 1 < bytes.size(); ++i) {
        if (bytes[i] == std::byte{0xFF} && bytes[i + 1] == std::byte{0xDA}) ++scans;
    }
    return scans > kMaxScans;
}

const stbi_uc* codes_of(std::span<const std::byte> bytes) {
    return reinterpret_cast<const stbi_uc*>(bytes.data());
}

}  // namespace

std::optional<glm::ivec2> image_size(std::span<const std::byte> bytes) {
    if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) return std::nullopt;
    bytes_left = kFixedBytes;
    glm::ivec2 size(0);
    int channels = 0;
    const int is_known =
        stbi_info_from_memory(codes_of(bytes), static_cast<int>(bytes.size()), &size.x, &size.y, &channels);
    if (is_known == 0 || size.x < 1 || size.y < 1) return std::nullopt;
    return size;
}

std::optional<std::vector<glm::u8vec4>> decode_image(std::span<const std::byte> bytes) {
    const auto wanted = image_size(bytes);
    if (!wanted || has_too_many_scans(bytes)) return std::nullopt;
    const std::size_t texels = static_cast<std::size_t>(wanted->x) * static_cast<std::size_t>(wanted->y);
    bytes_left = kFixedBytes + kBytesPerTexel * texels + kBytesPerFileByte * bytes.size();
    glm::ivec2 size(0);
    int channels = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> codes(
        stbi_load_from_memory(codes_of(bytes), static_cast<int>(bytes.size()), &size.x, &size.y, &channels,
                              4),
        &give_back);
    if (codes == nullptr || size != *wanted) return std::nullopt;
    std::vector<glm::u8vec4> result(texels);
    std::memcpy(result.data(), codes.get(), texels * sizeof(glm::u8vec4));
    return result;
}

}  // namespace voxilux

#include "vk/pipeline_cache.h"

#include <cstring>
#include <span>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "base/fnv.h"
#include "vk/check.h"

namespace voxilux {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxCacheBytes = std::size_t{256} << 20;
constexpr std::size_t kHashBytes = 8;

std::uint64_t hash_of(std::span<const std::byte> bytes) {
    std::uint64_t hash = kFnvStart;
    for (const std::byte byte : bytes)
        hash = fnv1a(hash, std::to_integer<std::uint64_t>(byte));
    return hash;
}

fs::path cache_path(const DeviceState& device, const fs::path& folder) {
    return folder / fmt::format("pipelines-{}.bin", device.uuid_hex);
}

bool is_for(const DeviceState& device, std::span<const std::byte> data) {
    VkPipelineCacheHeaderVersionOne header;
    if (data.size() < sizeof(header)) return false;
    std::memcpy(&header, data.data(), sizeof(header));
    return header.headerVersion == VK_PIPELINE_CACHE_HEADER_VERSION_ONE &&
           header.vendorID == device.properties.vendorID && header.deviceID == device.properties.deviceID &&
           std::memcmp(header.pipelineCacheUUID, device.properties.pipelineCacheUUID, VK_UUID_SIZE) == 0;
}

// The driver's data from a valid file, which holds a hash and then the data. Empty for any other file.
std::vector<std::byte> read_cache(const DeviceState& device, const fs::path& folder) {
    std::error_code status;
    if (folder.empty() || !fs::is_regular_file(cache_path(device, folder), status)) return {};
    try {
        const std::vector<std::byte> file = read_file(cache_path(device, folder), kMaxCacheBytes);
        std::uint64_t hash = 0;
        if (file.size() < kHashBytes) return {};
        std::memcpy(&hash, file.data(), kHashBytes);
        const auto data = std::span(file).subspan(kHashBytes);
        if (hash != hash_of(data) || !is_for(device, data)) return {};
        return {data.begin(), data.end()};
    } catch (const Error&) {
        return {};
    }
}

}  // namespace

UniquePipelineCache load_pipeline_cache(const DeviceState& device, const fs::path& folder) {
    const std::vector<std::byte> data = read_cache(device, folder);
    const VkPipelineCacheCreateInfo info{.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO,
                                         .initialDataSize = data.size(),
                                         .pInitialData = data.data()};
    VkPipelineCache cache = VK_NULL_HANDLE;
    vk_check(vkCreatePipelineCache(device.handle, &info, nullptr, &cache), "create the pipeline cache");
    set_debug_name(device, VK_OBJECT_TYPE_PIPELINE_CACHE, to_bits(cache), "executor.pipelines");
    return {device.handle, cache};
}

void save_pipeline_cache(const DeviceState& device, VkPipelineCache cache, const fs::path& folder) {
    std::size_t size = 0;
    if (vkGetPipelineCacheData(device.handle, cache, &size, nullptr) != VK_SUCCESS) return;
    std::vector<std::byte> file(kHashBytes + size);
    if (vkGetPipelineCacheData(device.handle, cache, &size, file.data() + kHashBytes) != VK_SUCCESS) return;
    file.resize(kHashBytes + size);
    const std::uint64_t hash = hash_of(std::span(file).subspan(kHashBytes));
    std::memcpy(file.data(), &hash, kHashBytes);
    std::error_code status;
    fs::create_directories(folder, status);
    try {
        write_file_atomically(cache_path(device, folder), file);
    } catch (const Error&) {
    }
}

}  // namespace voxilux

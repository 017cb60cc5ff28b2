#include "jobs/price_list/reference_cache.h"

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <string_view>
#include <system_error>

#include "base/error.h"
#include "base/fnv.h"
#include "base/json.h"
#include "formats/exr.h"

namespace voxilux {
namespace {

namespace fs = std::filesystem;

constexpr const char* kAttribute = "voxilux.reference";
constexpr std::array<const char*, 3> kColours = {"R", "G", "B"};

std::string hash_of(const Image& image) {
    std::uint64_t hash = kFnvStart;
    for (const char* name : kColours) {
        for (const float value : image.channels.at(name).pixels)
            hash = fnv1a(hash, std::bit_cast<std::uint32_t>(value));
    }
    return fmt::format("{:016x}", hash);
}

fs::path file_of(const fs::path& folder, const std::string& key) {
    return folder / (key + ".exr");
}

}  // namespace

std::string cache_key(const std::string& what) {
    std::uint64_t hash = kFnvStart;
    for (const char c : what)
        hash = fnv1a(hash, static_cast<std::uint8_t>(c));
    return fmt::format("{:016x}", hash);
}

std::optional<CachedPicture> load_cached(const fs::path& folder, const std::string& key, int width,
                                         int height) {
    std::error_code ignored;
    if (folder.empty() || !fs::is_regular_file(file_of(folder, key), ignored)) return {};
    try {
        CachedPicture cached{.image = read_exr(file_of(folder, key))};
        cached.facts =
            parse_json<nlohmann::ordered_json>(cached.image.attributes.at(kAttribute)).value_or(nullptr);
        if (cached.image.width != width || cached.image.height != height || !colour_planes(cached.image))
            return {};
        if (cached.facts.at("key") != key || cached.facts.at("colours") != hash_of(cached.image)) return {};
        return cached;
    } catch (const Error&) {
    } catch (const nlohmann::json::exception&) {
    } catch (const std::out_of_range&) {
    }
    return {};
}

bool store_cached(const fs::path& folder, const std::string& key, const CachedPicture& picture) {
    if (folder.empty()) return false;
    Image image{.width = picture.image.width, .height = picture.image.height};
    for (const char* name : kColours)
        image.channels[name] = {Image::Precision::single, picture.image.channels.at(name).pixels};
    nlohmann::ordered_json facts = picture.facts;
    facts["key"] = key;
    facts["colours"] = hash_of(image);
    image.attributes[kAttribute] = json_text(facts);
    std::error_code failure;
    fs::create_directories(folder, failure);
    try {
        (void)write_exr(file_of(folder, key), image, {.reproducible = true});
        return true;
    } catch (const Error&) {
        return false;
    }
}

}  // namespace voxilux

#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "formats/image.h"

namespace voxilux {

// An expensive image, and what is known of it.
struct CachedPicture {
    Image image;  // R G B
    nlohmann::ordered_json facts;
};

// The name of an image's file: a hash of everything it depends on.
[[nodiscard]] std::string cache_key(const std::string& what);

// The image stored in `folder` under `key`; nothing when the file is missing, damaged, or of another size or
// image: a hash of the colours is stored beside them.
[[nodiscard]] std::optional<CachedPicture> load_cached(const std::filesystem::path& folder,
                                                       const std::string& key, int width, int height);

// Stores it completely or not at all. Returns false on failure, which only costs time.
bool store_cached(const std::filesystem::path& folder, const std::string& key, const CachedPicture& picture);

}  // namespace voxilux

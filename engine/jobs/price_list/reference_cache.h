#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "formats/image.h"

namespace voxilux {

// A picture that took long, and what is known of it.
struct CachedPicture {
    Image image;  // R G B
    nlohmann::ordered_json facts;
};

// The name of a picture's file: a hash of all that it depends on.
[[nodiscard]] std::string cache_key(const std::string& what);

// The picture stored in `folder` under `key`; nothing where there is none, or where the file is damaged, of
// another size or of another picture: a hash of the colours is stored beside them.
[[nodiscard]] std::optional<CachedPicture> load_cached(const std::filesystem::path& folder,
                                                       const std::string& key, int width, int height);

// Stores it whole or not at all. A picture that cannot be stored only costs time: false.
bool store_cached(const std::filesystem::path& folder, const std::string& key, const CachedPicture& picture);

}  // namespace voxilux

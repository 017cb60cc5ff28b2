#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene/sky_settings.h"

namespace voxilux {

// An EXR or a Radiance image, told apart by its first bytes, as an image of the sky. Values that are negative
// or no number count as 0, those above kMaxRadiance as that, and one warning tells how many texels have any.
// Throws Error(input_refused) for what cannot be read or has over kMaxSkyTexels texels.
[[nodiscard]] SkyImage load_sky_image(const std::filesystem::path& path, std::vector<std::string>& warnings);

}  // namespace voxilux

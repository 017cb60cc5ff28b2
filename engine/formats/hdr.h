#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "formats/image.h"
#include "scene/sky_settings.h"

namespace voxilux {

inline constexpr std::size_t kMaxHdrPixels = kMaxSkyTexels;

// Whether these bytes begin as a Radiance image does.
[[nodiscard]] bool is_hdr(std::span<const std::byte> bytes);

// A Radiance image (.hdr) as linear R G B, from bytes in memory; `name` stands for the file in messages.
// Throws Error(input_refused) for what cannot be read, other orientations than -Y +X and XYZE included.
// Source: G. Ward 1991, "Real Pixels", Graphics Gems II. Our own decoder, because stb_image up to 2.27 never
// returns from a file that ends within a run.
[[nodiscard]] Image decode_hdr(std::span<const std::byte> bytes, const std::string& name);

}  // namespace voxilux

#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "formats/image.h"

namespace voxilux {

// Caps of read_png and write_png.
inline constexpr int kMaxPngSide = 1 << 17;  // pixels, per axis
inline constexpr std::size_t kMaxPngBytes =
    std::size_t{1} << 30;  // decoded, 4 bytes a pixel; the library counts them in an int
inline constexpr std::size_t kMaxPngFileBytes = std::size_t{1} << 30;  // the file as it lies on disk

// Writes R G B (or Y as grey) and A, if there is one, as 8-bit sRGB; alpha is stored linear. Equal images
// give equal bytes. Values outside [0,1] are clamped and NaN is 0: tone map first. Throws
// Error(cannot_write).
void write_png(const std::filesystem::path& path, const Image& image);

// A PNG as linear colours R G B (A when the file has alpha), marked display_referred; grey is spread to R G B
// and 16 bits are reduced to 8. Throws Error(input_refused).
[[nodiscard]] Image read_png(const std::filesystem::path& path);

// As read_png, from bytes in memory; `name` stands for the file in messages.
[[nodiscard]] Image decode_png(std::span<const std::byte> bytes, const std::string& name);

}  // namespace voxilux

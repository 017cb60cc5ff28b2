#pragma once

#include <filesystem>

#include "formats/image.h"

namespace voxilux {

// An EXR or a PNG, told apart by its first bytes and not by its name; see read_exr and read_png. Throws
// Error(input_refused).
[[nodiscard]] Image read_image(const std::filesystem::path& path);

// Writes a PNG when the name ends in .png, else an EXR without a date; see write_exr and write_png. Throws
// Error(usage) for another ending and Error(cannot_write).
void write_image(const std::filesystem::path& path, const Image& image);

}  // namespace voxilux

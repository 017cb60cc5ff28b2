#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "formats/image.h"

namespace voxilux {

// The PNGs side by side, row by row, in cells as large as the largest of them, each in the middle of its
// cell: about as many columns as rows. What is between them is transparent where one of them has alpha, else
// black. Throws Error(input_refused) for a file that cannot be read.
[[nodiscard]] Image contact_sheet(std::span<const std::string> files);

}  // namespace voxilux

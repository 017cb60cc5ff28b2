#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "formats/image.h"

namespace voxilux {

// The PNGs side by side, row by row, each centred in a cell of the size of the largest, in about as many
// columns as rows. The space between them is transparent where one of them has alpha, else black. Throws
// Error(input_refused) for a file that cannot be read.
[[nodiscard]] Image contact_sheet(std::span<const std::string> files);

}  // namespace voxilux

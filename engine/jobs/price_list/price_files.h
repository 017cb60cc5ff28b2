#pragma once

#include <filesystem>

#include "jobs/price_list/price_list.h"

namespace voxilux {

// Writes tradeoff.json, tradeoff.csv and the pictures into a folder that is there, with a folder `pictures`
// in it; each file appears whole or not at all. Throws Error(cannot_write).
void write_price_list(const PriceList& list, const std::filesystem::path& folder);

}  // namespace voxilux

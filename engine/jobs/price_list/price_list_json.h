#pragma once

#include <nlohmann/json.hpp>

#include "jobs/price_list/price_list.h"

namespace voxilux {

// The price list as JSON; pictures are named as price_files writes them.
[[nodiscard]] nlohmann::ordered_json to_json(const PriceList& list);

}  // namespace voxilux

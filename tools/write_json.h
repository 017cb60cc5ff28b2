#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace voxilux {

// Writes JSON to a file, or to standard output for "-". Nothing for an empty name.
void write_json(const std::string& file, const nlohmann::ordered_json& json);

}  // namespace voxilux

#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

namespace voxilux {

// A value of a report that may be missing.
template <class T>
[[nodiscard]] nlohmann::ordered_json or_null(const std::optional<T>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

// A number of a report that may be infinite or not a number.
[[nodiscard]] inline nlohmann::ordered_json finite_or_null(double value) {
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

}  // namespace voxilux

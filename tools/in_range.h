#pragma once

#include <fmt/format.h>

#include <string_view>

#include "base/error.h"
#include "scene/settings.h"

namespace voxilux {

// The value of a flag. Throws Error(usage) when it is out of the range of the row `key` of `Settings`.
template <class Settings, class T>
T in_range(std::string_view flag, std::string_view key, T value) {
    const Range range = setting_of<Settings>(key).range;
    if (range.holds(static_cast<double>(value))) return value;
    throw Error(ExitCode::usage, fmt::format("{}: {} is not in {}", flag, value, to_string(range)));
}

}  // namespace voxilux

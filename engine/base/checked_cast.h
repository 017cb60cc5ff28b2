#pragma once

#include <string_view>
#include <type_traits>
#include <utility>

#include "base/assert.h"

namespace voxilux {

// Converts between integer types; throws InternalError with the value and its name when it does not fit.
template <class To, class From>
[[nodiscard]] constexpr To checked_cast(From value, std::string_view name) {
    static_assert(std::is_integral_v<To> && std::is_integral_v<From>);
    if (!std::in_range<To>(value))
        throw InternalError(fmt::format("internal error: {} = {} does not fit its type", name, value));
    return static_cast<To>(value);
}

}  // namespace voxilux

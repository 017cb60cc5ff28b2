#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <string_view>

#include "base/error.h"

namespace voxilux {

// The item of that name; Error(usage) with the known names when there is none. `kind` is used in the message;
// `name_of` is a member or a function of an item.
template <class Items, class NameOf>
[[nodiscard]] const auto& item_named(std::string_view kind, std::string_view name, const Items& items,
                                     NameOf name_of) {
    std::string known;
    for (const auto& item : items) {
        const std::string_view own = std::invoke(name_of, item);
        if (own == name) return item;
        known += fmt::format("{}{}", known.empty() ? "" : ", ", own);
    }
    throw Error(ExitCode::usage, fmt::format("no {} '{}'; there are {}", kind, name, known));
}

}  // namespace voxilux

#include "exit_message.h"

#include <new>

#include "base/printable.h"

namespace voxilux {

ExitMessage exit_message_of(const std::exception& error) {
    if (const auto* known = dynamic_cast<const Error*>(&error))
        return {known->code(), printable(known->what(), kUncut)};
    if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr)
        return {ExitCode::out_of_memory, "out of memory; try a smaller picture or scene"};
    if (dynamic_cast<const InternalError*>(&error) != nullptr) return {ExitCode::internal, error.what()};
    return {ExitCode::internal, fmt::format("internal error: {}", error.what())};
}

}  // namespace voxilux

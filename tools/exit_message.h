#pragma once

#include <exception>
#include <string>

#include "base/error.h"

namespace voxilux {

// How a command that threw ends: the code of the process, and one line for standard error.
struct ExitMessage {
    ExitCode code = ExitCode::internal;
    std::string text;
};

[[nodiscard]] ExitMessage exit_message_of(const std::exception& error);

}  // namespace voxilux

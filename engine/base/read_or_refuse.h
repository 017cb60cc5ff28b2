#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "base/error.h"
#include "base/printable.h"

namespace voxilux {

// Returns what `read` returns. Whatever a library throws becomes one line: the file, what it is not, and the
// library's message. `what` follows "not ", as in "a readable EXR".
template <class Read>
auto read_or_refuse(const std::string& file, std::string_view what, Read read) {
    try {
        return read();
    } catch (const Error&) {
        throw;
    } catch (const std::exception& cause) {
        throw Error(ExitCode::input_refused,
                    fmt::format("{}: not {}: {}", file, what, printable(cause.what())));
    }
}

}  // namespace voxilux

#pragma once

#include <functional>
#include <string>

#include "session/render_session.h"

namespace voxilux {

// How progress reaches standard error: one line that is overwritten ("auto" on a terminal), one JSON object per line
// ("json"), or nothing ("never", and "auto" when standard error is piped). Throws Error(usage) for another word.
[[nodiscard]] std::function<void(const Progress&)> progress_printer(const std::string& mode, bool quiet);

// Ends the overwritten line, if there is one.
void finish_progress(const std::string& mode, bool quiet);

// "90s", "2m", "1h30m", "1.5h" or plain seconds. Throws Error(usage).
[[nodiscard]] double parse_duration(const std::string& text);

// "1%" or "0.01". Throws Error(usage).
[[nodiscard]] double parse_error_target(const std::string& text);

}  // namespace voxilux

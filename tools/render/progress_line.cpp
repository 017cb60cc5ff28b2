#include "render/progress_line.h"

#include <unistd.h>

#include <charconv>
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/error.h"

namespace voxilux {
namespace {

constexpr double kPrintEvery_s = 0.1;

bool shows_line(const std::string& mode, bool quiet) {
    return mode == "auto" && !quiet && ::isatty(STDERR_FILENO) != 0;
}

void print_line(const Progress& progress) {
    std::string line = fmt::format("\r{:5.1f} %  sample {}  {:.0f} s, about {:.0f} s left", 100.0 * progress.done,
                                   progress.sample, progress.elapsed_s, progress.remaining_s);
    if (progress.error) line += fmt::format("  error {:.2g} %", 100.0 * *progress.error);
    fmt::print(stderr, "{}\x1b[K", line);
    std::fflush(stderr);
}

void print_json(const Progress& progress) {
    nlohmann::ordered_json json = {{"done", progress.done},
                                   {"sample", progress.sample},
                                   {"elapsed_s", progress.elapsed_s},
                                   {"remaining_s", progress.remaining_s}};
    if (progress.error) json["error"] = *progress.error;
    fmt::print(stderr, "{}\n", json.dump());
}

// A number and where it ends; Error(usage) when there is none.
std::pair<double, const char*> leading_number(const char* begin, const char* end, const std::string& complaint) {
    double value = 0.0;
    const auto [rest, error] = std::from_chars(begin, end, value);
    if (error != std::errc() || !(value >= 0.0)) throw Error(ExitCode::usage, complaint);
    return {value, rest};
}

}  // namespace

std::function<void(const Progress&)> progress_printer(const std::string& mode, bool quiet) {
    if (mode != "auto" && mode != "never" && mode != "json")
        throw Error(ExitCode::usage, fmt::format("--progress: '{}' is not auto, never or json", mode));
    const bool json = mode == "json";
    if (!json && !shows_line(mode, quiet)) return {};
    return [json, last = -1.0](const Progress& progress) mutable {
        if (progress.elapsed_s - last < kPrintEvery_s && progress.done < 1.0) return;
        last = progress.elapsed_s;
        json ? print_json(progress) : print_line(progress);
    };
}

void finish_progress(const std::string& mode, bool quiet) {
    if (shows_line(mode, quiet)) fmt::print(stderr, "\r\x1b[K");
}

double parse_duration(const std::string& text) {
    const std::string complaint = fmt::format("--time-limit: '{}' is not a time such as 90s, 2m or 1h30m", text);
    const char* at = text.data();
    const char* const end = at + text.size();
    double seconds = 0.0;
    if (text.empty()) throw Error(ExitCode::usage, complaint);
    while (at != end) {
        const auto [value, unit] = leading_number(at, end, complaint);
        const char letter = unit == end ? 's' : *unit;
        if (letter != 's' && letter != 'm' && letter != 'h') throw Error(ExitCode::usage, complaint);
        seconds += value * (letter == 'h' ? 3600.0 : letter == 'm' ? 60.0 : 1.0);
        at = unit == end ? end : unit + 1;
    }
    return seconds;
}

double parse_error_target(const std::string& text) {
    const std::string complaint = fmt::format("--error: '{}' is not a share such as 1% or 0.01", text);
    const char* const end = text.data() + text.size();
    const auto [value, rest] = leading_number(text.data(), end, complaint);
    const bool percent = rest != end && *rest == '%';
    if (rest + (percent ? 1 : 0) != end || value <= 0.0) throw Error(ExitCode::usage, complaint);
    return percent ? value / 100.0 : value;
}

}  // namespace voxilux

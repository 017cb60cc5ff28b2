#include "progress_line.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/json.h"
#include "base/print.h"
#include "jobs/forecast_report.h"

namespace voxilux {
namespace {

constexpr double kPrintEvery_s = 0.1;
constexpr std::size_t kUsualColumns = 80;

// A line that wraps cannot be overwritten.
std::size_t terminal_columns() {
    winsize size{};
    if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return kUsualColumns;
    return size.ws_col;
}

std::string duration_text(double seconds) {
    if (!std::isfinite(seconds)) return "?";
    const auto whole = static_cast<std::uint64_t>(std::llround(std::min(seconds, 1e9)));
    if (whole < 100) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
    return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

}  // namespace

std::string progress_text(const Progress& progress) {
    std::string text =
        progress.frames == 0 ? "" : fmt::format("frame {} of {}", progress.frame, progress.frames);
    text += fmt::format("{:5.1f} %  sample {}  {}, {} left", 100.0 * progress.done, progress.sample,
                        duration_text(progress.elapsed_s),
                        time_range_text(progress.remaining_low_s, progress.remaining_high_s));
    if (progress.error) text += fmt::format("  error {:.2g} %", 100.0 * *progress.error);
    if (progress.error_at_end) text += fmt::format(", {:.2g} % at the end", 100.0 * *progress.error_at_end);
    return text;
}

std::string progress_json(const Progress& progress) {
    nlohmann::ordered_json json = {{"done", progress.done},
                                   {"sample", progress.sample},
                                   {"elapsed_s", progress.elapsed_s},
                                   {"remaining_s", progress.remaining_s},
                                   {"remaining_low_s", progress.remaining_low_s},
                                   {"remaining_high_s", progress.remaining_high_s}};
    if (progress.frames != 0) {
        json["frame"] = progress.frame;
        json["frames"] = progress.frames;
    }
    if (progress.error) json["error"] = *progress.error;
    if (progress.error_at_end) json["error_at_end"] = *progress.error_at_end;
    return json_text(json);
}

ProgressLine::ProgressLine(ProgressMode mode, bool quiet) {
    if (mode == ProgressMode::json) form_ = Form::json;
    if (mode == ProgressMode::automatic && !quiet && ::isatty(STDERR_FILENO) != 0) form_ = Form::line;
}

std::function<void(const Progress&)> ProgressLine::callback() {
    if (form_ == Form::nothing) return {};
    return [this](const Progress& progress) {
        show(progress.done, progress.elapsed_s,
             [&](bool as_json) { return as_json ? progress_json(progress) : progress_text(progress); });
    };
}

void ProgressLine::show(double done, double elapsed_s, const std::function<std::string(bool)>& text) {
    if (form_ == Form::nothing || (elapsed_s - last_s_ < kPrintEvery_s && done < 1.0)) return;
    last_s_ = elapsed_s;
    if (form_ == Form::json) {
        print_message("{}\n", text(true));
    } else {
        print_message("\r{}\x1b[K", text(false).substr(0, terminal_columns() - 1));
        std::fflush(stderr);
        is_shown_ = true;
    }
}

void ProgressLine::finish() {
    if (is_shown_) std::fputs("\r\x1b[K", stderr);
    is_shown_ = false;
}

}  // namespace voxilux

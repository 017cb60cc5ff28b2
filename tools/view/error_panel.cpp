#include "view/error_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "view/panels.h"
#include "view/quality_choice.h"

namespace voxilux {
namespace {

const ImVec2 kPlotSize{260.0f, 130.0f};
constexpr ImU32 kGridColour = IM_COL32(255, 255, 255, 40);
constexpr ImU32 kCurveColour = IM_COL32(120, 170, 255, 255);
constexpr ImU32 kPointColour = IM_COL32(255, 200, 40, 255);
constexpr ImU32 kAimColour = IM_COL32(120, 220, 120, 200);
constexpr int kCurveSteps = 32;
constexpr double kUsualTarget = 0.01;

// Logarithmic axes: seconds to the right, errors up.
struct Plot {
    ImVec2 corner;
    glm::dvec2 low{0.0};  // powers of ten
    glm::dvec2 high{0.0};

    [[nodiscard]] ImVec2 place(double seconds, double error) const {
        const glm::dvec2 at{std::log10(std::max(seconds, 1e-9)), std::log10(std::max(error, 1e-9))};
        const glm::dvec2 share = glm::clamp((at - low) / (high - low), 0.0, 1.0);
        return {corner.x + static_cast<float>(share.x) * kPlotSize.x,
                corner.y + static_cast<float>(1.0 - share.y) * kPlotSize.y};
    }
};

// The axes span whole decades around all points, and around the target with the time it will take.
Plot plot_of(const LiveErrors& errors, double target) {
    const LiveError& first = errors.points().front();
    const double ahead_s = errors.seconds_until(target).value_or(9.0 * errors.seconds());
    const double last_s = errors.seconds() + std::min(ahead_s, 1e5);
    const double lowest = std::min(target, errors.points().back().error);
    return {.corner = ImGui::GetCursorScreenPos(),
            .low = {std::floor(std::log10(first.seconds)), std::floor(std::log10(lowest))},
            .high = {std::ceil(std::log10(last_s) + 0.01), std::ceil(std::log10(first.error) + 0.01)}};
}

void draw_grid(const Plot& plot, ImDrawList& list) {
    for (double decade = plot.low.x; decade < plot.high.x; ++decade) {
        const double seconds = std::pow(10.0, decade);
        const ImVec2 top = plot.place(seconds, std::pow(10.0, plot.high.y));
        list.AddLine(top, {top.x, plot.corner.y + kPlotSize.y}, kGridColour);
        list.AddText({top.x + 2.0f, plot.corner.y + kPlotSize.y - 14.0f}, IM_COL32_WHITE,
                     fmt::format("{:g} s", seconds).c_str());
    }
    for (double decade = plot.high.y; decade > plot.low.y; --decade) {
        const ImVec2 left = plot.place(0.0, std::pow(10.0, decade));
        list.AddLine(left, {plot.corner.x + kPlotSize.x, left.y}, kGridColour);
        list.AddText({left.x + 2.0f, left.y}, IM_COL32_WHITE,
                     fmt::format("{:g} %", std::pow(10.0, decade + 2.0)).c_str());
    }
}

void draw_plot(const LiveErrors& errors, double target) {
    const Plot plot = plot_of(errors, target);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    draw_grid(plot, list);
    const LiveError& last = errors.points().back();
    const double sample_s = last.seconds / last.samples;
    std::vector<ImVec2> curve;
    for (int i = 0; i <= kCurveSteps; ++i) {
        const double decade = plot.low.x + (plot.high.x - plot.low.x) * i / kCurveSteps;
        const double seconds = std::pow(10.0, decade);
        if (const auto error = errors.expected(std::max(seconds / sample_s, 1.0)))
            curve.push_back(plot.place(seconds, *error));
    }
    list.AddPolyline(curve.data(), static_cast<int>(curve.size()), kCurveColour, 0, 1.5f);
    const ImVec2 aim = plot.place(0.0, target);
    list.AddLine(aim, {plot.corner.x + kPlotSize.x, aim.y}, kAimColour);
    for (const LiveError& point : errors.points())
        list.AddCircleFilled(plot.place(point.seconds, point.error), 3.0f, kPointColour, 8);
    ImGui::Dummy(kPlotSize);
}

std::string preset_line(const QualityPreset& preset, bool sends_photons) {
    const QualityPrice& price = price_of(preset, sends_photons);
    return fmt::format("{}: {} samples, about {:.2g} %", preset.name, price.samples, 100.0 * price.error);
}

void draw_quality(ViewState& state) {
    const bool sends_photons = state.picture.rest_plan().photons.runs();
    const std::string shown = state.quality != nullptr ? std::string(state.quality->name) : "own";
    if (!ImGui::BeginCombo("quality", shown.c_str())) return;
    for (const QualityPreset& preset : quality_presets())
        if (ImGui::Selectable(preset_line(preset, sends_photons).c_str(), &preset == state.quality))
            choose_quality(preset, state);
    ImGui::EndCombo();
}

void draw_ends(ViewState& state) {
    float percent = static_cast<float>(100.0 * state.ends.error.value_or(0.0));
    if (ImGui::SliderFloat("error target", &percent, 0.0f, 20.0f, percent > 0.0f ? "%.2f %%" : "none",
                           ImGuiSliderFlags_Logarithmic)) {
        state.ends.error = percent > 0.0f ? std::optional(percent / 100.0) : std::nullopt;
        state.picture.set_ends(state.ends);
    }
    float limit_s = static_cast<float>(state.ends.time_limit_s.value_or(0.0));
    if (ImGui::SliderFloat("time limit", &limit_s, 0.0f, 3600.0f, limit_s > 0.0f ? "%.0f s" : "none",
                           ImGuiSliderFlags_Logarithmic)) {
        state.ends.time_limit_s = limit_s > 0.0f ? std::optional<double>(limit_s) : std::nullopt;
        state.picture.set_ends(state.ends);
    }
}

}  // namespace

std::string forecast_line(const LiveErrors& errors, double target) {
    const std::string percent = fmt::format("{:.3g} %", 100.0 * target);
    if (errors.points().empty()) return "the error is known after 4 samples";
    const LiveError& last = errors.points().back();
    const std::string now =
        fmt::format("error {:.2g} % after {} samples; ", 100.0 * last.error, last.samples);
    if (last.high <= target) return now + percent + " is reached";
    const auto seconds = errors.seconds_until(target);
    if (!seconds) return now + percent + " is out of reach";
    return now + fmt::format("{} in about {:.3g} s", percent, *seconds);
}

void draw_error_panel(ViewState& state) {
    begin_panel("Error", PanelSide::right, state);
    const LiveErrors& errors = state.picture.errors();
    const double target = state.ends.error.value_or(kUsualTarget);
    if (!errors.points().empty()) draw_plot(errors, target);
    ImGui::TextUnformatted(forecast_line(errors, target).c_str());
    draw_quality(state);
    draw_ends(state);
    end_panel(PanelSide::right, state);
}

}  // namespace voxilux

#include "view/panels.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "jobs/effect_time.h"
#include "view/actions.h"
#include "view/error_panel.h"
#include "view/picture_panel.h"

namespace voxilux {
namespace {

constexpr ImGuiWindowFlags kStill = ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav |
                                    ImGuiWindowFlags_NoMove;
constexpr float kFontSize = 13.0f;  // on a monitor of scale 1
constexpr float kPanelGap = 8.0f;   // likewise

void text(const std::string& line) {
    ImGui::TextUnformatted(line.c_str());
}

std::string technique_of(const RenderPlan& plan, Effect effect) {
    const auto found = std::ranges::find_if(
        plan.techniques, [&](const ChosenTechnique& chosen) { return chosen.technique->effect == effect; });
    return found != plan.techniques.end() ? std::string(found->technique->name) : "";
}

// Switches an effect. Where that is not possible, shows a message and switches back.
void switch_effect(Effect effect, bool on, ViewState& state) {
    PlanRequest request = state.picture.request();
    request.effects.switches[effect] = on ? Switch::on : Switch::off;
    try {
        state.picture.change(state.picture.settings(), request);
        state.message.clear();
    } catch (const Error& error) {
        state.message = error.what();
    }
}

void draw_effect(const EffectState& effect, ViewState& state) {
    LivePicture& picture = state.picture;
    const RenderPlan& plan = picture.rest_plan();
    const std::string name(name_of(effect.effect));
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    bool on = effect.on;
    const bool is_clicked = ImGui::Checkbox(name.c_str(), &on);
    ImGui::TableNextColumn();
    text(technique_of(plan, effect.effect));
    ImGui::TableNextColumn();
    const double samples = std::max<double>(picture.samples(), 1.0);
    text(fmt::format("{:.2f}", effect_ms(plan, picture.statistics().passes, effect.effect) / samples));
    ImGui::TableNextColumn();
    text(effect.reason);
    if (is_clicked) switch_effect(effect.effect, on, state);
}

void draw_prices(ViewState& state) {
    begin_panel("Effects", PanelSide::left, state);
    if (ImGui::BeginTable("effects", 4)) {
        ImGui::TableSetupColumn("effect");
        ImGui::TableSetupColumn("technique");
        ImGui::TableSetupColumn("ms/sample");
        ImGui::TableSetupColumn("why");
        ImGui::TableHeadersRow();
        // A copy, because a switch replaces the plan.
        const EffectStates effects = state.picture.rest_plan().effects;
        for (const EffectState& effect : effects)
            draw_effect(effect, state);
        ImGui::EndTable();
    }
    end_panel(PanelSide::left, state);
}

void draw_frames(ViewState& state) {
    ImGui::Checkbox("play", &state.is_playing);
    ImGui::SameLine();
    const std::int64_t first = state.frames->first, last = state.frames->last;
    ImGui::SliderScalar("frame", ImGuiDataType_S64, &state.frame, &first, &last);
}

void draw_files(ViewState& state) {
    if (!ImGui::BeginCombo("open", "recent files and their folder", ImGuiComboFlags_HeightLarge)) return;
    for (const std::string& file : files_to_open(state.memory))
        if (ImGui::Selectable(file.c_str())) state.file_to_open = file;
    ImGui::EndCombo();
}

void draw_frame_time(ViewState& state) {
    float ms = static_cast<float>(state.memory.frame_ms);
    if (ImGui::SliderFloat("frame time", &ms, 5.0f, 500.0f, "%.0f ms", ImGuiSliderFlags_Logarithmic))
        state.memory.frame_ms = static_cast<double>(std::round(ms));
}

void draw_status(ViewState& state) {
    begin_panel("voxilux", PanelSide::left, state);
    if (state.picture.is_loaded()) {
        const glm::ivec2 size = state.picture.renderer().plan().settings.size;
        text(fmt::format("{}  {}x{}  {} of {} samples  {:.0f} ms", state.input.filename().string(), size.x,
                         size.y, state.picture.samples(), state.picture.max_samples(),
                         1000.0 * state.frame_s));
        if (state.frames) draw_frames(state);
        draw_frame_time(state);
        text("H: keys");
    } else {
        text("drop a .vox, a .toml or a mesh here");
    }
    if (!state.memory.recent.empty()) draw_files(state);
    if (state.has_newer_file) text("the file has changed: it is loaded once nothing is unsaved");
    if (!state.message.empty()) text(state.message);
    end_panel(PanelSide::left, state);
}

void draw_keys() {
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * window.x, 0.5f * window.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::Begin("Keys", nullptr, kStill);
    if (ImGui::BeginTable("keys", 2)) {
        for (const auto& [keys, what] : key_sheet()) {
            ImGui::TableNextColumn();
            text(keys);
            ImGui::TableNextColumn();
            text(what);
        }
        ImGui::EndTable();
    }
    ImGui::End();
}

}  // namespace

void begin_panel(const char* title, PanelSide side, const ViewState& state) {
    const float scale = ImGui::GetFontSize() / kFontSize;
    const float gap = scale * kPanelGap;
    const bool is_right = side == PanelSide::right;
    const float x = is_right ? ImGui::GetIO().DisplaySize.x - gap : gap;
    const float y = state.panel_ends[static_cast<std::size_t>(side)] + gap;
    ImGui::SetNextWindowPos({x, y}, ImGuiCond_Always, {is_right ? 1.0f : 0.0f, 0.0f});
    ImGui::SetNextWindowBgAlpha(0.75f);
    ImGui::Begin(title, nullptr, kStill);
    ImGui::PushItemWidth(200.0f * scale);
}

void end_panel(PanelSide side, ViewState& state) {
    state.panel_ends[static_cast<std::size_t>(side)] = ImGui::GetWindowPos().y + ImGui::GetWindowHeight();
    ImGui::End();
}

void draw_panels(glm::ivec2 window, ViewState& state) {
    if (state.shows_keys) draw_keys();
    if (state.picture.is_loaded()) {
        draw_target(window, state);
        draw_divider(window, state);
    }
    if (!state.shows_panels) return;
    state.panel_ends = {};
    draw_status(state);
    if (!state.picture.is_loaded()) return;
    draw_prices(state);
    draw_picture_panel(state);
    draw_edit_panel(state);
    draw_error_panel(state);
}

}  // namespace voxilux

#include "view/panels.h"

#include <imgui.h>

#include <algorithm>

#include "jobs/effect_time.h"
#include "view/actions.h"

namespace voxilux {
namespace {

constexpr ImGuiWindowFlags kStill = ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav |
                                    ImGuiWindowFlags_NoMove;

void text(const std::string& line) {
    ImGui::TextUnformatted(line.c_str());
}

std::string technique_of(const RenderPlan& plan, Effect effect) {
    const auto found = std::ranges::find_if(
        plan.techniques, [&](const ChosenTechnique& chosen) { return chosen.technique->effect == effect; });
    return found != plan.techniques.end() ? std::string(found->technique->name) : "";
}

// Switches an effect; what cannot be is said and undone.
void switch_effect(Effect effect, bool on, ViewState& state) {
    PlanRequest request = state.picture.request();
    request.effects.switches[effect] = on ? Switch::on : Switch::off;
    state.picture.change(state.picture.settings(), request);
}

void draw_effect(const EffectState& effect, ViewState& state) {
    LivePicture& picture = state.picture;
    const RenderPlan& plan = picture.renderer().plan();
    const std::string name(name_of(effect.effect));
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    bool on = effect.on;
    const bool is_clicked = ImGui::Checkbox(name.c_str(), &on);
    ImGui::TableNextColumn();
    text(technique_of(plan, effect.effect));
    ImGui::TableNextColumn();
    const double samples = std::max<double>(picture.samples(), 1.0);
    text(fmt::format("{:.2f}", effect_ms(plan, picture.passes(), effect.effect) / samples));
    ImGui::TableNextColumn();
    text(effect.reason);
    if (is_clicked) switch_effect(effect.effect, on, state);
}

void draw_prices(ViewState& state) {
    ImGui::SetNextWindowPos({8.0f, 96.0f}, ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowBgAlpha(0.75f);
    ImGui::Begin("Effects", nullptr, kStill);
    if (ImGui::BeginTable("effects", 4)) {
        ImGui::TableSetupColumn("effect");
        ImGui::TableSetupColumn("technique");
        ImGui::TableSetupColumn("ms/sample");
        ImGui::TableSetupColumn("why");
        ImGui::TableHeadersRow();
        // A copy: a switch makes another plan.
        const EffectStates effects = state.picture.renderer().plan().effects;
        for (const EffectState& effect : effects)
            draw_effect(effect, state);
        ImGui::EndTable();
    }
    ImGui::End();
}

void draw_status(ViewState& state) {
    ImGui::SetNextWindowPos({8.0f, 8.0f}, ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowBgAlpha(0.75f);
    ImGui::Begin("voxilux", nullptr, kStill);
    if (state.picture.is_loaded()) {
        const glm::ivec2 size = state.picture.renderer().plan().settings.size;
        text(fmt::format("{}  {}x{}  {} of {} samples  {:.0f} ms", state.input.filename().string(), size.x,
                         size.y, state.picture.samples(), state.picture.max_samples(),
                         1000.0 * state.frame_s));
        text(fmt::format("exposure {:+.1f}  {}  H: keys", state.exposure_ev,
                         state.look.curve == ToneMap::filmic ? "filmic" : "plain"));
    } else {
        text("drop a .vox or a .toml file here");
    }
    if (!state.message.empty()) text(state.message);
    ImGui::End();
}

void draw_keys() {
    ImGui::SetNextWindowPos({400.0f, 200.0f}, ImGuiCond_FirstUseEver);
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

void draw_panels(ViewState& state) {
    if (state.shows_keys) draw_keys();
    if (!state.shows_panels) return;
    draw_status(state);
    if (state.picture.is_loaded()) draw_prices(state);
}

}  // namespace voxilux

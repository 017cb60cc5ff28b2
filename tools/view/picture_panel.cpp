#include "view/picture_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "shared/false_colour.h"
#include "shared/tone_curve.h"
#include "view/panels.h"
#include "view/picture_look.h"

namespace voxilux {
namespace {

constexpr float kLegendWidth = 220.0f;
constexpr float kLegendHeight = 12.0f;
constexpr int kLegendSteps = 32;

ImU32 packed(gpu::vec3 codes) {
    return ImGui::ColorConvertFloat4ToU32({codes.x, codes.y, codes.z, 1.0f});
}

// The false colours of a number from `low` to `high`.
void draw_legend(const std::string& low, const std::string& high) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float step = kLegendWidth / kLegendSteps;
    for (int i = 0; i < kLegendSteps; ++i) {
        const float x = at.x + step * static_cast<float>(i);
        const float number = static_cast<float>(i) / (kLegendSteps - 1);
        list.AddRectFilled({x, at.y}, {x + step, at.y + kLegendHeight}, packed(gpu::false_colour(number)));
    }
    ImGui::Dummy({kLegendWidth, kLegendHeight});
    ImGui::TextUnformatted(low.c_str());
    ImGui::SameLine(kLegendWidth - ImGui::CalcTextSize(high.c_str()).x);
    ImGui::TextUnformatted(high.c_str());
}

void draw_legend(const ViewState& state) {
    const DisplayLook& look = state.look;
    switch (look.channel) {
        case DisplayChannel::depth:
            return draw_legend(fmt::format("{:.1f} voxels", look.low.x), fmt::format("{:.1f}", look.high.x));
        case DisplayChannel::ao:
            return draw_legend("0 occluded", "1 open");
        case DisplayChannel::sun:
            return draw_legend("0 in shadow", "1 lit");
        case DisplayChannel::error:
            return draw_legend(fmt::format("{:.3g}", std::pow(10.0f, look.low.x)),
                               fmt::format("{:.3g}", std::pow(10.0f, look.high.x)));
        case DisplayChannel::cells:
            if (has_channel(state.picture.renderer().plan(), look.channel))
                return draw_legend("1 ray in the cell", fmt::format("{:.0e}", std::pow(10.0f, look.high.x)));
            return ImGui::TextUnformatted("this picture keeps no occlusion in cells");
        case DisplayChannel::steps:
            if (!has_channel(state.picture.renderer().plan(), look.channel))
                return ImGui::TextUnformatted("this scene has no voxels");
            draw_legend("1 step", fmt::format("{:.0f}", std::pow(10.0f, look.high.x)));
            return ImGui::TextUnformatted("of the camera ray and the shadow ray");
        default:
            return;
    }
}

void draw_channels(ViewState& state) {
    const std::string shown(name_of(state.look.channel));
    if (!ImGui::BeginCombo("channel", shown.c_str())) return;
    for (std::size_t i = 0; i < kDisplayChannelNames.size(); ++i) {
        const auto channel = static_cast<DisplayChannel>(i);
        if (ImGui::Selectable(std::string(kDisplayChannelNames[i]).c_str(), channel == state.look.channel))
            show_channel(channel, state);
    }
    ImGui::EndCombo();
}

void draw_tone(ViewState& state) {
    float stops = state.exposure_ev;
    if (ImGui::SliderFloat("exposure", &stops, -10.0f, 10.0f, "%+.1f EV")) expose(stops, state);
    bool is_filmic = state.look.curve == ToneMap::filmic;
    if (ImGui::Checkbox("filmic", &is_filmic))
        state.look.curve = is_filmic ? ToneMap::filmic : ToneMap::plain;
}

std::string material_line(const PickedVoxel& target, const Scene& scene) {
    const std::string name =
        target.material < scene.materials.size() ? scene.materials[target.material].name : "";
    return fmt::format("voxel {} {} {}  material {} {}", target.cell.x, target.cell.y, target.cell.z,
                       target.material, name);
}

void draw_reading(ViewState& state) {
    if (state.edit.target)
        ImGui::TextUnformatted(material_line(*state.edit.target, state.picture.renderer().scene()).c_str());
    else
        ImGui::TextUnformatted("no voxel under the pointer");
    const std::optional<PixelReading>& reading = state.reading;
    if (!reading) return ImGui::TextUnformatted("moving");
    ImGui::TextUnformatted(
        fmt::format("pixel {} {}  {} samples", reading->pixel.x, reading->pixel.y, reading->samples).c_str());
    ImGui::TextUnformatted(fmt::format("radiance {:.4f} {:.4f} {:.4f} +- {:.4f}", reading->radiance.x,
                                       reading->radiance.y, reading->radiance.z, reading->error)
                               .c_str());
    if (!reading->channel) return;
    const glm::vec3 value = *reading->channel;
    ImGui::TextUnformatted(
        fmt::format("{} {:.4f} {:.4f} {:.4f}", name_of(state.look.channel), value.x, value.y, value.z)
            .c_str());
}

void draw_wipe(ViewState& state) {
    if (state.reference_name.empty()) return;
    ImGui::TextUnformatted(fmt::format("reference {}", state.reference_name).c_str());
    for (const auto& [name, comparison] : {std::pair{"off", DisplayComparison::none},
                                           {"wipe", DisplayComparison::reference},
                                           {"difference", DisplayComparison::difference},
                                           {"FLIP", DisplayComparison::map}}) {
        if (ImGui::RadioButton(name, state.look.comparison == comparison)) state.look.comparison = comparison;
        ImGui::SameLine();
    }
    ImGui::NewLine();
    if (state.look.comparison != DisplayComparison::map) return;
    const FlipMap& flip = state.picture.flip();
    if (!flip.result()) return ImGui::TextUnformatted("FLIP comes when nothing moves");
    draw_legend("0 alike", "1");
    ImGui::TextUnformatted(fmt::format("mean FLIP {:.4f}", flip.mean()).c_str());
}

}  // namespace

void draw_picture_panel(ViewState& state) {
    begin_panel("Picture", PanelSide::right, state);
    draw_channels(state);
    draw_legend(state);
    if (state.look.channel == DisplayChannel::color) draw_tone(state);
    draw_wipe(state);
    draw_reading(state);
    end_panel(PanelSide::right, state);
}

void draw_divider(glm::ivec2 window, const ViewState& state) {
    if (!is_wiping(state)) return;
    const float x = static_cast<float>(state.divider) * static_cast<float>(window.x);
    ImGui::GetBackgroundDrawList()->AddLine({x, 0.0f}, {x, static_cast<float>(window.y)},
                                            IM_COL32(255, 255, 255, 200), 1.0f);
}

}  // namespace voxilux

#include <fmt/format.h>
#include <imgui.h>

#include <array>

#include "shared/tone_curve.h"
#include "view/panels.h"
#include "view/picture_panel.h"

namespace voxilux {
namespace {

constexpr double kBytesPerMib = 1 << 20;
constexpr ImU32 kTargetColour = IM_COL32(255, 200, 40, 255);

void draw_materials(ViewState& state) {
    const std::vector<Material>& materials = state.picture.renderer().scene().materials;
    const auto shown = std::min<std::size_t>(state.edit.material, materials.size() - 1);
    if (!ImGui::BeginCombo("material", materials[shown].name.c_str())) return;
    for (std::uint32_t i = 0; i < materials.size(); ++i) {
        const glm::vec3 albedo = materials[i].albedo;
        ImGui::PushID(static_cast<int>(i));
        ImGui::ColorButton("colour", {gpu::encode_srgb(albedo.x), gpu::encode_srgb(albedo.y),
                                      gpu::encode_srgb(albedo.z), 1.0f});
        ImGui::SameLine();
        if (ImGui::Selectable(materials[i].name.c_str(), i == state.edit.material)) state.edit.material = i;
        ImGui::PopID();
    }
    ImGui::EndCombo();
}

// The corners of a box, those of the low z first, counter-clockwise.
std::array<glm::dvec3, 8> corners_of(const Box& box) {
    std::array<glm::dvec3, 8> corners;
    for (int i = 0; i < 8; ++i) {
        const bool is_high_x = (i & 3) == 1 || (i & 3) == 2;
        corners[static_cast<std::size_t>(i)] = {is_high_x ? box.hi.x : box.lo.x,
                                                (i & 2) != 0 ? box.hi.y : box.lo.y,
                                                (i & 4) != 0 ? box.hi.z : box.lo.z};
    }
    return corners;
}

}  // namespace

void draw_edit_panel(ViewState& state) {
    if (state.picture.renderer().voxels() == nullptr) return;
    begin_panel("Edit", PanelSide::right, state);
    EditState& edit = state.edit;
    for (std::size_t i = 0; i < kToolNames.size(); ++i) {
        if (i % 3 != 0) ImGui::SameLine(80.0f * static_cast<float>(i % 3));
        const auto tool = static_cast<Tool>(i);
        if (ImGui::RadioButton(std::string(kToolNames[i]).c_str(), edit.tool == tool)) edit.tool = tool;
    }
    ImGui::SliderInt("brush", &edit.brush, 1, kMaxBrush);
    draw_materials(state);
    ImGui::TextUnformatted(fmt::format("{} to undo, {} to redo, {:.1f} of {:.0f} MiB",
                                       edit.history.undo_count(), edit.history.redo_count(),
                                       static_cast<double>(edit.history.bytes()) / kBytesPerMib,
                                       static_cast<double>(EditHistory::kMaxBytes) / kBytesPerMib)
                               .c_str());
    end_panel(PanelSide::right, state);
}

void draw_target(glm::ivec2 window, const ViewState& state) {
    const std::optional<Box> box = tool_box(state.edit);
    if (!box) return;
    std::array<ImVec2, 8> places;
    const std::array<glm::dvec3, 8> corners = corners_of(*box);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const auto place = place_of(state.view.camera, corners[i], glm::dvec2(window));
        if (!place) return;
        places[i] = {static_cast<float>(place->x), static_cast<float>(place->y)};
    }
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    for (std::size_t i = 0; i < 4; ++i) {
        list.AddLine(places[i], places[(i + 1) % 4], kTargetColour);
        list.AddLine(places[4 + i], places[4 + (i + 1) % 4], kTargetColour);
        list.AddLine(places[i], places[4 + i], kTargetColour);
    }
}

}  // namespace voxilux

#include "view/user_interface.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <utility>

namespace voxilux {
namespace {

void map_keys(ImGuiIO& io) {
    constexpr std::pair<ImGuiKey, int> kKeys[] = {{ImGuiKey_Tab, GLFW_KEY_TAB},
                                                  {ImGuiKey_LeftArrow, GLFW_KEY_LEFT},
                                                  {ImGuiKey_RightArrow, GLFW_KEY_RIGHT},
                                                  {ImGuiKey_UpArrow, GLFW_KEY_UP},
                                                  {ImGuiKey_DownArrow, GLFW_KEY_DOWN},
                                                  {ImGuiKey_Home, GLFW_KEY_HOME},
                                                  {ImGuiKey_End, GLFW_KEY_END},
                                                  {ImGuiKey_Delete, GLFW_KEY_DELETE},
                                                  {ImGuiKey_Backspace, GLFW_KEY_BACKSPACE},
                                                  {ImGuiKey_Enter, GLFW_KEY_ENTER},
                                                  {ImGuiKey_Escape, GLFW_KEY_ESCAPE},
                                                  {ImGuiKey_A, GLFW_KEY_A},
                                                  {ImGuiKey_C, GLFW_KEY_C},
                                                  {ImGuiKey_V, GLFW_KEY_V},
                                                  {ImGuiKey_X, GLFW_KEY_X},
                                                  {ImGuiKey_Z, GLFW_KEY_Z}};
    for (const auto& [key, number] : kKeys)
        io.KeyMap[key] = number;
}

void feed(ImGuiIO& io, const InputEvent& event) {
    if (const auto* key = std::get_if<KeyEvent>(&event); key != nullptr && key->key < 512) {
        io.KeysDown[key->key] = key->is_down;
        io.KeyCtrl = io.KeysDown[GLFW_KEY_LEFT_CONTROL] || io.KeysDown[GLFW_KEY_RIGHT_CONTROL];
        io.KeyShift = io.KeysDown[GLFW_KEY_LEFT_SHIFT] || io.KeysDown[GLFW_KEY_RIGHT_SHIFT];
    } else if (const auto* text = std::get_if<TextEvent>(&event)) {
        io.AddInputCharacter(text->codepoint);
    } else if (const auto* button = std::get_if<ButtonEvent>(&event)) {
        io.MouseDown[static_cast<int>(button->button)] = button->is_down;
    } else if (const auto* move = std::get_if<MoveEvent>(&event)) {
        io.MousePos = {static_cast<float>(move->place.x), static_cast<float>(move->place.y)};
    } else if (const auto* scroll = std::get_if<ScrollEvent>(&event)) {
        io.MouseWheel += static_cast<float>(scroll->steps);
    }
}

void append_list(const ImDrawList& list, glm::vec2 font_size, Overlay& overlay) {
    const auto first_vertex = static_cast<std::uint32_t>(overlay.vertices.size());
    const auto first_index = static_cast<std::uint32_t>(overlay.indices.size());
    for (const ImDrawVert& vertex : list.VtxBuffer)
        overlay.vertices.push_back(
            {{vertex.pos.x, vertex.pos.y}, glm::vec2(vertex.uv.x, vertex.uv.y) * font_size, vertex.col});
    for (const ImDrawIdx index : list.IdxBuffer)
        overlay.indices.push_back(first_vertex + index);
    for (const ImDrawCmd& command : list.CmdBuffer)
        overlay.draws.push_back({.first = glm::ivec2(command.ClipRect.x, command.ClipRect.y),
                                 .end = glm::ivec2(command.ClipRect.z, command.ClipRect.w),
                                 .first_index = first_index + command.IdxOffset,
                                 .index_count = command.ElemCount});
}

}  // namespace

UserInterface::UserInterface(Presenter& presenter, float scale) {
    ImGui::CreateContext();
    ImGui::StyleColorsDark();
    ImGui::GetStyle().ScaleAllSizes(scale);
    ImGui::GetStyle().AntiAliasedLinesUseTex = false;  // texels of the font are read unfiltered
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    map_keys(io);
    ImFontConfig config;
    config.SizePixels = std::floor(13.0f * scale);
    io.Fonts->AddFontDefault(&config);
    unsigned char* coverage = nullptr;
    glm::ivec2 size(0);
    io.Fonts->GetTexDataAsAlpha8(&coverage, &size.x, &size.y);
    presenter.set_font({coverage, static_cast<std::size_t>(size.x * size.y)}, size);
}

UserInterface::~UserInterface() {
    ImGui::DestroyContext();
}

void UserInterface::begin(std::span<const InputEvent> events, glm::ivec2 window, double seconds) {
    ImGuiIO& io = ImGui::GetIO();
    for (const InputEvent& event : events)
        feed(io, event);
    io.DisplaySize = {static_cast<float>(window.x), static_cast<float>(window.y)};
    io.DeltaTime = std::max(static_cast<float>(seconds), 1e-4f);
    ImGui::NewFrame();
}

const Overlay& UserInterface::end() {
    ImGui::Render();
    overlay_ = {};
    const ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
    const ImDrawData& drawn = *ImGui::GetDrawData();
    for (int i = 0; i < drawn.CmdListsCount; ++i)
        append_list(*drawn.CmdLists[i], glm::vec2(fonts.TexWidth, fonts.TexHeight), overlay_);
    return overlay_;
}

bool UserInterface::wants(const InputEvent& event) const {
    const ImGuiIO& io = ImGui::GetIO();
    if (const auto* button = std::get_if<ButtonEvent>(&event)) return button->is_down && io.WantCaptureMouse;
    if (std::holds_alternative<ScrollEvent>(event)) return io.WantCaptureMouse;
    const auto* key = std::get_if<KeyEvent>(&event);
    return key != nullptr && key->is_down && io.WantTextInput;
}

}  // namespace voxilux

#include "view/view_report.h"

#include <utility>

#include "write_json.h"

namespace voxilux {

void ViewReport::add_frame(double seconds, double show_s) {
    frames_.push_back({{"ms", 1000.0 * seconds},
                       {"step_ms", 1000.0 * std::exchange(step_s_, 0.0)},
                       {"show_ms", 1000.0 * show_s},
                       {"samples", last_.samples},
                       {"width", last_.size.x},
                       {"height", last_.size.y}});
}

void ViewReport::write(const std::string& file, const ViewState& state, glm::ivec2 window,
                       const std::vector<std::string>& messages) const {
    const Camera& camera = state.view.camera;
    write_json(file, {{"frames", frames_},
                      {"shown",
                       {{"input", state.input.string()},
                        {"window", {window.x, window.y}},
                        {"camera",
                         {{"position", {camera.position.x, camera.position.y, camera.position.z}},
                          {"yaw", camera.yaw_deg},
                          {"pitch", camera.pitch_deg},
                          {"fov_y", camera.fov_y_deg}}}}},
                      {"messages", messages}});
}

}  // namespace voxilux

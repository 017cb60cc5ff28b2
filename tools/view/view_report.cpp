#include "view/view_report.h"

#include <unistd.h>

#include <fstream>
#include <utility>

#include "view/picture_look.h"
#include "write_json.h"

namespace voxilux {
namespace {

using Json = nlohmann::ordered_json;

// The estimated errors of the film, with the samples and seconds that each took.
Json errors_json(const LiveErrors& errors) {
    Json json = Json::array();
    for (const LiveError& point : errors.points())
        json.push_back({{"samples", point.samples},
                        {"seconds", point.seconds},
                        {"error", point.error},
                        {"high", point.high}});
    return json;
}

// Memory of this process that is in use; 0 where the system does not say.
double resident_mib() {
    std::ifstream statm("/proc/self/statm");
    std::uint64_t all_pages = 0;
    std::uint64_t pages = 0;
    statm >> all_pages >> pages;
    return static_cast<double>(pages) * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

// The readout of the pixel under the pointer; null where there is none.
Json json_of(const ViewState& state) {
    Json json;
    if (const auto& target = state.edit.target)
        json["voxel"] = {target->cell.x, target->cell.y, target->cell.z};
    if (const auto& target = state.edit.target) json["material"] = target->material;
    if (const auto& reading = state.reading) {
        json["place"] = {reading->pixel.x, reading->pixel.y};
        json["radiance"] = {reading->radiance.x, reading->radiance.y, reading->radiance.z};
        json["error"] = reading->error;
        json["samples"] = reading->samples;
    }
    return json;
}

}  // namespace

void ViewReport::add_frame(double seconds, double show_s) {
    frames_.push_back({.ms = 1000.0 * seconds,
                       .step_ms = 1000.0 * std::exchange(step_s_, 0.0),
                       .show_ms = 1000.0 * show_s,
                       .resident_mib = resident_mib(),
                       .samples = last_.samples,
                       .size = last_.size,
                       .built = std::exchange(built_, {})});
}

void ViewReport::write(const std::string& file, const ViewState& state, glm::ivec2 window,
                       const std::vector<std::string>& messages) const {
    const Camera& camera = state.view.camera;
    Json frames = Json::array();
    for (const Frame& frame : frames_) {
        Json& row = frames.emplace_back(Json{{"ms", frame.ms},
                                             {"step_ms", frame.step_ms},
                                             {"show_ms", frame.show_ms},
                                             {"samples", frame.samples},
                                             {"width", frame.size.x},
                                             {"height", frame.size.y},
                                             {"resident_mib", frame.resident_mib}});
        for (const StepTime& step : frame.built)
            row["built_ms"][step.label] = 1000.0 * step.time.wall;
    }
    write_json(file, {{"first_picture_ms", 1000.0 * first_s_},
                      {"frames", frames},
                      {"shown",
                       {{"input", state.input.string()},
                        {"window", {window.x, window.y}},
                        {"camera",
                         {{"position", {camera.position.x, camera.position.y, camera.position.z}},
                          {"yaw", camera.yaw_deg},
                          {"pitch", camera.pitch_deg},
                          {"fov_y", camera.fov_y_deg}}},
                        {"channel", name_of(state.look.channel)},
                        {"samples", state.picture.is_loaded() ? state.picture.samples() : 0},
                        {"quality", state.quality != nullptr ? Json(state.quality->name) : Json()},
                        {"flip", state.picture.flip().result() ? Json(state.picture.flip().mean()) : Json()},
                        {"frame", state.frames ? Json(state.frame) : Json()},
                        {"pixel", json_of(state)},
                        {"edits", state.edit.edits},
                        {"undo", state.edit.history.undo_count()},
                        {"newer_file", state.has_newer_file},
                        {"message", state.message}}},
                      {"errors", errors_json(state.picture.errors())},
                      {"messages", messages}});
}

}  // namespace voxilux

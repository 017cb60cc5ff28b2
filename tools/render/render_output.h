#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "film/tonemap.h"
#include "formats/exr.h"
#include "jobs/render_session.h"
#include "render/render.h"

namespace voxilux {

// Throws Error(usage) for a curve or an exposure that is none.
[[nodiscard]] ToneMapOptions tone_options(const std::string& curve, float exposure_ev);

// How the pictures of the command's scene are written, and the report that they carry.
[[nodiscard]] ExrOptions exr_options(const RenderCommand& command, const Scene& scene,
                                     const RenderPlan& plan);
[[nodiscard]] nlohmann::ordered_json report_of_picture(const RenderCommand& command, const Scene& scene,
                                                       const RenderOutcome& outcome);

// Writes the picture into every file and counts what did not fit their formats among the faults. `scene` is
// the still one that was rendered.
void write_pictures(const RenderCommand& command, const std::vector<std::string>& files, const Scene& scene,
                    RenderOutcome& outcome);

// Does to a strip of a picture what render does to the picture and its checkpoint, in the system's folder for
// temporary files, and leaves nothing: how long that takes is what is asked. What goes wrong is nothing here.
void rehearse_output(const RenderCommand& command, const std::vector<std::string>& files, const Scene& scene,
                     RenderOutcome strip);

// Where the forecasts of all renders are kept; empty where there is no home.
[[nodiscard]] std::filesystem::path history_file();

// Remembers the forecast that the report of a render has, if it has one.
void remember_forecast(const RenderCommand& command, const nlohmann::ordered_json& report);

// Whether --error was given and not reached.
[[nodiscard]] bool missed_error(const RenderCommand& command, const RenderOutcome& outcome);

// Messages of the validation layers and faults, on standard error: said whatever the user asked for.
void print_validation(const RenderOutcome& outcome);
void print_faults(const RenderOutcome& outcome);

// What may surprise, on standard error, but for what is in `said` already.
void print_warnings(const RenderCommand& command, const RenderOutcome& outcome, std::set<std::string>& said);
void print_missed_error(const RenderCommand& command, const RenderOutcome& outcome);

// The report for people, on standard output.
void print_outcome(const RenderCommand& command, const std::vector<std::string>& files,
                   const RenderOutcome& outcome);

// done, time_limit (before the error target) or interrupted.
[[nodiscard]] ExitCode exit_code(const RenderCommand& command, const RenderOutcome& outcome);

}  // namespace voxilux
